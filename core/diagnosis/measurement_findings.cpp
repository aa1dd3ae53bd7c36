#include "core/diagnosis/measurement_findings.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/calibration/column_names.h"
#include "core/diagnosis/naming/lag_and_delay.h"

namespace odolab {

bool comes_first(const Finding& a, const Finding& b) {
  const auto is_of_calibration = [](const Finding& f) {
    return f.effect == "truth_mounting_offset" || f.effect == "truth_time_offset" || f.effect == "actuator_delay";
  };
  if (is_of_calibration(a) != is_of_calibration(b)) return is_of_calibration(b);
  return a.log_likelihood_gain > b.log_likelihood_gain;
}

void add_mounting(std::vector<Finding>& findings, const JointModel& joint, const Intervals& intervals,
                  const LeastSquaresCalibration& fit, const Vehicle& nominal) {
  const auto determined = [&](const std::string& name) -> const ParameterEstimate* {
    for (const ParameterEstimate& p : fit.parameters)
      if (p.name == name && p.determined) return &p;
    return nullptr;
  };
  const Pose &now = joint.model.truth.axle_T_tracked, &then = nominal.truth.axle_T_tracked;
  const double by[3] = {now.x_m - then.x_m, now.y_m - then.y_m, now.heading_rad - then.heading_rad};
  const double value[3] = {now.x_m, now.y_m, now.heading_rad};
  const double wheelbase_m = std::get<DifferentialDrive>(nominal.kind).wheelbase_m;
  const double least_m = least_mounting_m(wheelbase_m);
  const double least[3] = {least_m, least_m, 0.0005};
  constexpr double kSigmasOfShift = 3.0;  // which of two names comes first is no matter of alarms
  Finding mounting;
  double gain = 0.0;
  bool moved = false, shifted = false, shifted_far = false, turned_too = false;
  for (int k = 0; k < 3; ++k) {
    const column::Name& name = column::names[static_cast<std::size_t>(column::mounting_x + k)];
    const ParameterEstimate* p = determined(name.key);
    if (!p) continue;
    const double se = intervals.stderr_of_nuisance(column::mounting_x + k);
    const double z = by[k] / std::max(p->stderr_value, se);
    mounting.parameters.push_back({std::string(name.key).substr(15), value[k], se, name.unit});
    shifted = shifted || (k < 2 && std::abs(by[k]) > std::max(kSigmasOfShift * se, least[k]));
    if (std::abs(z) > kSigmasOfBias && std::abs(by[k]) > least[k]) {
      gain += 0.5 * z * z;
      moved = true;
      shifted_far = shifted_far || (k < 2 && std::abs(by[k]) > sits_right_m(wheelbase_m));
      turned_too = turned_too || k == 2;
    }
  }
  if (!moved) return;
  mounting.effect = "truth_mounting_offset";
  mounting.component = "truth";
  mounting.log_likelihood_gain = gain;
  mounting.p_value = chi_square_tail(2.0 * gain, 3);
  mounting.sentence = "the tracked point is not where the vehicle's file has it";
  // A heading of the mounting alone is what wheels that are not square to the axle do too; a marker that sits elsewhere
  // besides is the simpler cause of both, where it is not turned by more than it is shifted.
  constexpr double kArm_m = 0.2;
  const double turned = now.heading_rad - then.heading_rad, away_m = std::hypot(by[0], by[1]);
  const bool is_marker_alone = shifted_far && std::abs(turned) < away_m / kArm_m;
  if (is_marker_alone || !turned_too || away_m >= 0.01 || std::abs(turned) >= 0.1 ||
      mounting.parameters.back().name != "heading_rad") {
    findings.push_back(mounting);
    return;
  }
  // Markers are put on by hand, axles in a workshop; but a hand that turned a marker has shifted it, too: by as little
  // as shows, and it comes first.
  constexpr double kMostOfAnAxle_rad = 0.02;
  const bool sits_where_it_should =
      mounting.parameters.size() == 3 &&
      away_m + 2.0 * std::hypot(mounting.parameters[0].stderr_value, mounting.parameters[1].stderr_value) <
          sits_right_m(wheelbase_m);
  const char* told_apart_by = "a look at how the markers sit: the motion is the same";
  const FoundParameter& heading = mounting.parameters.back();
  const double z = turned / heading.stderr_value;
  Finding toe;
  toe.effect = "wheel_toe";
  toe.component = "vehicle";
  toe.parameters = {{"sideways_per_metre", -turned, heading.stderr_value, "1"}};
  toe.log_likelihood_gain = 0.5 * z * z;
  toe.p_value = chi_square_tail(z * z, 1);
  toe.sentence = "the vehicle crawls sideways as it drives: its wheels do not stand square to the axle";
  toe.where.regime = "wherever it drives, in proportion to the way";
  if (!shifted && (sits_where_it_should || std::abs(turned) < kMostOfAnAxle_rad)) {
    toe.alternatives.push_back({mounting.effect, mounting.component, gain, told_apart_by});
    findings.push_back(toe);
  } else {
    mounting.alternatives.push_back({toe.effect, toe.component, toe.log_likelihood_gain, told_apart_by});
    findings.push_back(mounting);
  }
}

void add_clock(std::vector<Finding>& findings, const JointModel& joint, const Intervals& intervals,
               const LeastSquaresCalibration& fit, const Vehicle& nominal, bool from_commands) {
  if (std::none_of(fit.parameters.begin(), fit.parameters.end(),
                   [](const ParameterEstimate& p) { return p.name == "truth_mounting.time_offset_s" && p.determined; }))
    return;
  const SharedClock clock = intervals.shared_clock(joint);
  const double off = clock.offset_s - nominal.truth.time_offset_s, z = off / clock.stderr_s;
  if (std::abs(z) < kSigmasOfBias || std::abs(off) < kLeastClock_s) return;
  Finding f;
  // Clocks that were set by a network or by hand are off by so much; a motor's loop, a bus and a gear take longer.
  constexpr double kMostOfAClock_s = 0.05;
  const bool is_late = from_commands && off > 0.0, delay = is_late && off > kMostOfAClock_s;
  f.effect = delay ? "actuator_delay" : "truth_time_offset";
  f.component = delay ? "vehicle" : "truth";
  f.parameters = {{delay ? "delay_s" : "offset_s", delay ? off : clock.offset_s, clock.stderr_s, "s"}};
  f.log_likelihood_gain = 0.5 * z * z;
  f.p_value = chi_square_tail(z * z, 1);
  f.sentence = delay ? "the base follows its commands late" : "the truth's clock is off against the vehicle's";
  if (is_late) {
    f.alternatives.push_back({delay ? "truth_time_offset" : "actuator_delay", delay ? "truth" : "vehicle",
                              f.log_likelihood_gain,
                              "one clock for commands and truth: on their own the two are the same"});
    if (std::none_of(joint.accepted.begin(), joint.accepted.end(),
                     [](const AcceptedEffect& a) { return a.effect->only_commands; }))
      if (const std::optional<Alternative> lag = lag_instead(joint, off, f.log_likelihood_gain))
        f.alternatives.push_back(*lag);
  }
  findings.push_back(f);
}

Finding finding_of(const DataFault& fault) {
  Finding f;
  f.effect = fault.effect;
  f.component = fault.component;
  f.where.recording = fault.recording;
  f.where.time_s = fault.time_s;
  f.p_value = 0.0;
  f.sentence = fault.sentence;
  return f;
}

Finding finding_of(const MovedMounting& m) {
  Finding f;
  f.effect = "truth_mounting_offset";
  f.component = "truth";
  f.parameters = {{"x_m", m.axle_T_tracked.x_m, m.stderrs.x_m, "m"},
                  {"y_m", m.axle_T_tracked.y_m, m.stderrs.y_m, "m"},
                  {"heading_rad", m.axle_T_tracked.heading_rad, m.stderrs.heading_rad, "rad"}};
  f.where.recording = m.recording;
  f.log_likelihood_gain = m.log_likelihood_gain;
  f.p_value = chi_square_tail(2.0 * m.log_likelihood_gain, 3);
  f.sentence = m.sentence();
  return f;
}

}  // namespace odolab
