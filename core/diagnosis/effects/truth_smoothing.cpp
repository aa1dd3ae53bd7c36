// A truth that is smoothed, as trackers do that filter or average their poses. Of a kernel whose weights lie about its
// mean time with variance s^2 the truth is, to second order, the pose at that mean time and s^2 / 2 of its second
// derivative: it cuts corners, and starts and stops before the vehicle does. The mean time is the clock's offset. One
// of first order with a time constant T has s = T, a mean over a window W has s = W / sqrt(12).
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"

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
// Less than this share of a count: the steps in which a coarse encoder shows a smooth start do as much.
constexpr double kCounts = 0.5;

double largest_radius_m(const std::vector<DriveView>& views) {
  double radius_m = 0.0;
  for (const DriveView& v : views)
    radius_m = std::max({radius_m, v.drive.wheel_radius_left_m, v.drive.wheel_radius_right_m});
  return radius_m;
}

// How far a rim is moved in the tenth of the time in which it is moved furthest.
double moves_m(double variance_s2, const std::vector<DriveView>& views) {
  std::vector<double> moved;
  for (const DriveView& v : views)
    for (const EffectStep& s : v.steps) {
      const BodyMotion m = ahead(s, v.drive.wheelbase_m);
      moved.push_back(variance_s2 * std::max(std::hypot(m.forward_m, m.sideways_m),
                                             0.5 * v.drive.wheelbase_m * std::abs(m.turn_rad)));
    }
  if (moved.empty()) return 0.0;
  const auto tenth = moved.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(moved.size()));
  std::nth_element(moved.begin(), tenth, moved.end());
  return *tenth;
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
  e.motions = [](const DriveView& view, const std::vector<double>&) {
    if (view.from_commands) return std::vector<Motions>{Motions()};  // a base that lags behind them is the same
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
    return std::vector<Motions>{m};
  };
  e.beyond_counts = [](const std::vector<double>& value, const std::vector<double>&, double count_rad,
                       const std::vector<DriveView>& views) {
    return moves_m(value[0], views) > kCounts * count_rad * largest_radius_m(views);
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

}  // namespace odolab::effects
