// After the direction of travel reverses the castors swivel round and push the vehicle aside, over a few centimetres.
#include <algorithm>

#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

// Way back that counts as a reversal: a castor's trail is several times that, and less is the trembling of a turn on the
// spot.
constexpr double kReversed_m = 0.01;

class CastorReversalKick final : public Effect {
 public:
  CastorReversalKick(const ActiveEffect& a, double step_s)
      : kick_rad_(a.parameter("kick_rad")), over_m_(a.parameter("over_m", 0.05)), step_s_(step_s) {}

  void creep(const VehicleMotion& motion, Creep& creep) override {
    travelled_m_ += motion.rolled_speed_mps * step_s_;
    find_reversal();
    const double before = given_;
    const double u = std::clamp(std::abs(travelled_m_ - reversed_at_m_) / over_m_, 0.0, 1.0);
    given_ = reversed_ ? std::max(given_, 0.5 * (1.0 - std::cos(kPi * u))) : given_;
    creep.yaw_rate_radps += kick_rad_ * (given_ - before) / step_s_;
  }

 private:
  void find_reversal() {
    if (direction_ == 0) {
      if (std::abs(travelled_m_) > kReversed_m) direction_ = travelled_m_ > 0.0 ? 1 : -1;
      furthest_m_ = travelled_m_;
    } else if (direction_ * (travelled_m_ - furthest_m_) > 0.0) {
      furthest_m_ = travelled_m_;
    } else if (direction_ * (furthest_m_ - travelled_m_) > kReversed_m) {
      direction_ = -direction_;
      reversed_at_m_ = furthest_m_ = travelled_m_;
      reversed_ = true;
      given_ = 0.0;
    }
  }

  double kick_rad_, over_m_, step_s_;
  double travelled_m_ = 0.0, furthest_m_ = 0.0, reversed_at_m_ = 0.0;
  int direction_ = 0;
  bool reversed_ = false;
  double given_ = 0.0;  // share of the kick
};

}  // namespace

std::unique_ptr<Effect> castor_reversal_kick(const ActiveEffect& active, const Machine& machine) {
  return std::make_unique<CastorReversalKick>(active, machine.step_s);
}

}  // namespace odolab::planar
