#include "core/diagnosis/generic/wobbling_wheels.h"

#include <cmath>
#include <utility>

#include "core/base/parallel.h"

namespace odolab {

namespace {

std::vector<Motions> motions_of_wobble(const DriveView& view, Wheel wheel, std::size_t runs) {
  std::vector<Motions> out(2 * runs);
  const auto run = static_cast<std::size_t>(view.number);
  if (run >= runs) return out;  // one that was not fitted: its phase is not known
  Motions cosine(view.steps.size()), sine(view.steps.size());
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    const double angle_rad = wheel == Wheel::left ? s.left_rad : s.right_rad;
    cosine[i].turn_rad = std::cos(angle_rad) * s.turn_rad;
    sine[i].turn_rad = std::sin(angle_rad) * s.turn_rad;
  }
  out[2 * run] = std::move(cosine);
  out[2 * run + 1] = std::move(sine);
  return out;
}

}  // namespace

std::vector<GenericTest> wobbling_wheel_tests(const AskedModel& asked, double looked_at) {
  const std::size_t runs = asked.joint.views().size();
  std::vector<GenericTest> tests(kWobblingWheelTests);
  parallel_for(kWobblingWheelTests, [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    const Wheel wheel = i == 0 ? Wheel::left : Wheel::right;
    t = asked_of(
        asked, std::string("the ") + (wheel == Wheel::left ? "left" : "right") + " wheel's angle, once a turn",
        name_of_channel(kTurnOfItself), 2 * runs,
        [=](const DriveView& view, const std::vector<double>&) { return motions_of_wobble(view, wheel, runs); },
        looked_at);
    t.component = component_of(wheel);
    for (std::size_t r = 0; r < runs; ++r)
      t.waves.push_back({"phase of " + t.variable + (runs > 1 ? ", recording " + std::to_string(r + 1) : "") + " [rad]",
                         {2 * r},
                         {2 * r + 1}});
  });
  return tests;
}

}  // namespace odolab
