// Something round on the floor, or something straight as a cable, as high as it takes to make the wheel turn so much
// further than it travels.
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

bool lies_across(const ActiveEffect& a) { return a.parameter("length_m") > 0.0; }

class BumpOnTheFloor final : public Effect {
 public:
  BumpOnTheFloor(const ActiveEffect& a, const ActualDrive& actual) {
    const Under under = a.component == "left_wheel"    ? Under::left_wheel
                        : a.component == "right_wheel" ? Under::right_wheel
                                                       : Under::any_wheel;
    const double radius_m = under == Under::right_wheel ? actual.wheel_radius_right_m : actual.wheel_radius_left_m;
    bump_.centre = {a.parameter("x_m"), a.parameter("y_m")};
    bump_.round = !lies_across(a);
    bump_.length_m = bump_.round ? 2.0 * a.parameter("radius_m", 0.1) : a.parameter("length_m");
    bump_.direction_rad = a.parameter("direction_rad");
    bump_.height_m = height_for(radius_m, a.parameter("extra_distance_m"));
    bump_.under = under;
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
        extra_m_{a.parameter("extra_distance_m") + a.parameter("left_more_m"),
                 a.parameter("extra_distance_m") - a.parameter("left_more_m")},
        place_{a.parameter("x_m"), a.parameter("y_m")},
        step_s_(machine.step_s) {
    const int form = form_of(a).value_or(0);
    if (happens_once(a)) {
      at_s_ = a.parameter("at_s");
      const bool of_both = a.component == "both_wheels";
      lying_.climb = of_both ? effects::kBumpsOfBoth[form].climb : effects::kBumpsOnce[form];
      right_later_m_ = of_both ? effects::kBumpsOfBoth[form].right_later_m : 0.0;
    } else if (lies_across(a)) {
      lying_ = {0.5 * a.parameter("length_m"), effects::kCablesClimbed[form]};
      const double direction_rad = a.parameter("direction_rad");
      along_ = Vec2{std::cos(direction_rad), std::sin(direction_rad)};
    } else {
      lying_ = effects::kBumpsLying[form];
      lying_.reach_m = a.parameter("radius_m", lying_.reach_m);
    }
  }

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    if (!acts_on(component_, wheel.side)) return;
    const bool is_left = wheel.side == Side::left;
    Way& way = ways_[is_left ? 0 : 1];
    way.extra_m = extra_m_[is_left ? 0 : 1];
    const double rim_mps = wheel.radius_m * wheel.speed_radps;
    if (at_s_)
      come_to_its_moment(way, motion, rim_mps, wheel.radius_m, (is_left ? -0.5 : 0.5) * right_later_m_);
    else if (along_)
      come_to_its_line(way, motion, wheel, rim_mps < 0.0);
    else
      come_to_its_place(way, motion, wheel, rim_mps < 0.0);
    if (!way.is_on || rim_mps == 0.0) return;
    const double before = lying_.climb.share_before(way.rolled_m / way.length_m);
    way.rolled_m = std::min(way.length_m, way.rolled_m + std::abs(rim_mps) * step_s_);
    const double now = lying_.climb.share_before(way.rolled_m / way.length_m);
    wheel.slip_mps += std::copysign(way.extra_m * (now - before) / step_s_, rim_mps);
    way.is_on = way.rolled_m < way.length_m;
  }

 private:
  struct Way {
    bool is_on = false, is_done = false;  // done: until it has left the place
    double length_m = 0.0, rolled_m = 0.0, extra_m = 0.0;
    double since_m = 0.0;  // the moment, of the axle's way
  };

  // It cannot roll further than it turns.
  static void begin(Way& way, double length_m) {
    way = {true, true, std::max(length_m, 1.05 * way.extra_m), 0.0, way.extra_m, way.since_m};
  }

  // Its middle is where the vehicle is at the moment, or so much of the axle's way later: before that as it goes now.
  void come_to_its_moment(Way& way, const VehicleMotion& motion, double rim_mps, double radius_m,
                          double later_m) const {
    constexpr double kLongest_s = effects::kLongestBump_s;
    const double before_s = *at_s_ - motion.time_s, speed_mps = std::max(std::abs(motion.rolled_speed_mps), 1e-6);
    if (before_s < -kLongest_s) way.is_on = false;
    if (before_s < 0.0) way.since_m += speed_mps * step_s_;
    const double still_m = later_m - way.since_m;
    const double still_s = std::max(0.0, before_s) + std::clamp(still_m / speed_mps, -kLongest_s, kLongest_s);
    if (way.is_done || still_s < 0.0 || still_s > kLongest_s) return;
    const double length_m = lying_.climb.length_m(radius_m);
    if (std::abs(rim_mps) * still_s <= 0.5 * length_m) begin(way, length_m);
  }

  void come_to_its_place(Way& way, const VehicleMotion& motion, const RollingWheel& wheel, bool in_reverse) const {
    const double heading_rad = motion.heading_rad + (in_reverse ? kPi : 0.0);
    const Vec2 to = rotated(place_ - wheel.contact, -heading_rad);
    const double beside2_m2 = lying_.reach_m * lying_.reach_m - to.y_m * to.y_m;
    const double half_m = beside2_m2 > 0.0 ? std::sqrt(beside2_m2) : 0.0;  // of the way within its reach
    double length_m = lying_.climb.length_m(wheel.radius_m), from_m = half_m;
    if (lying_.is_mound) way.extra_m *= half_m / lying_.reach_m;
    if (length_m == 0.0)
      length_m = 2.0 * half_m + way.extra_m;
    else if (!lying_.at_its_edge)
      from_m = std::max(0.0, 0.5 * (length_m - way.extra_m));
    const bool is_there = half_m > 0.0 && std::abs(to.x_m) <= from_m;
    if (is_there && !way.is_done && length_m > 0.01) begin(way, length_m);
    if (!is_there && !way.is_on && std::abs(to.x_m) > half_m) way.is_done = false;
  }

  void come_to_its_line(Way& way, const VehicleMotion& motion, const RollingWheel& wheel, bool in_reverse) const {
    const double heading_rad = motion.heading_rad + (in_reverse ? kPi : 0.0);
    const Vec2 ahead{std::cos(heading_rad), std::sin(heading_rad)}, to = place_ - wheel.contact;
    const double across = cross(ahead, *along_);
    if (std::abs(across) < 0.05) return;  // it goes along it, not over it
    const double ahead_m = cross(to, *along_) / across, length_m = lying_.climb.length_m(wheel.radius_m);
    const double from_m = std::max(0.0, 0.5 * (length_m - way.extra_m));
    const bool is_there = std::abs(ahead_m) <= from_m && std::abs(dot(ahead_m * ahead - to, *along_)) <= lying_.reach_m;
    if (is_there && !way.is_done) begin(way, length_m);
    if (!is_there && !way.is_on && std::abs(ahead_m) > 0.5 * length_m) way.is_done = false;
  }

  std::string component_;
  double extra_m_[2];  // of the left wheel and of the right one
  double right_later_m_ = 0.0;
  Vec2 place_;
  std::optional<Vec2> along_;  // of what lies across the way
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
