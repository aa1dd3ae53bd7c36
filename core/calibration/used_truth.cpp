#include "core/calibration/used_truth.h"

#include "core/calibration/carried_truth.h"
#include "core/calibration/filter_walk.h"
#include "core/calibration/left_out.h"

namespace odolab {

UsedTruth used_truth(const Recording& recording, const LeastSquaresCalibration& calibration, std::size_t index,
                     const LeastSquaresOptions& options) {
  const Track whole = truth_track(recording);
  UsedTruth used{whole, std::vector<char>(whole.size(), 0)};
  const auto* drive = std::get_if<DifferentialDrive>(&calibration.vehicle.kind);
  if (!drive || index >= calibration.time_offset_s.size()) return used;
  InnovationModel model{*drive, calibration.vehicle.truth, calibration.noise};
  model.truth.time_offset_s = calibration.time_offset_s[index];
  Vehicle by_its_clock = calibration.vehicle;
  by_its_clock.truth = model.truth;
  const std::optional<MeasuredRecording> measured = without_carried_truth(recording);
  Result<InnovationRun> run =
      innovation_run(measured ? measured->recording : recording, by_its_clock, options.left_out_of(index));
  if (!run) return used;
  cut_where_left_out(*run, model.truth.time_offset_s);
  FilterOptions gated;
  gated.derivatives = false;
  gated.gate = kGate;
  const std::vector<char> aside = filtered(*run, summed_up(*run, model), model, gated).set_aside;
  used = {};
  std::size_t k = 0;
  bool anew = false;
  for (const TimedPose& pose : whole) {
    for (; k < run->truth.size() && run->truth[k].time_s < pose.time_s; ++k) anew |= aside[k] == kRestartHere;
    if (k == run->truth.size() || run->truth[k].time_s != pose.time_s || aside[k] == 1) continue;
    used.track.push_back(pose);
    used.anew.push_back(anew || aside[k] == kRestartHere);
    anew = false;
    ++k;
  }
  return used;
}

}  // namespace odolab
