#include "core/diagnosis/quality/bridged_recording.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/calibration/evened_recording.h"
#include "core/calibration/left_out.h"
#include "core/calibration/repeated_stamps.h"
#include "core/diagnosis/quality/no_fix.h"
#include "core/diagnosis/quality/quality.h"
#include "core/diagnosis/quality/unmeasured_heading.h"
#include "core/recording/truth_left_out.h"

namespace odolab {

namespace {

Recording without_truth(Recording recording) {
  std::erase_if(recording.channels, [](const Channel& c) { return is_of_truth(c.name); });
  return recording;
}

}  // namespace

BridgedRecording bridged_recording(const Recording& recording, const Vehicle& vehicle, Looks looks,
                                   const std::optional<AlignedClock>& clock) {
  BridgedRecording out{recording, {}, {}};
  Vehicle as_drive = vehicle;
  if (const auto* tracked = std::get_if<Tracked>(&vehicle.kind)) as_drive.kind = as_differential_drive(*tracked);
  const auto* drive = std::get_if<DifferentialDrive>(&as_drive.kind);
  if (!drive || wheel_samples(recording, *drive).size() < 2) return out;
  CheckedRecording ready =
      checked(looks == Looks::at_truth_too ? recording : without_truth(recording), as_drive, clock);
  for (const DataFault& fault : ready.faults)
    if (fault.effect == "encoder_data_fault" || fault.effect == kEncoderGap) out.said.push_back(in_words(fault));
  if (looks == Looks::at_truth_too)
    if (const auto said = said_of_rows_without_fix(recording, rows_without_fix(recording))) out.said.push_back(*said);
  if (looks == Looks::at_truth_too)
    if (const auto said = unmeasured_heading(truth_samples(recording), wheel_samples(recording, *drive), *drive))
      out.said.push_back(recording.name + ": " + *said);
  if (out.said.empty()) return out;
  out.left_out_s = ready.left_out_s;
  const std::vector<WheelSample> wheels = bridged(without_repeated(wheel_samples(ready.recording, *drive)),
                                                  out.left_out_s, 2.0 * kPi / drive->counts_per_wheel_turn());
  if (looks == Looks::at_truth_too)
    out.recording = std::move(ready.recording);
  else if (std::optional<EvenedRecording> even = evened(recording, *drive))
    out.recording = std::move(even->recording);
  const std::vector<double>& read_s = out.recording.time_s;
  std::erase_if(out.recording.channels, [](const Channel& c) {
    return c.name == "left_ticks" || c.name == "right_ticks" || c.name == "left_wheel_rad" ||
           c.name == "right_wheel_rad";
  });
  std::vector<double> left(read_s.size(), std::numeric_limits<double>::quiet_NaN()), right = left;
  std::size_t row = 0;
  for (const WheelSample& w : wheels) {
    while (row < read_s.size() && read_s[row] < w.time_s) ++row;
    if (row == read_s.size()) break;
    left[row] = w.left_rad;
    right[row] = w.right_rad;
  }
  out.recording.channels.push_back({"left_wheel_rad", std::move(left)});
  out.recording.channels.push_back({"right_wheel_rad", std::move(right)});
  return out;
}

}  // namespace odolab
