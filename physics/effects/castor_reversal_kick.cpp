// After the direction of travel reverses the castors swivel round and push the vehicle aside, over a few centimetres.
#include <algorithm>

#include "core/diagnosis/effects/forms.h"
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

// Way back that counts as a reversal: a castor's trail is several times that, and less is the trembling of a turn on
// the spot.
constexpr double kReversed_m = 0.01;

// The way, and where it turns back.
struct Travel {
  double travelled_m = 0.0, furthest_m = 0.0, reversed_at_m = 0.0;
  int direction = 0;  // not known yet

  // True in the step in which it is sure to have turned back.
  bool goes(double way_m) {
    travelled_m += way_m;
    if (direction == 0) {
      if (std::abs(travelled_m) > kReversed_m) direction = travelled_m > 0.0 ? 1 : -1;
      furthest_m = travelled_m;
    } else if (direction * (travelled_m - furthest_m) > 0.0) {
      furthest_m = travelled_m;
    } else if (direction * (furthest_m - travelled_m) > kReversed_m) {
      direction = -direction;
      reversed_at_m = furthest_m = travelled_m;
      return true;
    }
    return false;
  }
};

class CastorReversalKick final : public Effect {
 public:
  CastorReversalKick(const ActiveEffect& a, double step_s)
      : kick_rad_(a.parameter("kick_rad")), over_m_(a.parameter("over_m", 0.05)), step_s_(step_s) {}

  void creep(const VehicleMotion& motion, Creep& creep) override {
    if (travel_.goes(motion.rolled_speed_mps * step_s_)) {
      reversed_ = true;
      given_ = 0.0;
    }
    const double before = given_;
    const double u = std::clamp(std::abs(travel_.travelled_m - travel_.reversed_at_m) / over_m_, 0.0, 1.0);
    given_ = reversed_ ? std::max(given_, 0.5 * (1.0 - std::cos(kPi * u))) : given_;
    creep.yaw_rate_radps += kick_rad_ * (given_ - before) / step_s_;
  }

 private:
  double kick_rad_, over_m_, step_s_;
  Travel travel_;
  bool reversed_ = false;
  double given_ = 0.0;  // share of the kick
};

// In one of the forms. What the castors push the vehicle with comes from the floor, and not from its wheels.
class CastorReversalKickInForm final : public Effect {
 public:
  CastorReversalKickInForm(const ActiveEffect& a, int form, double step_s)
      : kick_rad_(a.parameter("kick_rad")), form_(effects::kKickForms[form]), step_s_(step_s) {}

  void creep(const VehicleMotion& motion, Creep& creep) override {
    const double share = form_.course == effects::KickCourse::shortly ? by_the_time(motion) : by_the_way(motion);
    const double rate_radps = kick_rad_ * share / step_s_;
    creep.yaw_rate_radps += rate_radps;
    creep.push_radps2 += (rate_radps - rate_radps_) / step_s_;
    rate_radps_ = rate_radps;
  }

 private:
  // The shares of the kick that it is given in this step.
  double by_the_way(const VehicleMotion& motion) {
    const double before_m = travel_.furthest_m;
    double way_m;
    if (travel_.goes(motion.rolled_speed_mps * step_s_)) {
      begin();
      // A castor swings from the first on, which shows a centimetre later.
      way_m = form_.course == effects::KickCourse::evenly && form_.length_m > kReversed_m ? 0.0 : kReversed_m;
    } else {
      way_m = std::abs(travel_.furthest_m - before_m);
    }
    return left_ > 0.0 && way_m > 0.0 ? sign_ * swung(way_m) : 0.0;
  }

  void begin() {
    const bool turned_back =
        form_.course == effects::KickCourse::of_a_castor && left_ > effects::kCastorRound;  // before it was round
    sense_ = turned_back ? -sense_ : 1.0;
    left_ = turned_back ? 1.0 - left_ : 1.0;
    sign_ = form_.to_one_side ? sense_ : travel_.direction;
  }

  double swung(double way_m) {
    double by = 0.0;
    switch (form_.course) {
      case effects::KickCourse::evenly:
        by = std::min(left_, way_m / form_.length_m);
        break;
      case effects::KickCourse::fading:
        by = left_ * -std::expm1(-way_m / form_.length_m);
        break;
      case effects::KickCourse::of_a_castor: {
        constexpr int kParts = 20;
        for (int k = 0; k < kParts; ++k)
          by += std::min(left_ - by,
                         way_m / kParts / form_.length_m * (std::sin(kPi * (left_ - by)) + effects::kCastorOff) / kPi);
        break;
      }
      case effects::KickCourse::shortly:
        break;
    }
    left_ -= by;
    return by;
  }

  double by_the_time(const VehicleMotion& motion) {
    constexpr double kSmoothed_s = 0.03;
    speed_mps_ += std::min(1.0, step_s_ / kSmoothed_s) * (motion.rolled_speed_mps - speed_mps_);
    const int now = speed_mps_ > effects::kLeastSwing_mps ? 1 : speed_mps_ < -effects::kLeastSwing_mps ? -1 : 0;
    if (now != 0 && travel_.direction != 0 && now != travel_.direction) left_ += 1.0;
    if (now != 0) travel_.direction = now;
    const double by = std::min(left_, std::ceil(left_) * step_s_ / effects::kShortKick_s);
    left_ -= by;
    return by;
  }

  double kick_rad_;
  effects::KickForm form_;
  double step_s_;
  Travel travel_;
  double left_ = 0.0;  // of the kick; of a castor, of half a turn
  double sense_ = 1.0, sign_ = 1.0;
  double speed_mps_ = 0.0, rate_radps_ = 0.0;
};

}  // namespace

std::unique_ptr<Effect> castor_reversal_kick(const ActiveEffect& active, const Machine& machine) {
  if (const std::optional<int> form = form_of(active))
    return std::make_unique<CastorReversalKickInForm>(active, *form, machine.step_s);
  return std::make_unique<CastorReversalKick>(active, machine.step_s);
}

}  // namespace odolab::planar
