// A truth that is smoothed, as trackers do that filter or average their poses. Of a kernel whose weights lie about its
// mean time with variance s^2 the truth is, to second order, the pose at that mean time and s^2 / 2 of its second
// derivative: it cuts corners, and starts and stops before the vehicle does. The mean time is the clock's offset. One
// of first order with a time constant T has s = T, a mean over a window W has s = W / sqrt(12).
#include <cmath>
#include <map>
#include <mutex>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/effect_motions.h"

namespace odolab::effects {

namespace {
// Of wheels that take hold a little late there is up to two thirds of that without any: in the planar simulation 0.021
// s in one of 24, 0.007 in the mean.
constexpr double kLeastWidth_s = 0.03;

// Forward, sideways and in heading, of the pose as it is smoothed against the pose, for a variance of 1 s2.
BodyMotion ahead(const EffectStep& s, double wheelbase_m) {
  return {0.25 * (s.left_mps2 + s.right_mps2), 0.5 * s.speed_mps * s.yaw_rate_radps,
          0.5 * (s.right_mps2 - s.left_mps2) / wheelbase_m};
}

// Of that from step to step.
Motions changes(const DriveView& view) {
  Motions m(view.steps.size());
  BodyMotion was;
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const BodyMotion is = ahead(view.steps[i], view.drive.wheelbase_m);
    m[i] = {is.forward_m - was.forward_m, is.sideways_m - was.sideways_m, is.turn_rad - was.turn_rad};
    was = is;
  }
  return m;
}

std::vector<Motions> as_it_is_smoothed(const DriveView& view, const std::vector<double>&) {
  if (view.from_commands) return motions_by_number(Motions());  // a base that lags behind them is the same
  Motions m(view.steps.size());
  BodyMotion was;
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    const BodyMotion is = i + 1 < view.steps.size() ? ahead(s, view.drive.wheelbase_m) : BodyMotion{};
    const double forward_m = s.forward_m();
    // As it seems from the smoothed pose, which is turned against the vehicle.
    m[i] = {is.forward_m - was.forward_m - s.turn_rad * is.sideways_m,
            is.sideways_m - was.sideways_m + s.turn_rad * is.forward_m - forward_m * is.turn_rad,
            is.turn_rad - was.turn_rad};
    was = is;
  }
  return motions_by_number(std::move(m));
}
}  // namespace

std::vector<Effect> truth_smoothing() {
  Effect e;
  e.name = "truth_smoothing";
  e.component = "truth";
  e.amplitudes = {{"variance_s2", "s2", 0.0025, kLeastWidth_s * kLeastWidth_s, 0.25}};
  e.sentence = "the truth is smoothed: it cuts corners, and starts and stops before the vehicle does";
  e.regime = "where speed and turn rate change, and in arcs";
  e.looks_like = {"lateral_slip", "traction_slip", "drivetrain_backlash"};
  e.told_apart_by = "sharp starts and stops, and arcs at two speeds";
  e.of_the_truth = true;
  e.motions = as_it_is_smoothed;
  e.beyond_counts = [](const std::vector<double>& value, const std::vector<double>&, double count_rad,
                       const std::vector<DriveView>& views) {
    return is_more_than_counts(value[0] * displaces_m(views, changes), count_rad, views);
  };
  e.to_parameters = [](const std::vector<double>& value, const std::vector<double>& stderr_value) {
    const double width_s = std::sqrt(std::max(value[0], 1e-8));
    return std::vector<FoundParameter>{{"width_s", width_s, 0.5 * stderr_value[0] / width_s, "s"}};
  };
  e.from_parameters = [](const ActiveEffect& a) {
    const double width_s = a.parameter("width_s");
    return std::vector<double>{width_s * width_s};
  };
  return {e};
}

// A mean that is as long has s = 0.29 of it, a bell that is nearly over by then 0.4.
const Effect& truth_smoothing_seen_at_rest(double for_s) {
  constexpr double kNarrowest = 0.1, kWidest = 0.5;
  static std::mutex one_at_a_time;
  static std::map<double, Effect> seen;
  const std::lock_guard lock(one_at_a_time);
  const auto [at, is_new] = seen.try_emplace(for_s);
  Effect& e = at->second;
  if (is_new) {
    e = truth_smoothing().front();
    e.amplitudes[0].low = std::pow(kNarrowest * for_s, 2);
    e.amplitudes[0].high = std::pow(kWidest * for_s, 2);
    e.beyond_counts = nullptr;
  }
  return e;
}

}  // namespace odolab::effects
