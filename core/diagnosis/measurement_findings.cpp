#include "core/diagnosis/measurement_findings.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/calibration/column_names.h"
#include "core/diagnosis/model/turned_truth.h"
#include "core/diagnosis/naming/lag_and_delay.h"

namespace odolab {

bool comes_first(const Finding& a, const Finding& b) {
  const auto is_of_calibration = [](const Finding& f) {
    const auto is_mounting = [](const auto& of) { return of.effect == "truth_mounting_offset"; };
    return is_mounting(f) || f.effect == "truth_time_offset" || f.effect == "actuator_delay" ||
           std::any_of(f.alternatives.begin(), f.alternatives.end(), is_mounting);  // a toe that may be no more
  };
  if (is_of_calibration(a) != is_of_calibration(b)) return is_of_calibration(b);
  return a.log_likelihood_gain > b.log_likelihood_gain;
}

namespace {

constexpr double kMostOfAnAxle_rad = 0.02;

// Where the tracked point is found, against where the file has it.
struct FoundMounting {
  Finding finding;  // truth_mounting_offset, with what is determined
  double turned_rad = 0.0, away_m = 0.0;
  bool is_moved = false;        // by something that is beyond doubt and large enough to say
  bool is_turned = false;       // its heading is among that
  bool is_shifted = false;      // its place is off by three standard errors
  bool is_shifted_far = false;  // and by more than a marker that sits right
};

FoundMounting mounting_found(const JointModel& joint, const Intervals& intervals, const LeastSquaresCalibration& fit,
                             const Vehicle& nominal) {
  constexpr double kSigmasOfShift = 3.0;  // which of two names comes first is no matter of alarms
  const Pose &now = joint.model.truth.axle_T_tracked, &then = nominal.truth.axle_T_tracked;
  const double by[3] = {now.x_m - then.x_m, now.y_m - then.y_m, now.heading_rad - then.heading_rad};
  const double value[3] = {now.x_m, now.y_m, now.heading_rad};
  const double wheelbase_m = std::get<DifferentialDrive>(nominal.kind).wheelbase_m;
  const double least_m = least_mounting_m(wheelbase_m);
  const double least[3] = {least_m, least_m, 0.0005};
  FoundMounting m;
  m.turned_rad = by[2], m.away_m = std::hypot(by[0], by[1]);
  double gain = 0.0;
  for (int k = 0; k < 3; ++k) {
    const column::Name& name = column::names[static_cast<std::size_t>(column::mounting_x + k)];
    const auto p = std::find_if(fit.parameters.begin(), fit.parameters.end(), [&](const ParameterEstimate& estimate) {
      return estimate.name == name.key && estimate.determined;
    });
    if (p == fit.parameters.end()) continue;
    const bool is_of_place = k < 2;
    const double turned_rad = is_of_place ? 0.0 : mean_truth_turned_rad(joint);
    const double se = std::hypot(intervals.stderr_of_nuisance(column::mounting_x + k), turned_rad);
    const double z = by[k] / std::max(p->stderr_value, se);
    m.finding.parameters.push_back({std::string(name.key).substr(15), value[k], se, name.unit});
    m.is_shifted = m.is_shifted || (is_of_place && std::abs(by[k]) > std::max(kSigmasOfShift * se, least[k]));
    if (std::abs(z) <= kSigmasOfTruth || std::abs(by[k]) <= least[k]) continue;
    gain += 0.5 * z * z;
    m.is_moved = true;
    m.is_shifted_far = m.is_shifted_far || (is_of_place && std::abs(by[k]) > sits_right_m(wheelbase_m));
    m.is_turned = m.is_turned || !is_of_place;
  }
  m.finding.effect = "truth_mounting_offset";
  m.finding.component = "truth";
  m.finding.log_likelihood_gain = gain;
  m.finding.p_value = chi_square_tail(2.0 * gain, 3);
  m.finding.sentence = "the tracked point is not where the vehicle's file has it";
  return m;
}

// A heading of the mounting is to the last digit what wheels that are not square to the axle do. A marker that sits
// elsewhere besides is the simpler cause of both, where it is not turned by more than it is shifted: two causes for one
// are no rival then.
bool may_be_toe(const FoundMounting& m) {
  constexpr double kArm_m = 0.2, kFarthest_m = 0.01, kMostOfWheels_rad = 0.1;
  const bool is_marker_alone = m.is_shifted_far && std::abs(m.turned_rad) < m.away_m / kArm_m;
  return m.is_turned && !is_marker_alone && m.away_m < kFarthest_m && std::abs(m.turned_rad) < kMostOfWheels_rad;
}

// Markers are put on by hand, axles in a workshop; but a hand that turned a marker has shifted it, too: by as little as
// shows, and it comes first. Software that puts the tracked point on the axle turns it by more than any axle is
// crooked; and of straights alone nobody knows whether it is shifted.
bool is_toe_first(const FoundMounting& m) {
  return m.finding.parameters.size() == 3 && !m.is_shifted && std::abs(m.turned_rad) < kMostOfAnAxle_rad;
}

// The toe that crawls as the tracked point that is turned seems to.
Finding toe_instead(const FoundMounting& m) {
  const FoundParameter& heading = m.finding.parameters.back();
  const double z = m.turned_rad / heading.stderr_value;
  Finding toe;
  toe.effect = "wheel_toe";
  toe.component = "vehicle";
  toe.parameters = {{"sideways_per_metre", -m.turned_rad, heading.stderr_value, "1"}};
  toe.log_likelihood_gain = 0.5 * z * z;
  toe.p_value = chi_square_tail(z * z, 1);
  toe.sentence = "the vehicle crawls sideways as it drives: its wheels do not stand square to the axle";
  toe.where.regime = "wherever it drives, in proportion to the way";
  return toe;
}

}  // namespace

void add_mounting(std::vector<Finding>& findings, const JointModel& joint, const Intervals& intervals,
                  const LeastSquaresCalibration& fit, const Vehicle& nominal) {
  const FoundMounting mounting = mounting_found(joint, intervals, fit, nominal);
  if (!mounting.is_moved) return;
  if (!may_be_toe(mounting)) {
    findings.push_back(mounting.finding);
    if (mounting.is_turned && std::abs(mounting.turned_rad) < kMostOfAnAxle_rad)
      findings.back().sentence += "; so far as it is turned, an axle that is not square would look the same";
    return;
  }
  Finding first = toe_instead(mounting), second = mounting.finding;
  if (!is_toe_first(mounting)) std::swap(first, second);
  first.alternatives.push_back({second.effect, second.component, second.log_likelihood_gain,
                                std::string("a look at how the markers sit: the motion is the same") +
                                    (mounting.is_shifted ? ", so far as the tracked point is turned" : "")});
  findings.push_back(first);
}

void add_clock(std::vector<Finding>& findings, const JointModel& joint, const Intervals& intervals,
               const LeastSquaresCalibration& fit, const Vehicle& nominal, bool from_commands) {
  if (std::none_of(fit.parameters.begin(), fit.parameters.end(),
                   [](const ParameterEstimate& p) { return p.name == "truth_mounting.time_offset_s" && p.determined; }))
    return;
  const SharedClock clock = intervals.shared_clock(joint);
  const double off = clock.offset_s - nominal.truth.time_offset_s, z = off / clock.stderr_s;
  if (std::abs(z) < kSigmasOfTruth || std::abs(off) < kLeastClock_s) return;
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
