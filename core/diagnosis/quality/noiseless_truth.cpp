#include "core/diagnosis/quality/noiseless_truth.h"

#include "core/base/formatted.h"
#include "core/base/random.h"
#include "core/calibration/carried_truth.h"
#include "core/geometry/angles.h"

namespace odolab {

std::optional<AsIfMeasured> as_if_measured(const Recording& recording, const Vehicle& vehicle, std::uint64_t seed) {
  constexpr double kOfWheelbase = 0.003;  // a millimetre for one of a third of a metre
  constexpr double kHeading_rad = 0.001;
  const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind);
  const std::optional<std::string> computed = drive ? warning_of_computed_truth(recording) : std::nullopt;
  if (!computed) return std::nullopt;
  const double position_m = kOfWheelbase * drive->wheelbase_m;
  AsIfMeasured measured{recording, *computed};
  Random random(seed);
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
