// Something round on the floor, as high as it takes to make the wheel turn so much further than it travels.
#include <algorithm>

#include "core/diagnosis/effects/forms.h"
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

// The height over which a wheel rolls `extra_m` further than it travels; what it can climb ends at its axle.
double height_for(double radius_m, double extra_m) {
  double low_m = 0.0, high_m = radius_m;
  for (int k = 0; k < 60; ++k) {
    const double middle_m = 0.5 * (low_m + high_m);
    (extra_roll_m(radius_m, middle_m) < extra_m ? low_m : high_m) = middle_m;
  }
  return high_m;
}

class BumpOnTheFloor final : public Effect {
 public:
  BumpOnTheFloor(const ActiveEffect& a, const ActualDrive& actual) {
    const Under under = a.component == "left_wheel"    ? Under::left_wheel
                        : a.component == "right_wheel" ? Under::right_wheel
                                                       : Under::any_wheel;
    const double radius_m = under == Under::right_wheel ? actual.wheel_radius_right_m : actual.wheel_radius_left_m;
    bump_.centre = {a.parameter("x_m"), a.parameter("y_m")};
    bump_.length_m = 2.0 * a.parameter("radius_m", 0.1);
    bump_.height_m = height_for(radius_m, a.parameter("extra_distance_m"));
    bump_.under = under;
    bump_.round = true;
  }

  void lay_on(Floor& floor) const override { floor.bumps.push_back(bump_); }

 private:
  Bump bump_;
};

bool happens_once(const ActiveEffect& a) {
  constexpr double kNone = 1e300;
  return a.parameter("at_s", kNone) != kNone;
}

// What a wheel rolls further in one of the forms: at one moment, wherever it is, or each time that it comes to a place.
class BumpInForm final : public Effect {
 public:
  BumpInForm(const ActiveEffect& a, const Machine& machine)
      : component_(a.component),
        extra_m_(a.parameter("extra_distance_m")),
        place_{a.parameter("x_m"), a.parameter("y_m")},
        step_s_(machine.step_s) {
    const int form = form_of(a).value_or(0);
    if (happens_once(a)) {
      at_s_ = a.parameter("at_s");
      lying_.climb = effects::kBumpsOnce[form];
    } else {
      lying_ = effects::kBumpsLying[form];
      lying_.reach_m = a.parameter("radius_m", lying_.reach_m);
    }
  }

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    if (!acts_on(component_, wheel.side)) return;
    Way& way = ways_[wheel.side == Side::left ? 0 : 1];
    const double rim_mps = wheel.radius_m * wheel.speed_radps;
    if (at_s_)
      come_to_its_moment(way, motion, rim_mps, wheel.radius_m);
    else
      come_to_its_place(way, motion, wheel, rim_mps < 0.0);
    if (!way.is_on || rim_mps == 0.0) return;
    const double before = lying_.climb.share_before(way.rolled_m / way.length_m);
    way.rolled_m = std::min(way.length_m, way.rolled_m + std::abs(rim_mps) * step_s_);
    const double now = lying_.climb.share_before(way.rolled_m / way.length_m);
    wheel.slip_mps += std::copysign(extra_m_ * (now - before) / step_s_, rim_mps);
    way.is_on = way.rolled_m < way.length_m;
  }

 private:
  struct Way {
    bool is_on = false, is_done = false;  // done: until it has left the place
    double length_m = 0.0, rolled_m = 0.0;
  };

  // It cannot roll further than it turns.
  void begin(Way& way, double length_m) const { way = {true, true, std::max(length_m, 1.05 * extra_m_), 0.0}; }

  // The moment is in the middle of the way over it.
  void come_to_its_moment(Way& way, const VehicleMotion& motion, double rim_mps, double radius_m) const {
    const double length_m = lying_.climb.length_m(radius_m), still_s = *at_s_ - motion.time_s;
    if (still_s < -effects::kLongestBump_s) way.is_on = false;
    if (way.is_done || still_s < 0.0 || still_s > effects::kLongestBump_s) return;
    if (std::abs(rim_mps) * still_s <= 0.5 * length_m) begin(way, length_m);
  }

  void come_to_its_place(Way& way, const VehicleMotion& motion, const RollingWheel& wheel, bool in_reverse) const {
    const double heading_rad = motion.heading_rad + (in_reverse ? kPi : 0.0);
    const Vec2 to = rotated(place_ - wheel.contact, -heading_rad);
    const double beside2_m2 = lying_.reach_m * lying_.reach_m - to.y_m * to.y_m;
    const double half_m = beside2_m2 > 0.0 ? std::sqrt(beside2_m2) : 0.0;  // of the way within its reach
    double length_m = lying_.climb.length_m(wheel.radius_m), from_m = half_m;
    if (length_m == 0.0)
      length_m = 2.0 * half_m + extra_m_;
    else if (!lying_.at_its_edge)
      from_m = std::max(0.0, 0.5 * (length_m - extra_m_));
    const bool is_there = half_m > 0.0 && std::abs(to.x_m) <= from_m;
    if (is_there && !way.is_done && length_m > 0.01) begin(way, length_m);
    if (!is_there && !way.is_on && std::abs(to.x_m) > half_m) way.is_done = false;
  }

  std::string component_;
  double extra_m_;
  Vec2 place_;
  double step_s_;
  std::optional<double> at_s_;
  effects::Lying lying_{};
  Way ways_[2];
};

}  // namespace

std::unique_ptr<Effect> bump(const ActiveEffect& active, const Machine& machine) {
  if (form_of(active) || happens_once(active)) return std::make_unique<BumpInForm>(active, machine);
  return std::make_unique<BumpOnTheFloor>(active, machine.actual);
}

}  // namespace odolab::planar
