#include "core/diagnosis/model/ready_run.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/calibration/averaged_truth.h"
#include "core/calibration/between_readings.h"
#include "core/calibration/fewer_readings.h"
#include "core/calibration/left_out.h"
#include "core/calibration/restamped.h"
#include "core/diagnosis/model/outlying.h"

namespace odolab {

namespace {

// The rotation of wheels that obey, at times that go on.
std::vector<WheelSample> told_wheels(const Recording& recording, const DifferentialDrive& drive) {
  std::vector<WheelSample> wheels;
  for (const WheelSample& w : wheel_samples(recording, drive))
    if (wheels.empty() || w.time_s > wheels.back().time_s) wheels.push_back(w);
  return wheels;
}

}  // namespace

Result<InnovationRun> ready_run(const CheckedRecording& c, const Vehicle& vehicle) {
  Result<InnovationRun> run = innovation_run(c.recording, vehicle, c.left_out_s);
  if (!run) return run;
  run->speeds_are_held = c.from_commands;
  if (!c.from_commands) return run;
  run->smooth.clear();  // a command is what it is
  // What a base was told while its truth is left out is known, and it lags behind that: not one step in its mean.
  if (!run->left_out.empty()) run->wheels = told_wheels(c.recording, std::get<DifferentialDrive>(vehicle.kind));
  return run;
}

InnovationModel model_of(const LeastSquaresCalibration& calibration, std::size_t recording) {
  InnovationModel model{std::get<DifferentialDrive>(calibration.vehicle.kind), calibration.vehicle.truth,
                        calibration.noise};
  if (recording < calibration.time_offset_s.size()) model.truth.time_offset_s = calibration.time_offset_s[recording];
  return model;
}

void put_clock_right(InnovationRun& run, InnovationModel& model, const AlignedClock& clock) {
  model.truth.time_offset_s = clock.offset_s;
  put_clock_right(run, clock.rate, clock.offset_s);
  cut_where_left_out(run, clock.offset_s);
}

std::vector<Result<InnovationRun>> condensed_runs(const std::vector<CheckedRecording>& checked, const Vehicle& vehicle,
                                                  const LeastSquaresCalibration& calibration, bool were_fitted,
                                                  const std::vector<AlignedClock>& clocks) {
  constexpr std::size_t kOfNone = static_cast<std::size_t>(-1);
  std::vector<Result<InnovationRun>> runs(checked.size(), Error{});
  parallel_for(static_cast<int>(checked.size()), [&](int i) {
    const auto r = static_cast<std::size_t>(i);
    runs[r] = ready_run(checked[r], vehicle);
    if (!runs[r]) return;
    runs[r]->accelerations = wheel_accelerations(runs[r]->wheels);
    InnovationModel model = model_of(calibration, were_fitted ? r : kOfNone);
    const double longest_s = averaging_s(*runs[r]);
    InnovationRun on_right_clock = *runs[r];
    if (r < clocks.size()) put_clock_right(on_right_clock, model, clocks[r]);
    on_right_clock.set_aside = runs[r]->set_aside = outlying(on_right_clock, model);
    InnovationRun averaged = with_averaged_truth(on_right_clock, model, longest_s);
    averaged.wheels = runs[r]->wheels;
    averaged.smooth = runs[r]->smooth;
    averaged.left_out = runs[r]->left_out;
    trust_less_between_readings(averaged, model);
    InnovationRun less = with_fewer_readings(averaged, std::min(kReadingsApart_s, longest_s));
    if (less.truth.size() == runs[r]->truth.size()) std::fill(less.set_aside.begin(), less.set_aside.end(), char{0});
    if (less.truth.size() < runs[r]->truth.size() || less.wheels.size() < runs[r]->wheels.size())
      less.as_recorded = std::make_shared<const InnovationRun>(*std::move(runs[r]));
    runs[r] = std::move(less);
  });
  return runs;
}

}  // namespace odolab
