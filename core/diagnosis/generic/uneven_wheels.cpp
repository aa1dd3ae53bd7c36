#include "core/diagnosis/generic/uneven_wheels.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/diagnosis/generic/counted.h"

namespace odolab {

namespace {

// Sine and cosine for each recording: the way that the wheel goes further, for each metre of its own.
std::vector<Motions> motions_of_wheel(const DriveView& view, Wheel wheel, int times_a_turn, std::size_t runs) {
  std::vector<Motions> out(2 * runs);
  const auto run = static_cast<std::size_t>(view.number);
  if (run >= runs) return out;  // one that was not fitted: its phase is not known
  const bool left = wheel == Wheel::left;
  Motions cosine(view.steps.size()), sine(view.steps.size());
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    const double angle = times_a_turn * (left ? s.left_rad : s.right_rad), way_m = left ? s.left_m : s.right_m;
    cosine[i] = by_wheel(wheel, std::cos(angle) * way_m, view.drive.wheelbase_m);
    sine[i] = by_wheel(wheel, std::sin(angle) * way_m, view.drive.wheelbase_m);
  }
  out[2 * run] = std::move(cosine);
  out[2 * run + 1] = std::move(sine);
  return out;
}

}  // namespace

std::vector<GenericTest> uneven_wheel_tests(const AskedModel& asked, double looked_at) {
  const std::size_t runs = asked.joint.views().size();
  std::vector<GenericTest> tests(kUnevenWheelTests);
  parallel_for(kUnevenWheelTests, [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    const Wheel wheel = i % 2 == 0 ? Wheel::left : Wheel::right;
    const int times_a_turn = i < 2 ? 2 : 3;
    t = asked_of(
        asked, std::string("its angle, ") + (times_a_turn == 2 ? "twice" : "three times") + " a turn",
        std::string("way of the ") + (wheel == Wheel::left ? "left" : "right") + " wheel per metre [1]", 2 * runs,
        [=](const DriveView& view, const std::vector<double>&) {
          return motions_of_wheel(view, wheel, times_a_turn, runs);
        },
        looked_at);
    t.times_a_turn = times_a_turn;
    leave_to_counting(t, asked.joint);
    for (std::size_t r = 0; r < runs; ++r)
      t.waves.push_back({"phase of " + t.variable + (runs > 1 ? ", recording " + std::to_string(r + 1) : "") + " [rad]",
                         {2 * r},
                         {2 * r + 1}});
  });
  return tests;
}

}  // namespace odolab
