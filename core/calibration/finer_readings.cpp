#include "core/calibration/finer_readings.h"

#include <cmath>

#include "core/calibration/wheel_line.h"

namespace odolab {

std::vector<WheelSample> finer_readings(const std::vector<WheelSample>& wheels) {
  constexpr double kSlow_s = 0.03, kPiece_s = 0.025, kGap_s = 0.5;
  const WheelLine line(wheels, false);
  std::vector<WheelSample> finer;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    finer.push_back(wheels[i]);
    if (i + 1 == wheels.size()) break;
    const double apart_s = wheels[i + 1].time_s - wheels[i].time_s;
    if (apart_s <= kSlow_s || apart_s >= kGap_s) continue;
    const int pieces = static_cast<int>(std::ceil(apart_s / kPiece_s - 1e-6));
    for (int k = 1; k < pieces; ++k) {
      const double at_s = wheels[i].time_s + apart_s * k / pieces;
      const auto [left_rad, right_rad] = line.turned_rad(i, at_s);
      finer.push_back({at_s, wheels[i].left_rad + left_rad, wheels[i].right_rad + right_rad});
    }
  }
  return finer;
}

}  // namespace odolab
