// The radius of a wheel, or of both, grows by a share in proportion to speed.
#include <cmath>
#include <string>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/forms.h"

namespace odolab::effects {

namespace {

const SpeedForm& growth_form(const std::vector<double>& shape) { return kSpeedForms[std::lround(shape.back())]; }

// At which the square of a speed says as much of the way as the speed itself, by least squares.
double usual_speed_mps(const std::vector<DriveView>& views) {
  double fourth = 1e-12, third = 0.0;
  for (const DriveView& view : views)
    for (const EffectStep& s : view.steps) {
      const double v = std::abs(s.speed_mps), weight = v * v * s.duration_s;
      third += weight * v, fourth += weight * v * v;
    }
  return third > 0.0 ? fourth / third : 0.0;
}

Effect growth_of(Wheel wheel) {
  Effect e;
  e.name = "speed_dependent_radius";
  e.component = component_of(wheel);
  e.amplitudes = {{"per_mps", "1/(m/s)", 0.02, -0.3, 0.3}};
  e.tests_of_a_shape = 0.5;  // on straights they are the same
  for (const SpeedForm& form : kSpeedForms) e.forms.push_back(form.in_words);
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
    const SpeedForm& form = growth_form(shape);
    const auto grown_m = [&](double way_m, const EffectStep& s, double own_mps) {
      return way_m * form.share(form.of_the_vehicle ? s.speed_mps : own_mps);
    };
    for (const EffectStep& s : view.steps) {
      const double left_m =
          wheel == Wheel::right ? 0.0 : grown_m(s.left_m, s, drive.wheel_radius_left_m * s.left_radps);
      const double right_m =
          wheel == Wheel::left ? 0.0 : grown_m(s.right_m, s, drive.wheel_radius_right_m * s.right_radps);
      m.push_back({0.5 * (left_m + right_m), 0.0, (right_m - left_m) / drive.wheelbase_m});
    }
    return motions_by_number(std::move(m));
  };
  e.stated_at_mps = [](const std::vector<double>& shape, const std::vector<DriveView>& views) {
    return growth_form(shape).squared ? usual_speed_mps(views) : 0.0;
  };
  e.from_parameters = [](const ActiveEffect& a) {
    return std::vector<double>{a.parameter("per_mps") / a.parameter(kStatedAt, 1.0)};
  };
  return e;
}

}  // namespace

std::vector<Effect> speed_dependent_radius() {
  return {growth_of(Wheel::both), growth_of(Wheel::left), growth_of(Wheel::right)};
}

}  // namespace odolab::effects
