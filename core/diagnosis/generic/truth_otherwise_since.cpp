#include "core/diagnosis/generic/truth_otherwise_since.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/formatted.h"
#include "core/diagnosis/model/candidate_scan.h"
#include "core/diagnosis/naming/lag_and_delay.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

namespace {

// Shape {recording, at_s}.
struct Since {
  Effect effect;
  std::string (*in_words)(const std::vector<double>& shape, const std::vector<double>& value);
};

// Of a step at which it acts, or empty; behind it come those since.
std::optional<std::size_t> first_step(const DriveView& view, const std::vector<double>& shape) {
  if (view.number != static_cast<int>(shape[0])) return std::nullopt;
  const std::size_t at = view.step_at(shape[1]);
  if (at >= view.steps.size()) return std::nullopt;
  return at;
}

// By a metre ahead, a metre to the left, and turned by a radian.
Since sits_elsewhere() {
  Effect e;
  e.name = "sits_elsewhere_since";
  e.component = "truth";
  e.amplitudes = {{"ahead_m", "m"}, {"left_m", "m"}, {"heading_rad", "rad"}};
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    const std::optional<std::size_t> at = first_step(view, shape);
    if (!at) return std::vector<Motions>(3);
    const std::size_t n = view.steps.size();
    Motions ahead(*at, n), left(*at, n), turned(*at, n);
    ahead[*at].forward_m = left[*at].sideways_m = turned[*at].turn_rad = 1.0;
    for (std::size_t i = *at + 1; i < n; ++i) {
      const EffectStep& s = view.steps[i];
      ahead[i].sideways_m = s.turn_rad;
      left[i].forward_m = -s.turn_rad;
      turned[i].sideways_m = -s.forward_m();  // it goes where it went before, and says another heading
    }
    return motions_by_number(std::move(ahead), std::move(left), std::move(turned));
  };
  return {std::move(e), [](const std::vector<double>& shape, const std::vector<double>& value) {
            constexpr double kNone_rad = 1e-4;
            const std::string turned = std::abs(value[2]) < kNone_rad ? ""
                                                                      : formatted(", turned by %.2f degrees to the %s",
                                                                                  std::abs(value[2]) * 180.0 / kPi,
                                                                                  value[2] < 0.0 ? "right" : "left");
            return formatted(
                "the tracked point sits elsewhere on the vehicle from %.1f s on, %.1f mm further %s and %.1f mm to the "
                "%s%s, as where a marker is knocked or slips",
                shape[1], 1e3 * std::abs(value[0]), value[0] < 0.0 ? "back" : "ahead", 1e3 * std::abs(value[1]),
                value[1] < 0.0 ? "right" : "left", turned.c_str());
          }};
}

// How far a drive has gone and turned by a time.
class GoneBy {
 public:
  explicit GoneBy(const DriveView& view) {
    double forward_m = 0.0, turn_rad = 0.0;
    const auto add = [&](double time_s) {
      time_s_.push_back(time_s);
      forward_m_.push_back(forward_m);
      turn_rad_.push_back(turn_rad);
    };
    for (const EffectStep& s : view.steps) {
      if (time_s_.empty()) add(s.time_s - 0.5 * s.duration_s);
      forward_m += s.forward_m();
      turn_rad += s.turn_rad;
      add(s.time_s + 0.5 * s.duration_s);
    }
  }
  BodyMotion at(double time_s) const {
    const auto behind = std::lower_bound(time_s_.begin() + 1, time_s_.end() - 1, time_s);
    const auto k = static_cast<std::size_t>(behind - time_s_.begin());
    const double gap_s = time_s_[k] - time_s_[k - 1];
    const double u = gap_s > 0.0 ? std::clamp((time_s - time_s_[k - 1]) / gap_s, 0.0, 1.0) : 1.0;
    return {std::lerp(forward_m_[k - 1], forward_m_[k], u), 0.0, std::lerp(turn_rad_[k - 1], turn_rad_[k], u)};
  }

 private:
  std::vector<double> time_s_, forward_m_, turn_rad_;
};

