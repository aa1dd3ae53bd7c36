// The radius of a wheel, or of both, grows by a share in proportion to speed.
#include <cmath>
#include <string>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {

Effect growth_of(Wheel wheel) {
  Effect e;
  e.name = "speed_dependent_radius";
  e.component = component_of(wheel);
  e.amplitudes = {{"per_mps", "1/(m/s)", 0.02, -0.3, 0.3}};
  e.tests_of_a_shape = 0.7;  // on straights they are the same
  e.forms = {"with each wheel's own speed", "with the vehicle's speed"};
  e.sentence = wheel == Wheel::both ? "the rolling radius changes with speed"
                                    : std::string("the rolling radius of the ") +
                                          (wheel == Wheel::left ? "left" : "right") + " wheel changes with speed";
  e.regime = "grows with speed";
  e.looks_like = {"encoder_missed_counts", "traction_slip", "turn_scrub", "tyre_compression"};
  e.told_apart_by = "the same straight at two speeds or more";
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    Motions m;
    m.reserve(view.steps.size());
    const DifferentialDrive& drive = view.drive;
    const bool own = shape.back() < 0.5, of_left = wheel != Wheel::right, of_right = wheel != Wheel::left;
    for (const EffectStep& s : view.steps) {
      const double v = std::abs(s.speed_mps);
      const double left_m = s.left_m * (own ? drive.wheel_radius_left_m * std::abs(s.left_radps) : v) * of_left;
      const double right_m = s.right_m * (own ? drive.wheel_radius_right_m * std::abs(s.right_radps) : v) * of_right;
      m.push_back({0.5 * (left_m + right_m), 0.0, (right_m - left_m) / drive.wheelbase_m});
    }
    return motions_by_number(std::move(m));
  };
  return e;
}

}  // namespace

std::vector<Effect> speed_dependent_radius() {
  return {growth_of(Wheel::both), growth_of(Wheel::left), growth_of(Wheel::right)};
}

}  // namespace odolab::effects
