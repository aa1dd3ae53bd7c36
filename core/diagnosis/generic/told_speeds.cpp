#include "core/diagnosis/generic/told_speeds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/base/parallel.h"
#include "core/diagnosis/generic/hats.h"

namespace odolab {

namespace {

// Of a motion that is told, its speed and its way in a step.
using Told = std::function<double(const EffectStep&)>;

// Where hats stand, as shares of the fastest: closer where a base is deaf to what is small.
constexpr double kAt[] = {0.0, 0.06, 0.12, 0.2, 0.35, 0.5, 0.65, 0.8, 1.0};

Hats hats_over_told(const std::vector<DriveView>& views, const std::vector<Told>& told) {
  double fastest = 0.0;
  for (const DriveView& v : views)
    for (const EffectStep& s : v.steps)
      for (const Told& way : told)
        if (s.duration_s > 0.0) fastest = std::max(fastest, std::abs(way(s)) / s.duration_s);
  std::vector<double> at;
  if (fastest > 0.0)
    for (const double share : kAt) at.push_back(share * fastest);
  return Hats(std::move(at));
}

// What goes further by its own speed: a wheel, or the base in one of its two motions.
struct Law {
  Told told;
  std::function<BodyMotion(double way, const DriveView& view)> motion;
};

// Up to such yaw rates what is told on a straight may be all that a driver steers with against the turns of the wheels'
// noise: then nothing comes of it, since the noise was there first.
double steered_radps(const JointModel& joint) {
  constexpr double kSigmas = 3.0, kOver_m = 1.0;
  const FittedNoise& noise = joint.model.noise;
  double fastest_mps = 0.0;
  for (const DriveView& v : joint.views())
    for (const EffectStep& s : v.steps) fastest_mps = std::max(fastest_mps, std::abs(s.speed_mps));
  const double turn_rad_per_sqrt_m = std::sqrt(2.0 * noise.wheel_m_per_sqrt_m * noise.wheel_m_per_sqrt_m +
                                               4.0 * noise.turning_m_per_sqrt_m * noise.turning_m_per_sqrt_m) /
                                     joint.model.drive.wheelbase_m;
  return kSigmas * turn_rad_per_sqrt_m / std::sqrt(kOver_m) * fastest_mps;
}

// Laws that share their hats are one.
std::shared_ptr<Effect> term_of(const std::vector<std::pair<std::vector<Law>, Hats>>& laws) {
  auto term = std::make_shared<Effect>();
  std::size_t count = 0;
  for (const auto& [of, hats] : laws) count += hats.size();
  term->amplitudes.resize(count);
  term->motions = [laws](const DriveView& view, const std::vector<double>&) {
    std::vector<Motions> out;
    for (const auto& [of, hats] : laws)
      for (std::size_t k = 0; k < hats.size(); ++k) {
        Motions motions(view.steps.size());
        for (std::size_t i = 0; i < view.steps.size(); ++i)
          for (const Law& law : of) {
            const EffectStep& s = view.steps[i];
            const double way = law.told(s);
            if (way == 0.0 || s.duration_s <= 0.0) continue;
            const BodyMotion m = law.motion(way * hats.of(k, std::abs(way) / s.duration_s), view);
            motions[i].forward_m += m.forward_m;
            motions[i].turn_rad += m.turn_rad;
          }
        out.push_back(std::move(motions));
      }
    return out;
  };
  return term;
}

// What hats that begin with `first` of so many come to.
GenericCurve curve_over_told(const Hats& hats, std::size_t first, std::size_t count, const char* variable,
                             const char* channel) {
  GenericCurve curve{variable, channel, hats.at(), {}};
  for (std::size_t k = 0; k < hats.size(); ++k) {
    curve.basis.emplace_back(count, 0.0);
    curve.basis.back()[first + k] = 1.0;
  }
  return curve;
}

}  // namespace

std::vector<GenericTest> told_speed_tests(const AskedModel& asked, double looked_at) {
  const std::vector<DriveView>& views = asked.joint.views();
  if (!std::all_of(views.begin(), views.end(), [](const DriveView& v) { return v.from_commands; })) return {};
  // What is told for a moment is obeyed for another time where changes are acted on so unevenly.
  constexpr double kMostUneven_s = 0.05;
  if (asked.joint.model.noise.command_timing_s > kMostUneven_s) return {};
  const auto of_wheel = [](Wheel wheel) {
    return [wheel](double way, const DriveView& view) { return by_wheel(wheel, way, view.drive.wheelbase_m); };
  };
  const std::vector<Law> wheels = {{[](const EffectStep&s) { return s.told_left_m(); }, of_wheel(Wheel::left)},
                                   {[](const EffectStep&s) { return s.told_right_m(); }, of_wheel(Wheel::right)}},
                         forward = {{[](const EffectStep&s) { return s.told_forward_m(); },
                                     [](double way, const DriveView&) {
                                       return BodyMotion{way, 0.0, 0.0};
                                     }}},
                         turn = {{[steered_radps = steered_radps(asked.joint)](const EffectStep&s) {
                                    const double steered_rad = steered_radps * s.duration_s;
                                    return s.told_turn_rad() - std::clamp(s.told_turn_rad(), -steered_rad, steered_rad);
                                  },
                                  [](double way, const DriveView&) {
                                    return BodyMotion{0.0, 0.0, way};
                                  }}};
  const auto hats = [&](const std::vector<Law>& laws) {
    std::vector<Told> told;
    for (const Law& law : laws) told.push_back(law.told);
    return hats_over_told(views, told);
  };
  std::vector<GenericTest> tests(kToldSpeedTests);
  parallel_for(kToldSpeedTests, [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    const bool of_wheels = i == 0;
    t.variable = of_wheels ? "the speed that the wheel is told [m/s]" : "the speed and yaw rate that it is told";
    t.channel = of_wheels ? "way of each wheel per metre [1]" : "forward and turn, as shares of what it is told [1]";
    const Hats speeds = hats(of_wheels ? wheels : forward), rates = hats(turn);
    const std::shared_ptr<Effect> term =
        of_wheels ? term_of({{wheels, speeds}}) : term_of({{forward, speeds}, {turn, rates}});
    term->name = t.variable;
    term->component = t.channel;
    if (term->amplitudes.empty()) return;
    ask(t, asked, term, looked_at);
    const std::size_t count = term->amplitudes.size();
    t.curves = {curve_over_told(
        speeds, 0, count, of_wheels ? "speed of a wheel as it is told [m/s]" : "speed as it is told [m/s]",
        of_wheels ? "way of the wheel, as a share more [1]" : "way forward, as a share more [1]")};
    if (!of_wheels)
      t.curves.push_back(
          curve_over_told(rates, speeds.size(), count, "yaw rate as it is told [rad/s]", "turn, as a share more [1]"));
  });
  return tests;
}

}  // namespace odolab
