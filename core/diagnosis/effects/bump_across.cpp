// Something straight lies across the way, as a cable or a sill: wherever a wheel crosses it, it turns more than it
// travels.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/climbing.h"
#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/forms.h"

namespace odolab::effects {

namespace {

struct Cable {
  Vec2 middle, along;
  double half_m;

  explicit Cable(const std::vector<double>& shape)
      : middle{shape[0], shape[1]}, along{std::cos(shape[2]), std::sin(shape[2])}, half_m(0.5 * shape[3]) {}
};

// Whichever of two steps in a row is nearer to the cable that lies between them.
std::vector<Climbing> crossings(const DriveView& view, Wheel which, const Cable& cable, const Climb& climb) {
  const double b = view.drive.wheelbase_m;
  std::vector<Climbing> found;
  for (const Wheel wheel : {Wheel::left, Wheel::right}) {
    if (which != Wheel::both && which != wheel) continue;
    const double length_m = climb.length_m(radius_m(wheel, view));
    std::size_t before = view.steps.size();
    double beside_m = 0.0;  // of the step before
    view.steps_near(cable.middle, cable.half_m + 0.5 * b + view.longest_step_m, [&](std::size_t i) {
      const Vec2 from = place_of_wheel(view.steps[i], b, wheel) - cable.middle;
      const double now_m = cross(cable.along, from);
      if (before + 1 == i && (beside_m < 0.0) != (now_m < 0.0) && std::abs(dot(cable.along, from)) < cable.half_m) {
        const std::size_t nearest = std::abs(now_m) < std::abs(beside_m) ? i : before;
        found.push_back({wheel, steps_about(view, wheel, nearest, length_m)});
      }
      before = i;
      beside_m = now_m;
    });
  }
  return found;
}

// Across the way, evenly along all that was driven.
std::vector<std::vector<double>> across_the_way(const std::vector<DriveView>& views) {
  constexpr double kLeast_m = 0.25, kMost = 300.0, kLength_m = 1.0;
  double driven_m = 0.0;
  for (const DriveView& view : views)
    for (const EffectStep& s : view.steps) driven_m += std::abs(s.forward_m());
  const double stride_m = std::max(kLeast_m, driven_m / kMost);
  std::vector<std::vector<double>> cables;
  double since_m = 0.0;
  for (const DriveView& view : views)
    for (const EffectStep& s : view.steps) {
      since_m += std::abs(s.forward_m());
      if (since_m < stride_m) continue;
      since_m = 0.0;
      cables.push_back({s.position.x_m, s.position.y_m, wrapped(s.heading_rad + 0.5 * kPi), kLength_m});
    }
  return cables;
}

std::vector<std::vector<double>> cables_about(Vec2 place) {
  constexpr int kDirections = 8;
  std::vector<std::vector<double>> cables;
  for (int k = 0; k < kDirections; ++k)
    for (const double length_m : {0.4, 1.0, 2.0})
      cables.push_back({place.x_m, place.y_m, k * kPi / kDirections, length_m});
  return cables;
}

Effect across(Wheel wheel) {
  Effect e = bump_of(wheel);
  e.sentence = std::string(wheel == Wheel::both   ? "wheels climb"
                           : wheel == Wheel::left ? "the left wheel climbs"
                                                  : "the right wheel climbs") +
               " over something that lies across the way, wherever it is crossed";
  e.regime = "where one line is crossed";
  e.shapes = {{"x_m", "m"}, {"y_m", "m"}, {"direction_rad", "rad"}, {"length_m", "m", 0.0, 0.05, 20.0}};
  e.forms = {"in 6 cm of way", "in 20 cm", "as a wheel climbs what takes 4 mm", "as a wheel climbs what takes 15 mm"};
  e.form_goes_with = [](const std::vector<double>& value, const std::vector<double>& shape, double,
                        const std::vector<DriveView>&) {
    constexpr double kShortest_m = 0.05, kLongest_m = 20.0;
    return shape[3] > kShortest_m && shape[3] < kLongest_m &&
           is_climbed(value[0], kCablesClimbed[static_cast<int>(shape.back())]);
  };
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    const Climb& climb = kCablesClimbed[static_cast<int>(shape.back())];
    return motions_by_number(motions_of(view, crossings(view, wheel, Cable(shape), climb), climb));
  };
  e.tests_of_a_shape = 2.0;  // each is turned, moved and lengthened
  e.scan = across_the_way;
  e.shapes_about = cables_about;
  return e;
}

}  // namespace

std::vector<Effect> bump_across() { return {across(Wheel::left), across(Wheel::right), across(Wheel::both)}; }

}  // namespace odolab::effects
