#include "core/kinematics/trucks.h"

#include <cmath>

#include "core/base/random.h"
#include "core/geometry/exact_arc.h"

namespace odolab {

namespace {

constexpr double kLongestTruckStep_s = 1e-3;

void add(WheelRotation& sum, const WheelRotation& more) {
  sum.left_rad += more.left_rad;
  sum.right_rad += more.right_rad;
}

// Values cut to whole steps of encoders, each with a phase of its own.
class Rounding {
 public:
  explicit Rounding(std::uint64_t seed) : phases_(seed) {}
  double cut(double value, double step) {
    const double phase = phases_.uniform();
    return step > 0.0 ? (std::floor(value / step + phase) + 0.5 - phase) * step : value;
  }
  WheelRotation cut(const WheelRotation& wheels, const DifferentialDrive& truck) {
    const double step_rad = 2.0 * kPi / truck.counts_per_wheel_turn();
    const double left_rad = cut(wheels.left_rad, step_rad);
    return {left_rad, cut(wheels.right_rad, step_rad)};
  }

 private:
  Random phases_;
};

}  // namespace

WheelRotation wheel_rotation(const DifferentialDrive& truck, double travel_m, double turn_rad) {
  const double half_m = 0.5 * truck.wheelbase_m * turn_rad;
  return {(travel_m - half_m) / truck.wheel_radius_left_m, (travel_m + half_m) / truck.wheel_radius_right_m};
}

LinkedKinematics::LinkedKinematics(LinkedTrucks actual, const Pose& a, double link_angle_a_rad, double link_angle_b_rad,
                                   double link_length_m)
    : actual_(std::move(actual)), a_(a) {
  const double link_rad = a.heading_rad - link_angle_a_rad;
  const Vec2 b = a.position() - rotated({link_length_m, 0.0}, link_rad);
  b_ = {b.x_m, b.y_m, link_rad + link_angle_b_rad};
}

void LinkedKinematics::move(const TruckTwist& a, const TruckTwist& b, double duration_s) {
  const double travel_a_m = a.speed_mps * duration_s, turn_a_rad = a.yaw_rate_radps * duration_s;
  const double travel_b_m = b.speed_mps * duration_s, turn_b_rad = b.yaw_rate_radps * duration_s;
  a_ = moved_exactly(a_, travel_a_m, 0.0, turn_a_rad);
  b_ = moved_exactly(b_, travel_b_m, 0.0, turn_b_rad);
  add(reading_.a, wheel_rotation(actual_.truck_a, travel_a_m, turn_a_rad));
  add(reading_.b, wheel_rotation(actual_.truck_b, travel_b_m, turn_b_rad));
  reading_.time_s += duration_s;
}

double LinkedKinematics::link_heading_rad() const { return std::atan2(a_.y_m - b_.y_m, a_.x_m - b_.x_m); }
double LinkedKinematics::link_length_m() const { return length(a_.position() - b_.position()); }

LinkedSample LinkedKinematics::reading() const {
  LinkedSample sample = reading_;
  sample.link_angle_a_rad = wrapped(a_.heading_rad - link_heading_rad()) + actual_.link_angle_a_offset_rad;
  sample.link_angle_b_rad = wrapped(b_.heading_rad - link_heading_rad()) + actual_.link_angle_b_offset_rad;
  sample.link_length_m = link_length_m() + actual_.link_length_offset_m;
  return sample;
}

void LinkedKinematics::add_idle_rotation(const WheelRotation& a, const WheelRotation& b) {
  add(reading_.a, a);
  add(reading_.b, b);
}

LinkedSample rounded(const LinkedSample& exact, const LinkedTrucks& vehicle, std::uint64_t seed) {
  Rounding rounding(seed);
  LinkedSample sample{exact.time_s, rounding.cut(exact.a, vehicle.truck_a), {}, 0.0, 0.0, 0.0};
  sample.b = rounding.cut(exact.b, vehicle.truck_b);
  sample.link_angle_a_rad = rounding.cut(exact.link_angle_a_rad, vehicle.link_angle_resolution_rad);
  sample.link_angle_b_rad = rounding.cut(exact.link_angle_b_rad, vehicle.link_angle_resolution_rad);
  sample.link_length_m = rounding.cut(exact.link_length_m, vehicle.link_length_resolution_m);
  return sample;
}

TrailerKinematics::TrailerKinematics(EncoderTrailer actual, const Pose& tow, double hitch_angle_rad)
    : actual_(std::move(actual)), tow_(tow), hitch_angle_rad_(hitch_angle_rad) {}

void TrailerKinematics::move(const TruckTwist& tow, double duration_s) {
  if (duration_s <= 0.0) return;
  const int steps = static_cast<int>(std::ceil(duration_s / kLongestTruckStep_s));
  const double h = duration_s / steps;
  // The hitch moves with the tow; the trailer rolls along its own axis and turns as the hitch moves across it.
  struct Rates {
    double speed_mps, yaw_rate_radps;
  };
  const auto rates = [&](double hitch_rad) {
    const Vec2 hitch = rotated({tow.speed_mps, -tow.yaw_rate_radps * actual_.hitch_offset_m}, hitch_rad);
    return Rates{hitch.x_m, hitch.y_m / actual_.drawbar_length_m};
  };
  double travel_m = 0.0, turn_rad = 0.0;
  for (int i = 0; i < steps; ++i) {
    const auto swivel = [&](const Rates& r) { return tow.yaw_rate_radps - r.yaw_rate_radps; };
    const Rates k1 = rates(hitch_angle_rad_), k2 = rates(hitch_angle_rad_ + 0.5 * h * swivel(k1));
    const Rates k3 = rates(hitch_angle_rad_ + 0.5 * h * swivel(k2)), k4 = rates(hitch_angle_rad_ + h * swivel(k3));
    const auto mean = [&](double Rates::*rate) {
      return h / 6.0 * (k1.*rate + 2.0 * (k2.*rate) + 2.0 * (k3.*rate) + k4.*rate);
    };
    const double turned_rad = mean(&Rates::yaw_rate_radps);
    travel_m += mean(&Rates::speed_mps);
    turn_rad += turned_rad;
    hitch_angle_rad_ += tow.yaw_rate_radps * h - turned_rad;
  }
  tow_ = moved_exactly(tow_, tow.speed_mps * duration_s, 0.0, tow.yaw_rate_radps * duration_s);
  add(reading_.tow, wheel_rotation(actual_.tow, tow.speed_mps * duration_s, tow.yaw_rate_radps * duration_s));
  add(reading_.trailer, wheel_rotation(actual_.trailer, travel_m, turn_rad));
  reading_.time_s += duration_s;
}

TrailerSample TrailerKinematics::reading() const {
  TrailerSample sample = reading_;
  sample.hitch_angle_rad = wrapped(hitch_angle_rad_) + actual_.hitch_angle_offset_rad;
  return sample;
}

void TrailerKinematics::add_idle_rotation(const WheelRotation& tow, const WheelRotation& trailer) {
  add(reading_.tow, tow);
  add(reading_.trailer, trailer);
}

TrailerSample rounded(const TrailerSample& exact, const EncoderTrailer& vehicle, std::uint64_t seed) {
  Rounding rounding(seed);
  TrailerSample sample{exact.time_s, rounding.cut(exact.tow, vehicle.tow), {}, 0.0};
  sample.trailer = rounding.cut(exact.trailer, vehicle.trailer);
  sample.hitch_angle_rad = rounding.cut(exact.hitch_angle_rad, vehicle.hitch_angle_resolution_rad);
  return sample;
}

}  // namespace odolab
