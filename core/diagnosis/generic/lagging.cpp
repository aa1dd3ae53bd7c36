#include "core/diagnosis/generic/lagging.h"

#include "core/base/parallel.h"

namespace odolab {

namespace {

std::vector<Motions> of_a_late_wheel(const DriveView& view, const std::vector<double>&) {
  Motions late(view.steps.size());
  for (std::size_t i = 0; i < view.steps.size(); ++i)
    late[i] = by_wheel(Wheel::right, view.steps[i].right_mps2 * view.steps[i].duration_s, view.drive.wheelbase_m);
  return {late};
}

std::vector<Motions> of_a_bending_mast(const DriveView& view, const std::vector<double>&) {
  const std::size_t n = view.steps.size();
  Motions ahead(n), aside(n);
  const auto lateral_mps2 = [](const EffectStep& s) { return s.speed_mps * s.yaw_rate_radps; };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const EffectStep &before = view.steps[i - 1], &behind = view.steps[i + 1];
    ahead[i].forward_m = 0.5 * (behind.acceleration_mps2 - before.acceleration_mps2);
    aside[i].sideways_m = 0.5 * (lateral_mps2(behind) - lateral_mps2(before));
  }
  return {ahead, aside};
}

}  // namespace

std::vector<GenericTest> lagging_tests(const AskedModel& asked, double looked_at) {
  std::vector<GenericTest> tests(kLaggingTests);
  parallel_for(kLaggingTests, [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    auto term = std::make_shared<Effect>();
    term->name = t.variable = i == 0 ? "acceleration, as if it were read later" : "acceleration, as if its mast bent";
    term->component = t.channel = i == 0 ? "way of the right wheel [s]" : "marker, ahead and aside [s2]";
    term->amplitudes.resize(i == 0 ? 1 : 2);
    term->motions = i == 0 ? of_a_late_wheel : of_a_bending_mast;
    ask(t, asked, term, looked_at);
  });
  return tests;
}

}  // namespace odolab
