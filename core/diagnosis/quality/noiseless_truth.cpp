#include "core/diagnosis/quality/noiseless_truth.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/base/formatted.h"
#include "core/base/random.h"
#include "core/calibration/carried_truth.h"
#include "core/geometry/angles.h"
#include "core/recording/truth_left_out.h"

namespace odolab {

namespace {

std::uint64_t seed_by_readings(const Recording& recording) {
  std::uint64_t seed = 0;
  for (const Channel& channel : recording.channels) {
    if (is_of_truth(channel.name)) continue;
    for (const double value : channel.values)
      if (!std::isnan(value)) seed = mixed(seed ^ std::bit_cast<std::uint64_t>(value));
  }
  return seed;
}

}  // namespace

std::optional<AsIfMeasured> as_if_measured(const Recording& recording, const Vehicle& vehicle) {
  constexpr double kOfWheelbase = 0.003;  // a millimetre for one of a third of a metre
  constexpr double kHeading_rad = 0.001;
  const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind);
  const std::optional<std::string> computed = drive ? warning_of_computed_truth(recording) : std::nullopt;
  if (!computed) return std::nullopt;
  const double position_m = kOfWheelbase * drive->wheelbase_m;
  AsIfMeasured measured{recording, *computed};
  Random random(seed_by_readings(recording));
  for (Channel& channel : measured.recording.channels) {
    const bool is_position = channel.name == "truth_x_m" || channel.name == "truth_y_m";
    if (!is_position && channel.name != "truth_heading_rad") continue;
    for (double& value : channel.values) value += (is_position ? position_m : kHeading_rad) * random.normal();
  }
  measured.said += formatted("; it is judged as if it had been measured to %.2g mm and %.2g degrees", 1e3 * position_m,
                             degrees(kHeading_rad));
  return measured;
}

}  // namespace odolab
