// The joint model of all samples that were recorded, where it was fitted to fewer.
#include <cmath>

#include "core/calibration/left_out.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

InnovationRun JointModel::recorded(int r) const {
  if (!runs_[r].as_recorded) return prepared(r);
  InnovationRun all = *runs_[r].as_recorded;
  cut_where_left_out(all, clock_s[r], clock_rate(r));
  DriveView view;
  if (!accepted.empty())
    view = as_it_goes(drive_view(numbers_[r], all, model.drive, from_commands_[r] != 0, poses(r), Way::as_read));
  return prepared(r, all, view);
}

FittedNoise JointModel::noise_as_recorded() const {
  double samples = 0.0, means = 0.0;
  for (const InnovationRun& run : runs_) {
    const double of_run = static_cast<double>(run.truth.size());
    means += of_run;
    samples += of_run * run.samples_averaged;
  }
  FittedNoise noise = model.noise;
  const double larger = std::sqrt(samples / means);
  noise.truth_position_m *= larger;
  noise.truth_heading_rad *= larger;
  return noise;
}

JointModel JointModel::under(const FittedNoise& noise) const {
  JointModel other = *this;
  other.model.noise = noise;
  return other;
}

JointModel JointModel::with_runs(std::vector<InnovationRun> runs) const {
  JointModel other = *this;
  other.runs_ = std::move(runs);
  other.nominal_.kind = model.drive;
  other.nominal_.truth.axle_T_tracked = model.truth.axle_T_tracked;
  for (std::size_t r = 0; r < other.runs_.size(); ++r) other.masked_[r] = other.runs_[r].set_aside;
  other.now_.reset();
  other.linearised_at_.reset();
  other.cut();
  return other;
}

JointModel JointModel::as_recorded() const {
  JointModel all = *this;
  all.model.noise = noise_as_recorded();
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (!runs_[r].as_recorded) continue;
    all.runs_[r] = *runs_[r].as_recorded;
    all.masked_[r] = all.runs_[r].set_aside;
  }
  all.now_.reset();
  all.linearised_at_.reset();
  all.cut();
  all.linearise(false);
  return all;
}

}  // namespace odolab
