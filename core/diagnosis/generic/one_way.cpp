#include "core/diagnosis/generic/one_way.h"

#include <cmath>

namespace odolab {

namespace {

enum class Pace { brakes, speeds_up };

// Slip for one per m/s2 of what the wheels do together.
Motions slips(const DriveView& view, Pace pace) {
  Motions m(view.steps.size());
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    const double forward_mps2 = 0.5 * (s.left_mps2 + s.right_mps2);
    const bool brakes = forward_mps2 * s.speed_mps < 0.0;
    if (brakes == (pace == Pace::brakes)) m[i].forward_m = -std::abs(s.forward_m()) * forward_mps2;
  }
  return m;
}

Motions rolls_in_reverse(const DriveView& view, Wheel wheel) {
  Motions m(view.steps.size());
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    const double way_m = wheel == Wheel::both ? s.forward_m() : wheel == Wheel::left ? s.left_m : s.right_m;
    if (way_m < 0.0) m[i] = by_wheel(wheel, way_m, view.drive.wheelbase_m);
  }
  return m;
}

}  // namespace

std::vector<GenericTest> one_way_tests(const AskedModel& asked, double looked_at) {
  std::vector<GenericTest> tests;
  for (const Pace pace : {Pace::brakes, Pace::speeds_up})
    tests.push_back(asked_of(
        asked, pace == Pace::brakes ? "acceleration, where it brakes alone" : "acceleration, where it speeds up alone",
        "forward per metre [1]", 1,
        [pace](const DriveView& view, const std::vector<double>&) { return motions_by_number(slips(view, pace)); },
        looked_at));
  for (const Wheel wheel : {Wheel::left, Wheel::right, Wheel::both})
    tests.push_back(asked_of(
        asked, "its direction, in reverse alone",
        wheel == Wheel::both   ? "way of both wheels per metre [1]"
        : wheel == Wheel::left ? "way of the left wheel per metre [1]"
                               : "way of the right wheel per metre [1]",
        1,
        [wheel](const DriveView& view, const std::vector<double>&) {
          return motions_by_number(rolls_in_reverse(view, wheel));
        },
        looked_at));
  return tests;
}

}  // namespace odolab
