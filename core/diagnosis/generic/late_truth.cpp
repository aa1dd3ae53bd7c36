#include "core/diagnosis/generic/late_truth.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/parallel.h"
#include "core/diagnosis/generic/floor.h"

namespace odolab {

namespace {

// How late, in seconds of an amplitude each.
using Lateness = std::function<void(const EffectStep&, std::vector<double>&)>;

// A truth that is `late_s` behind is where the vehicle was: the way back along its velocity, which changes from step to
// step.
std::vector<Motions> motions_of(const DriveView& view, const Lateness& lateness, std::size_t count) {
  const std::size_t n = view.steps.size();
  std::vector<Motions> out(count, Motions(n));
  std::vector<double> now(count), before(count, 0.0);
  for (std::size_t i = 1; i < n; ++i) {
    const EffectStep &s = view.steps[i], &last = view.steps[i - 1];
    if (i == 1) lateness(last, before);
    lateness(s, now);
    for (std::size_t k = 0; k < count; ++k)
      out[k][i] = {before[k] * last.speed_mps - now[k] * s.speed_mps, 0.0,
                   before[k] * last.yaw_rate_radps - now[k] * s.yaw_rate_radps};
    std::swap(now, before);
  }
  return out;
}

constexpr std::size_t kHats = 8, kPolynomials = 5;

void add_hats(double at, double end, std::vector<double>& out) {
  const double place = std::clamp(at / end, 0.0, 1.0) * (kHats - 1);
  const auto k = std::min(static_cast<std::size_t>(place), kHats - 2);
  std::fill(out.begin(), out.end(), 0.0);
  out[k] = 1.0 - (place - static_cast<double>(k));
  out[k + 1] = place - static_cast<double>(k);
}

}  // namespace

std::vector<GenericTest> late_truth_tests(const AskedModel& asked, double looked_at) {
  const std::vector<DriveView>& views = asked.joint.views();
  const Floor floor = floor_of(views);
  const double half_m = 0.5 * std::max(floor.width_m(), floor.height_m());
  double end_s = 0.0;
  for (const DriveView& v : views)
    if (!v.steps.empty()) end_s = std::max(end_s, v.steps.back().since_start_s);
  if (half_m < 1e-3 || end_s <= 0.0) return {};
  const Vec2 middle = 0.5 * (floor.low + floor.high);
  std::vector<GenericTest> tests(kLateTruthTests);
  parallel_for(kLateTruthTests, [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    const bool by_time = i == 0;
    const std::size_t count = by_time ? kHats : kPolynomials;
    const Lateness lateness =
        by_time
            ? Lateness([=](const EffectStep& s, std::vector<double>& out) { add_hats(s.since_start_s, end_s, out); })
            : Lateness([=](const EffectStep& s, std::vector<double>& out) {
                const double u = (s.position.x_m - middle.x_m) / half_m, v = (s.position.y_m - middle.y_m) / half_m;
                out = {u, v, u * u, u * v, v * v};
              });
    t.variable = by_time ? "time since the start [s]" : "place on the floor";
    t.channel = "truth late by [s]";
    if (by_time)
      for (std::size_t k = 0; k < kHats; ++k) t.at.push_back(end_s * static_cast<double>(k) / (kHats - 1));
    auto term = std::make_shared<Effect>();
    term->name = t.variable;
    term->component = t.channel;
    term->amplitudes.resize(count);
    term->motions = [=](const DriveView& view, const std::vector<double>&) {
      return motions_of(view, lateness, count);
    };
    ask(t, asked, term, looked_at);
  });
  return tests;
}

}  // namespace odolab
