// A push from outside: a force that takes the vehicle aside and lets it come to rest there, while the wheels slide.
#include <algorithm>

#include "core/diagnosis/effects/forms.h"
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

double lasts_in_form_s(const ActiveEffect& a) {
  constexpr double kAtOnce_s = 0.01;
  return std::max(kAtOnce_s, effects::kCollisionLasts_s[form_of(a).value_or(1)]);
}

class Collision final : public Effect {
 public:
  Collision(const ActiveEffect& a, double step_s)
      : way_{a.parameter("dx_m"), a.parameter("dy_m"), a.parameter("dheading_rad")},
        lasts_s_(a.parameter("lasts_s", lasts_in_form_s(a))),
        begins_s_(a.parameter("at_s") - 0.5 * lasts_s_),
        step_s_(step_s) {}

  void creep(const VehicleMotion& motion, Creep& creep) override {
    // Share of the way at the step's end, a raised cosine over the push; its rise is the speed that the vehicle is
    // given.
    const double u = std::clamp((motion.time_s + 0.5 * step_s_ - begins_s_) / lasts_s_, 0.0, 1.0);
    const double share = 0.5 * (1.0 - std::cos(kPi * u));
    const double rate = (share - share_) / step_s_, change = (rate - rate_) / step_s_;
    share_ = share;
    rate_ = rate;
    const Vec2 ahead = rotated(way_.position(), -motion.heading_rad);
    creep.velocity_mps = creep.velocity_mps + rate * ahead;
    creep.yaw_rate_radps += rate * way_.heading_rad;
    creep.push_mps2 = creep.push_mps2 + change * ahead;
    creep.push_radps2 += change * way_.heading_rad;
  }

 private:
  Pose way_;  // in the floor's frame
  double lasts_s_, begins_s_, step_s_;
  double share_ = 0.0, rate_ = 0.0;
};

}  // namespace

std::unique_ptr<Effect> collision(const ActiveEffect& active, const Machine& machine) {
  return std::make_unique<Collision>(active, machine.step_s);
}

}  // namespace odolab::planar
