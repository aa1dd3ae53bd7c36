// Once-per-turn error: the rolled distance is (1 + amplitude sin(rotation + phase)) of the even one.
#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {
Effect out_of_round(Wheel wheel) {
  Effect e;
  e.name = "wheel_eccentricity";
  e.component = component_of(wheel);
  e.sentence = std::string("the ") + (wheel == Wheel::left ? "left" : "right") +
               " wheel, or its encoder, runs out of round: it errs once per turn";
  e.regime = "once per turn of the wheel";
  e.looks_like = {"wheel_eccentricity"};
  e.told_apart_by = "arcs, which shift the phase of one wheel against the other";
  return e;
}

std::vector<Motions> sine_and_cosine(const DriveView& view, Wheel wheel) {
  Motions sine, cosine;
  sine.reserve(view.steps.size()), cosine.reserve(view.steps.size());
  for (const EffectStep& s : view.steps) {
    const double phi = wheel == Wheel::left ? s.left_rad : s.right_rad;
    const double d = wheel == Wheel::left ? s.left_m : s.right_m;
    sine.push_back(by_wheel(wheel, d * std::sin(phi), view.drive.wheelbase_m));
    cosine.push_back(by_wheel(wheel, d * std::cos(phi), view.drive.wheelbase_m));
  }
  return {sine, cosine};
}

Effect eccentricity_of(Wheel wheel) {
  Effect e = out_of_round(wheel);
  e.amplitudes = {{"sine", "1", 0.005, -0.2, 0.2}, {"cosine", "1", 0.005, -0.2, 0.2}};
  e.motions = [wheel](const DriveView& view, const std::vector<double>&) { return sine_and_cosine(view, wheel); };
  e.to_parameters = [](const std::vector<double>& v, const std::vector<double>& se) {
    const double a = std::hypot(v[0], v[1]);
    const double sa = std::hypot(v[0] * se[0], v[1] * se[1]) / std::max(a, 1e-300);
    const double sp = std::hypot(v[1] * se[0], v[0] * se[1]) / std::max(a * a, 1e-300);
    return std::vector<FoundParameter>{{"amplitude", a, sa, "1"}, {"phase_rad", std::atan2(v[1], v[0]), sp, "rad"}};
  };
  e.from_parameters = [](const ActiveEffect& active) {
    const double a = active.parameter("amplitude"), p = active.parameter("phase_rad");
    return std::vector<double>{a * std::cos(p), a * std::sin(p)};
  };
  return e;
}
Effect of_wheel_in_each_run(Wheel wheel, int runs) {
  Effect e = out_of_round(wheel);
  e.of_each_recording = true;
  for (int r = 0; r < runs; ++r)
    for (const char* name : {"sine", "cosine"}) e.amplitudes.push_back({name, "1", 0.005, -0.2, 0.2});
  e.motions = [wheel, runs](const DriveView& view, const std::vector<double>&) {
    std::vector<Motions> m(2 * static_cast<std::size_t>(runs));
    if (view.number >= runs) return m;
    std::vector<Motions> own = sine_and_cosine(view, wheel);
    for (std::size_t k = 0; k < 2; ++k) m[2 * static_cast<std::size_t>(view.number) + k] = std::move(own[k]);
    return m;
  };
  // The amplitude is the wheel's and the same in all runs.
  e.to_parameters = [](const std::vector<double>& v, const std::vector<double>&) {
    double square = 0.0;
    for (double x : v) square += 2.0 * x * x / static_cast<double>(v.size());
    std::vector<FoundParameter> out{{"amplitude", std::sqrt(square), 0.0, "1"}};
    for (std::size_t r = 0; 2 * r < v.size(); ++r)
      out.push_back({r == 0 ? "phase_rad" : "phase_rad_" + std::to_string(r + 1), std::atan2(v[2 * r + 1], v[2 * r]),
                     0.0, "rad"});
    return out;
  };
  return e;
}
}  // namespace

const std::vector<Effect>& wheel_eccentricity_of_each_run(int runs) {
  static std::map<int, std::vector<Effect>> known;
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  std::vector<Effect>& of = known[runs];
  if (of.empty()) of = {of_wheel_in_each_run(Wheel::left, runs), of_wheel_in_each_run(Wheel::right, runs)};
  return of;
}

std::vector<Effect> wheel_eccentricity() { return {eccentricity_of(Wheel::left), eccentricity_of(Wheel::right)}; }

}  // namespace odolab::effects
