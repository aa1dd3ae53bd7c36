#include "core/diagnosis/generic/wave.h"

#include <cmath>

namespace odolab {

double coordinate(Along along, const DriveView& view, const EffectStep& s) {
  const DifferentialDrive& d = view.drive;
  if (is_of_a_wheel(along)) return (along == Along::left_wheel ? s.left_rad : s.right_rad) / (2.0 * kPi);
  const double left_m = d.wheel_radius_left_m * s.left_rad, right_m = d.wheel_radius_right_m * s.right_rad;
  return along == Along::time  ? s.since_start_s
         : along == Along::way ? 0.5 * (left_m + right_m)
                               : (right_m - left_m) / d.wheelbase_m;
}

// What comes and goes with the way is a place on that axis: driven back, it is undone.
Unit unit_of(const EffectStep& s, double wheelbase_m, int channel, Along along) {
  Unit u;
  if (is_of_a_wheel(along)) {
    const Wheel wheel = along == Along::left_wheel ? Wheel::left : Wheel::right;
    u.of[0] = by_wheel(wheel, wheel == Wheel::left ? s.left_m : s.right_m, wheelbase_m);
    return u;
  }
  if (along == Along::way) {
    BodyMotion& m = u.of[0];
    (channel == 0 ? m.forward_m : channel == 1 ? m.sideways_m : m.turn_rad) = s.forward_m();
    return u;
  }
  if (channel < kAcross) {
    u.of[0] = unit_of_channel(s, wheelbase_m, channel);
    return u;
  }
  if (channel == kPace || channel == kTurning) {
    u.of[0] = {channel == kPace ? s.forward_m() : 0.0, 0.0, s.turn_rad};
    return u;
  }
  const double much = along == Along::floor ? std::abs(s.forward_m()) : s.duration_s;
  u.of[0] = {much * s.cos_heading, -much * s.sin_heading, 0.0};
  u.of[1] = {much * s.sin_heading, much * s.cos_heading, 0.0};
  return u;
}

double product(const BodyMotion& a, const BodyMotion& b) {
  return a.forward_m * b.forward_m + a.sideways_m * b.sideways_m + a.turn_rad * b.turn_rad;
}

// What one step adds to each slot.
void add_scores(const DriveView& view, const EffectStep& s, const BodyMotion& of_step, Along along, double* score) {
  const double b = view.drive.wheelbase_m;
  if (is_of_a_wheel(along)) {
    score[of_wheel] += product(unit_of(s, b, kUnderWheels, along).of[0], of_step);
    return;
  }
  for (int channel = 0; channel < kChannelsOfAll; ++channel)
    score[channel] += product(unit_of(s, b, channel, along).of[0], of_step);
  if (along == Along::way || along == Along::turning) return;
  const Unit u = unit_of(s, b, kAcross, along);
  for (int axis = 0; axis < 2; ++axis)
    score[(along == Along::time ? across_s : across_m) + axis] += product(u.of[axis], of_step);
  if (along != Along::time) return;
  score[of_pace] += product(unit_of(s, b, kPace, along).of[0], of_step);
  score[of_turning] += product(unit_of(s, b, kTurning, along).of[0], of_step);
}

}  // namespace odolab
