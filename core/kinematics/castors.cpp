#include "core/kinematics/castors.h"

#include <cmath>

#include "core/base/random.h"
#include "core/geometry/exact_arc.h"

namespace odolab {

namespace {

// A castor swings round in r_c over its speed, 0.1 s and more: a step of fourth order then errs by 1e-9 of that swing.
constexpr double kLongestCastorStep_s = 5e-3;

// Velocity of a castor's pivot in the body's frame.
Vec2 pivot_velocity(const Castor& castor, const BodyTwist& twist) {
  const Vec2 pivot = castor.pivot();
  return {twist.forward_mps - twist.yaw_rate_radps * pivot.y_m, twist.sideways_mps + twist.yaw_rate_radps * pivot.x_m};
}

struct CastorRates {
  double angle_radps = 0.0;  // of the castor against the body
  double left_radps = 0.0;
  double right_radps = 0.0;
};

// No wheel slips sideways: the castor turns as the pivot moves across it, and rolls as the pivot moves along it.
CastorRates rates(const Castor& castor, const Vec2& pivot_mps, double yaw_rate_radps, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const double along_mps = pivot_mps.x_m * c + pivot_mps.y_m * s;
  const double turn_radps = (pivot_mps.y_m * c - pivot_mps.x_m * s) / castor.offset_m;
  return {turn_radps - yaw_rate_radps,
          (along_mps - castor.wheel_offset_left_m * turn_radps) / castor.wheel_radius_left_m,
          (along_mps + castor.wheel_offset_right_m * turn_radps) / castor.wheel_radius_right_m};
}

}  // namespace

CastorKinematics::CastorKinematics(MultiCastor actual, const Pose& body, const std::vector<double>& castor_angles_rad)
    : actual_(std::move(actual)), body_(body), angles_rad_(castor_angles_rad), wheels_(actual_.castors.size()) {
  angles_rad_.resize(actual_.castors.size(), 0.0);
}

void CastorKinematics::move(const BodyTwist& twist) {
  if (twist.duration_s <= 0.0) return;
  const int steps = static_cast<int>(std::ceil(twist.duration_s / kLongestCastorStep_s));
  const double h = twist.duration_s / steps;
  for (std::size_t i = 0; i < actual_.castors.size(); ++i) {
    const Castor& castor = actual_.castors[i];
    const Vec2 pivot_mps = pivot_velocity(castor, twist);
    const auto at = [&](double angle_rad) { return rates(castor, pivot_mps, twist.yaw_rate_radps, angle_rad); };
    double angle_rad = angles_rad_[i];
    for (int k = 0; k < steps; ++k) {
      const CastorRates k1 = at(angle_rad), k2 = at(angle_rad + 0.5 * h * k1.angle_radps);
      const CastorRates k3 = at(angle_rad + 0.5 * h * k2.angle_radps), k4 = at(angle_rad + h * k3.angle_radps);
      const auto mean = [&](double CastorRates::*rate) {
        return h / 6.0 * (k1.*rate + 2.0 * (k2.*rate) + 2.0 * (k3.*rate) + k4.*rate);
      };
      angle_rad += mean(&CastorRates::angle_radps);
      wheels_[i].left_rad += mean(&CastorRates::left_radps);
      wheels_[i].right_rad += mean(&CastorRates::right_radps);
    }
    angles_rad_[i] = angle_rad;
  }
  body_ = moved_exactly(body_, twist.forward_mps * twist.duration_s, twist.sideways_mps * twist.duration_s,
                        twist.yaw_rate_radps * twist.duration_s);
  time_s_ += twist.duration_s;
}

CastorSample CastorKinematics::reading() const {
  CastorSample sample{time_s_, {}};
  for (std::size_t i = 0; i < actual_.castors.size(); ++i)
    sample.castors.push_back({wheels_[i], angles_rad_[i] + actual_.castors[i].pivot_encoder_offset_rad});
  return sample;
}

void CastorKinematics::add_idle_rotation(std::size_t castor, double left_rad, double right_rad) {
  wheels_[castor].left_rad += left_rad;
  wheels_[castor].right_rad += right_rad;
}

std::vector<double> trailing_angles(const MultiCastor& vehicle, const BodyTwist& twist) {
  std::vector<double> angles;
  for (const Castor& castor : vehicle.castors) {
    const Vec2 v = pivot_velocity(castor, twist);
    // In a turn the axle runs on a smaller circle than the pivot; |v| sin(direction - angle) = r_c yaw rate.
    const double across = castor.offset_m * twist.yaw_rate_radps / std::max(length(v), 1e-12);
    angles.push_back(std::atan2(v.y_m, v.x_m) - std::asin(std::max(-1.0, std::min(1.0, across))));
  }
  return angles;
}

CastorSample rounded(const CastorSample& exact, const MultiCastor& vehicle, std::uint64_t seed) {
  Random phases(seed);
  const auto cut = [&](double value_rad, double step_rad) {
    const double phase = phases.uniform();
    return step_rad > 0.0 ? (std::floor(value_rad / step_rad + phase) + 0.5 - phase) * step_rad : value_rad;
  };
  CastorSample sample{exact.time_s, {}};
  for (const CastorReading& c : exact.castors) {
    const double left_rad = cut(c.wheels.left_rad, vehicle.wheel_encoder_resolution_rad);
    const double right_rad = cut(c.wheels.right_rad, vehicle.wheel_encoder_resolution_rad);
    const double pivot_rad = cut(c.pivot_rad, vehicle.pivot_encoder_resolution_rad);
    sample.castors.push_back({{left_rad, right_rad}, pivot_rad});
  }
  return sample;
}

}  // namespace odolab
