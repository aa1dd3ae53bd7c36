#include "physics/driver/linked_trucks_control.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"

namespace odolab {

namespace {

constexpr double kSteering_per_s = 2.5;     // turn rate per error of a truck's direction
constexpr double kLargestTurn_radps = 1.0;  // of a truck that is far from its direction
constexpr double kLength_per_s = 1.0;       // speed along the link per error of its length
constexpr double kLargestStretch_mps = 0.03;
constexpr double kMoving_mps = 0.02;     // slower than this a velocity has no direction
constexpr double kNear_rad = 0.06;       // a truck this far from its direction halves the pace
constexpr double kPaceRise_per_s = 0.7;  // how quickly the pace comes back
constexpr double kPaceFall_per_s = 3.0;  // and goes: at once would be slip

}  // namespace

void LinkedTrucksControl::choose_direction(Steered& truck, double along_mps, double across_mps,
                                           double angle_rad) const {
  const double before_rad = truck.direction_rad;
  truck.turning_radps = 0.0;
  if (std::hypot(along_mps, across_mps) < kMoving_mps) return;
  const double travel_rad = std::atan2(across_mps, along_mps);
  const double ahead_rad = wrapped(travel_rad - angle_rad), astern_rad = wrapped(travel_rad + kPi - angle_rad);
  // Where both are about equally far it goes on as before.
  const double preference_rad = 0.1 * truck.sign;
  truck.sign = std::abs(ahead_rad) - preference_rad <= std::abs(astern_rad) ? 1.0 : -1.0;
  truck.direction_rad = angle_rad + (truck.sign > 0.0 ? ahead_rad : astern_rad);
  const double turned_rad = wrapped(truck.direction_rad - before_rad);
  if (std::abs(turned_rad) < 0.2) truck.turning_radps = turned_rad / period_s_;
}

TruckCommands LinkedTrucksControl::update(const BaseCommand& command, const LinkReadings& readings) {
  const double lever_m = 0.5 * link_length_m_;
  // Each truck undoes half of the stretch, by its speed or, where it travels across the link, by its direction.
  const double apart_mps =
      0.5 * std::clamp(kLength_per_s * (link_length_m_ - readings.length_m), -kLargestStretch_mps, kLargestStretch_mps);
  choose_direction(a_, command.speed_mps + apart_mps, command.sideways_mps + lever_m * command.yaw_rate_radps,
                   readings.angle_a_rad);
  choose_direction(b_, command.speed_mps - apart_mps, command.sideways_mps - lever_m * command.yaw_rate_radps,
                   readings.angle_b_rad);
  const double error_a_rad = wrapped(a_.direction_rad - readings.angle_a_rad);
  const double error_b_rad = wrapped(b_.direction_rad - readings.angle_b_rad);
  const double worst = std::max(std::abs(error_a_rad), std::abs(error_b_rad)) / kNear_rad;
  const double allowed = 1.0 / (1.0 + worst * worst * worst * worst);
  pace_ = std::clamp(allowed, pace_ - kPaceFall_per_s * period_s_, pace_ + kPaceRise_per_s * period_s_);

  const auto drive = [&](const Steered& truck, double error_rad, double angle_rad, double across_mps, double outward) {
    const double speed = std::hypot(pace_ * command.speed_mps, pace_ * across_mps);
    const double turn = std::clamp(kSteering_per_s * error_rad, -kLargestTurn_radps, kLargestTurn_radps);
    return BaseCommand{truck.sign * speed * std::cos(error_rad) + outward * apart_mps * std::cos(angle_rad),
                       pace_ * (command.yaw_rate_radps + truck.turning_radps) + turn};
  };
  TruckCommands out;
  out.a = drive(a_, error_a_rad, readings.angle_a_rad, command.sideways_mps + lever_m * command.yaw_rate_radps, 1.0);
  out.b = drive(b_, error_b_rad, readings.angle_b_rad, command.sideways_mps - lever_m * command.yaw_rate_radps, -1.0);
  return out;
}

}  // namespace odolab
