#include "core/io/import/truth_stream.h"

#include <cmath>

namespace odolab {

namespace {

constexpr double kUpright = 0.9;  // a body that leans by 26 degrees is no vehicle on a floor

}  // namespace

bool TruthStream::add(std::int64_t time_ns, const SpacePose& pose) {
  const PlanarPose planar = planar_pose(pose, axes_);
  double values[3] = {planar.floor_T_body.x_m, planar.floor_T_body.y_m, planar.floor_T_body.heading_rad};
  if (!std::isfinite(values[0]) || !std::isfinite(values[1])) return false;
  ++poses_;
  if (!std::isfinite(values[2])) {
    values[2] = std::nan("");
    ++without_heading_;
  } else if (!(planar.uprightness > kUpright)) {
    ++tilted_;
  }
  spool_.add(time_ns, values);
  return true;
}

void TruthStream::warn(const std::string& source, std::vector<std::string>& warnings) const {
  if (without_heading_ > 0)
    warnings.push_back(source + ": " + std::to_string(without_heading_) + " of " + std::to_string(poses_) +
                       " poses have no heading: their rotation is none");
  if (2 * tilted_ > poses_)
    warnings.push_back(source + ": the body leans over: its axes may not be " +
                       (axes_ == SpaceAxes::z_up ? "z up; --axes y_up or camera says otherwise" : "what --axes says"));
}

}  // namespace odolab