// Later by so long, shape[2], than before: each pose is that of so long ago. By a share of it.
Since is_later() {
  Effect e;
  e.name = "is_later_since";
  e.component = "truth";
  e.amplitudes = {{"share", "1"}};
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    const std::optional<std::size_t> at = first_step(view, shape);
    if (!at) return std::vector<Motions>(1);
    const std::size_t n = view.steps.size();
    const GoneBy gone(view);
    Motions late(*at, n);
    BodyMotion behind;  // by how much it is behind as the step begins
    for (std::size_t i = *at; i < n; ++i) {
      const double ends_s = view.steps[i].time_s + 0.5 * view.steps[i].duration_s;
      const BodyMotion now = gone.at(ends_s), then = gone.at(ends_s - shape[2]);
      const BodyMotion is{then.forward_m - now.forward_m, 0.0, then.turn_rad - now.turn_rad};
      late[i] = {is.forward_m - behind.forward_m, 0.0, is.turn_rad - behind.turn_rad};
      behind = is;
    }
    return motions_by_number(std::move(late));
  };
  return {std::move(e), [](const std::vector<double>& shape, const std::vector<double>& value) {
            const double late_s = shape[2] * value[0];
            return formatted(
                "the truth comes %.0f ms %s from %.1f s on than before, as where a clock is set while it runs",
                1e3 * std::abs(late_s), late_s < 0.0 ? "earlier" : "later", shape[1]);
          }};
}

constexpr double kAbout_s[] = {-0.2, -0.1, 0.0, 0.1, 0.2};
constexpr double kLate_s[] = {-0.4, -0.2, -0.1, -0.04, -0.02, 0.02, 0.04, 0.1, 0.2, 0.4};

struct Found {
  const Since* since = nullptr;
  std::vector<double> shape;
  CandidateTest test;
};

void keep_better(Found& best, const Since& since, const CandidateScan& scan, std::vector<double> shape) {
  CandidateTest test = scan.test(since.effect, shape);
  if (test.statistic > best.test.statistic) best = {&since, std::move(shape), std::move(test)};
}

// About the moment of what was let in.
Found best_about(const JointModel& joint, std::size_t k) {
  static const Since elsewhere = sits_elsewhere(), later = is_later();
  const CandidateScan scan(joint, static_cast<int>(k));
  const double recording = joint.accepted[k].shape[0], at_s = joint.accepted[k].shape[1];
  Found best, late;
  for (const double about_s : kAbout_s) {
    keep_better(best, elsewhere, scan, {recording, at_s + about_s});
    for (const double late_s : kLate_s) keep_better(late, later, scan, {recording, at_s + about_s, late_s});
  }
  if (late.since) {
    const double late_s = late.shape[2] * late.test.value[0];
    for (const double about_s : kAbout_s) keep_better(late, later, scan, {recording, at_s + about_s, late_s});
  }
  return late.test.statistic > best.test.statistic ? late : best;
}

// The model with that in a name's place, under noise of its own: a push beside which the truth goes on contradicting
// the wheels makes that seem large.
JointModel with(const Found& found, JointModel joint, std::size_t k) {
  AcceptedEffect& a = joint.accepted[k];
  a.effect = &found.since->effect;
  a.shape = found.shape;
  a.value = found.test.value;
  joint.fit(3);
  joint.fit_noise_and_all();
  return joint;
}

}  // namespace

std::optional<Unnamed> what_is_otherwise_since(const JointModel& joint, const std::vector<ScoredCandidate>& evidence) {
  std::optional<Unnamed> most;
  for (std::size_t k = 0; k < joint.accepted.size() && k < evidence.size(); ++k) {
    const AcceptedEffect& a = joint.accepted[k];
    if (!a.effect->local || !a.effect->of_one_recording) continue;
    const Found best = best_about(joint, k);
    const double own = evidence[k].test.statistic, inflation = std::max(1.0, evidence[k].test.inflation);
    // Of two at five moments each; what says it with fewer numbers had less by chance.
    const double clearly = kClearlyBeaten + 2.0 * std::log(2.0 * static_cast<double>(std::size(kAbout_s))) +
                           best.test.freedom - evidence[k].test.freedom;
    constexpr double kNearly = 0.5;
    if (best.test.statistic < kNearly * own || (most && best.test.statistic < most->gain)) continue;
    const JointModel instead = with(best, joint, k);
    if (best.test.statistic < own + inflation * clearly && likelier_by(instead, joint) < inflation * clearly) continue;
    Unnamed u;
    u.component = "truth";
    u.gain = best.test.statistic;
    u.p_value = evidence[k].p_value;  // it says more
    u.where.recording = joint.runs()[static_cast<std::size_t>(a.shape[0])].name;
    u.where.time_s = {{best.shape[1], best.shape[1]}};
    u.where.regime = best.since->in_words(best.shape, instead.accepted[k].value);
    most = std::move(u);
  }
  return most;
}

}  // namespace odolab
