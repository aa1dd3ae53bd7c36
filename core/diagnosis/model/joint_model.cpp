#include "core/diagnosis/model/joint_model.h"

#include <algorithm>
#include <functional>

#include "core/calibration/column_names.h"
#include "core/calibration/left_out.h"
#include "core/calibration/noise_fit.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/model/counts_at_rest.h"

namespace odolab {

double& JointModel::nuisance(InnovationModel& m, int c) {
  switch (c) {
    case 0:
      return m.drive.wheel_radius_left_m;
    case 1:
      return m.drive.wheel_radius_right_m;
    case 2:
      return m.drive.wheelbase_m;
    case 3:
      return m.truth.axle_T_tracked.x_m;
    case 4:
      return m.truth.axle_T_tracked.y_m;
    default:
      return m.truth.axle_T_tracked.heading_rad;
  }
}

JointModel::JointModel(std::vector<InnovationRun> runs, std::vector<char> from_commands,
                       const LeastSquaresCalibration& start, const Vehicle& nominal)
    : runs_(std::move(runs)),
      from_commands_(std::move(from_commands)),
      nominal_(nominal),
      mean_radius_is_held_(start.scale_is_open) {
  model.drive = std::get<DifferentialDrive>(start.vehicle.kind);
  model.truth = start.vehicle.truth;
  model.noise = start.noise;
  if (model.noise.truth_heading_rad <= 0.0) model.noise.truth_heading_rad = 0.01;
  model.noise = with_wander(with_body(model.noise));
  if (std::any_of(runs_.begin(), runs_.end(), std::mem_fn(&InnovationRun::speeds_are_held)))
    model.noise = with_timing(model.noise);
  clock_s = start.time_offset_s;
  clock_s.resize(runs_.size(), model.truth.time_offset_s);
  clock_active.assign(runs_.size(), 1);
  for (const InnovationRun& run : runs_) masked_.push_back(run.set_aside);
  cut();
  for (std::size_t r = 0; r < runs_.size(); ++r) numbers_.push_back(static_cast<int>(r));
  constexpr double kNextToNothing = 0.25;  // of what was known before
  const std::array<double, 6> prior = sizes_of_priors();
  for (const ParameterEstimate& p : start.parameters)
    for (std::size_t c = 0; c < prior.size(); ++c)
      if (p.name == column::names[c].key && !p.determined)
        untold_[c] = !start.innovations_are_correlated && p.stderr_value > kNextToNothing * prior[c];
}

void JointModel::cut() {
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const std::vector<char> before = runs_[r].cut;
    cut_where_left_out(runs_[r], clock_s[r], clock_rate(static_cast<int>(r)));
    if (runs_[r].cut != before) linearised_at_.reset();
  }
}

bool JointModel::is_well_inside(int r, double time_s) const {
  constexpr std::ptrdiff_t kFew = 3;
  constexpr double kNear_s = 0.1;
  const InnovationRun& run = runs_[static_cast<std::size_t>(r)];
  const double on_truths_clock_s = clocks(r).truth_stamp_s(time_s);
  const auto n = static_cast<std::ptrdiff_t>(run.truth.size());
  const std::ptrdiff_t behind = std::lower_bound(run.truth.begin(), run.truth.end(), on_truths_clock_s,
                                                 [](const TruthSample& t, double s) { return t.time_s < s; }) -
                                run.truth.begin();
  const auto enough = [&](std::ptrdiff_t samples, double at_s) {
    return samples >= kFew && std::abs(at_s - on_truths_clock_s) >= kNear_s;
  };
  std::ptrdiff_t k = behind;
  for (;; ++k) {
    if (k >= n || is_cut(run, static_cast<std::size_t>(k))) return false;
    if (enough(k - behind + 1, run.truth[static_cast<std::size_t>(k)].time_s)) break;
  }
  for (k = behind - 1;; --k) {
    if (k < 0) return false;
    if (enough(behind - k, run.truth[static_cast<std::size_t>(k)].time_s)) return true;
    if (is_cut(run, static_cast<std::size_t>(k))) return false;
  }
}

InnovationModel JointModel::model_of(int run) const {
  InnovationModel m = model;
  m.truth.time_offset_s = clock_s[run];
  return m;
}

InnovationRun JointModel::prepared(int r) const { return prepared(r, runs_[r], now_->read_views[r]); }

