#include "core/diagnosis/generic/late_truth.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/parallel.h"
#include "core/diagnosis/effects/floor.h"
#include "core/diagnosis/generic/hats.h"

namespace odolab {

namespace {

// How late, in seconds of an amplitude each.
using Lateness = std::function<void(const EffectStep&, std::vector<double>&)>;

// A truth that is `late_s` behind is where the vehicle was: the way back along its velocity, which changes from step to
// step.
std::vector<Motions> motions_of_lateness(const DriveView& view, const Lateness& lateness, std::size_t count) {
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

constexpr std::size_t kHatsOfLateness = 8, kHatsOfEach = 5, kPolynomials = 5, kOfMotion = 2;

Hats hats_until(double end_s, std::size_t count) {
  std::vector<double> at_s;
  for (std::size_t k = 0; k < count; ++k)
    at_s.push_back(end_s * static_cast<double>(k) / static_cast<double>(count - 1));
  return Hats(std::move(at_s));
}

Lateness by_time(const Hats& hats) {
  return [hats](const EffectStep& s, std::vector<double>& out) {
    const Hats::Shares shares = hats.of(s.since_start_s);
    std::fill(out.begin(), out.end(), 0.0);
    out[shares.first] = shares.of_first;
    out[shares.first + 1] = shares.of_next;
  };
}

Lateness late_by_place(Vec2 middle, double half_m) {
  return [=](const EffectStep& s, std::vector<double>& out) {
    const double u = (s.position.x_m - middle.x_m) / half_m, v = (s.position.y_m - middle.y_m) / half_m;
    out = {u, v, u * u, u * v, v * v};
  };
}

// What is reckoned from a picture or a scan takes longer where more of it moves.
void by_motion(const EffectStep& s, std::vector<double>& out) {
  out = {std::abs(s.yaw_rate_radps), std::abs(s.speed_mps)};
}

// A clock that is set anew steps at another time in each recording.
GenericTest late_in_each(const AskedModel& asked, double looked_at) {
  const std::vector<DriveView>& views = asked.joint.views();
  std::vector<Hats> hats;
  for (const DriveView& v : views)
    hats.push_back(hats_until(v.steps.empty() ? 1.0 : v.steps.back().since_start_s, kHatsOfEach));
  const auto motions = [hats](const DriveView& view, const std::vector<double>&) {
    const auto run = static_cast<std::size_t>(view.number);
    if (run >= hats.size())  // a run that was not fitted
      return std::vector<Motions>(hats.size() * kHatsOfEach, Motions(view.steps.size()));
    std::vector<Motions> out(hats.size() * kHatsOfEach);
    std::vector<Motions> of_run = motions_of_lateness(view, by_time(hats[run]), kHatsOfEach);
    std::move(of_run.begin(), of_run.end(), out.begin() + static_cast<std::ptrdiff_t>(run * kHatsOfEach));
    return out;
  };
  GenericTest t =
      asked_of(asked, "time, in each recording", "truth late by [s]", views.size() * kHatsOfEach, motions, looked_at);
  t.is_of_the_clock = true;
  return t;
}

}  // namespace

std::vector<GenericTest> late_truth_tests(const AskedModel& asked, double looked_at) {
  const std::vector<DriveView>& views = asked.joint.views();
  const FloorSeen floor = floor_of(views);
  const double half_m = 0.5 * std::max(floor.width_m(), floor.height_m());
  double end_s = 0.0;
  for (const DriveView& v : views)
    if (!v.steps.empty()) end_s = std::max(end_s, v.steps.back().since_start_s);
  if (half_m < 1e-3 || end_s <= 0.0) return {};
  const Vec2 middle = 0.5 * (floor.low + floor.high);
  struct Asked {
    const char* variable;
    std::size_t amplitudes;
    Lateness lateness;
    std::vector<double> at;
  };
  const Hats hats = hats_until(end_s, kHatsOfLateness);
  const std::vector<Asked> all = {{"time since the start [s]", kHatsOfLateness, by_time(hats), hats.at()},
                                  {"place on the floor", kPolynomials, late_by_place(middle, half_m), {}},
                                  {"yaw rate and speed", kOfMotion, by_motion, {}}};
  std::vector<GenericTest> tests(all.size());
  parallel_for(static_cast<int>(all.size()), [&](int i) {
    const auto& [variable, amplitudes, lateness, at] = all[static_cast<std::size_t>(i)];
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    t = asked_of(
        asked, variable, "truth late by [s]", amplitudes,
        [of = lateness, count = amplitudes](const DriveView& view, const std::vector<double>&) {
          return motions_of_lateness(view, of, count);
        },
        looked_at);
    t.at = at;
    t.is_of_the_clock = !at.empty();
  });
  if (views.size() > 1) tests.push_back(late_in_each(asked, looked_at));
  return tests;
}

}  // namespace odolab