DriveView JointModel::as_it_goes(DriveView by_wheels) const {
  for (const AcceptedEffect& a : accepted)
    if (a.effect->lags_behind_commands() && by_wheels.from_commands) {
      const Motions lag = motion_of(*a.effect, by_wheels, a.shape, a.value);
      by_wheels = as_it_lags(std::move(by_wheels), lag);
    }
  const auto is_meant = [](const AcceptedEffect& a) { return changes_speeds(*a.effect); };
  if (std::none_of(accepted.begin(), accepted.end(), is_meant)) return by_wheels;
  return odolab::as_it_goes(std::move(by_wheels), [&](const DriveView& view) {
    std::vector<BodyMotion> sum(view.steps.size());
    for (const AcceptedEffect& a : accepted)
      if (is_meant(a)) motion_of(*a.effect, view, a.shape, a.value).add_to(sum, 1.0);
    return sum;
  });
}

InnovationRun JointModel::prepared(int r, const InnovationRun& of, const DriveView& view) const {
  InnovationRun run = of;
  ExtraColumn sum;
  sum.name = "effects";
  sum.value = 1.0;
  sum.per_step.resize(run.wheels.size() - 1);
  bool any = false;
  for (const ExtraColumn& given : run.extra) {
    any = true;
    for (std::size_t i = 0; i < sum.per_step.size(); ++i) {
      sum.per_step[i].forward_m += given.value * given.per_step[i].forward_m;
      sum.per_step[i].sideways_m += given.value * given.per_step[i].sideways_m;
      sum.per_step[i].turn_rad += given.value * given.per_step[i].turn_rad;
    }
  }
  if (run.counts_show && (half_counts[0] != 0.0 || half_counts[1] != 0.0)) {
    const std::array<Motions, 2> of_wheel = counts_at_rest(of, model.drive);
    for (int k = 0; k < 2; ++k) of_wheel[k].add_to(sum.per_step, half_counts[k]);
    any = true;
  }
  if (const double rate = clock_rate(r); rate != 0.0) put_clock_right(run, rate, clock_s[static_cast<std::size_t>(r)]);
  for (const AcceptedEffect& a : accepted) {
    if (a.effect->clock_rate) continue;
    const std::vector<Motions> motions = a.effect->motions(view, a.shape);
    any = true;
    for (std::size_t k = 0; k < motions.size(); ++k) motions[k].add_to(sum.per_step, a.value[k]);
  }
  if (any) run.extra = {std::move(sum)};
  return run;
}

double* JointModel::clock_rate_of(int run) {
  for (AcceptedEffect& a : accepted)
    if (a.effect->clock_rate && a.effect->of_each_recording)
      return &a.value[a.effect->clock_amplitude(numbers_[static_cast<std::size_t>(run)])];
  return nullptr;
}

double JointModel::clock_rate(int run) const {
  double rate = 0.0;
  for (const AcceptedEffect& a : accepted)
    if (a.effect->clock_rate) rate += a.value[a.effect->clock_amplitude(numbers_[static_cast<std::size_t>(run)])];
  return rate;
}

TwoClocks JointModel::clocks(int run) const {
  const auto r = static_cast<std::size_t>(run);
  return {runs_[r].truth.front().time_s, clock_s[r], clock_rate(run)};
}

int JointModel::columns() const {
  int n = first_amplitude();
  for (const AcceptedEffect& a : accepted) n += static_cast<int>(a.value.size());
  return n;
}

int JointModel::first_column(int which) const {
  int n = first_amplitude();
  for (int a = 0; a < which; ++a) n += static_cast<int>(accepted[static_cast<std::size_t>(a)].value.size());
  return n;
}

double JointModel::minus_two_log_likelihood_of(int r) const {
  const InnovationRun run = prepared(r);
  const InnovationModel m = model_of(r);
  FilterOptions options;
  options.derivatives = false;
  const InnovationSums sums = filtered(run, summed_up(run, m), m, options);
  return sums.chi2 + sums.log_determinant;
}

Track JointModel::poses(int run) const {
  Track track;
  const TwoClocks own = clocks(run);
  for (const FilterStep& s : now_->runs[run].steps())
    if (s.truth_index >= 0) track.push_back({own.wheels_stamp_s(runs_[run].truth[s.truth_index].time_s), s.pose});
  return track;
}

}  // namespace odolab
