#include "physics/experiments/concealed/own_effects.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace odolab::concealed {

namespace {

using planar::Creep;
using planar::RollingWheel;
using planar::VehicleMotion;

double normal_from_hash(std::uint64_t hash) {
  const double u = 1.0 - uniform_from_hash(mixed(hash)), v = uniform_from_hash(mixed(hash + 1));
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * kPi * v);
}

class RollingNoise final : public planar::Effect {
 public:
  RollingNoise(double m_per_sqrt_m, double radius_m, std::uint64_t seed, double step_s)
      : share_(m_per_sqrt_m / std::sqrt(kNode_m)), radius_m_(radius_m), seed_(seed), step_s_(step_s) {}

  void roll(const VehicleMotion&, RollingWheel& wheel) override {
    const std::size_t side = wheel.side == Side::left ? 0 : 1;
    rolled_m_[side] += radius_m_ * std::abs(wheel.speed_radps) * step_s_;
    const double at = rolled_m_[side] / kNode_m;
    const auto node = static_cast<std::int64_t>(at);
    if (node != node_[side]) {
      node_[side] = node;
      slip_[side] = slip_at(side, node);
      next_[side] = slip_at(side, node + 1);
    }
    const double u = at - static_cast<double>(node);
    wheel.slip_mps += (slip_[side] + u * (next_[side] - slip_[side])) * wheel.radius_m * wheel.speed_radps;
  }

 private:
  // The spacing of the bumps in the UMBmark report's simulation, section 4.6.2.
  static constexpr double kNode_m = 0.02;

  double slip_at(std::size_t side, std::int64_t node) const {
    return share_ * normal_from_hash(seed_of_stream(seed_ + side, static_cast<std::uint64_t>(node)) & ~1ULL);
  }

  double share_, radius_m_;
  std::uint64_t seed_;
  double step_s_;
  double rolled_m_[2] = {}, slip_[2] = {}, next_[2] = {};
  std::int64_t node_[2] = {-1, -1};
};

// An effect that is a creep of the vehicle and remembers nothing but what `State` holds.
template <typename State>
class Creeping final : public planar::Effect {
 public:
  Creeping(const ActiveEffect& active, double step_s) : active_(active), step_s_(step_s) {}
  void creep(const VehicleMotion& motion, Creep& creep) override { state_.act(active_, motion, step_s_, creep); }

 private:
  ActiveEffect active_;
  double step_s_;
  State state_;
};

template <typename State>
std::shared_ptr<planar::Effect> made(const ActiveEffect& active, double step_s) {
  return std::make_shared<Creeping<State>>(active, step_s);
}

double speed(const VehicleMotion& m) { return std::abs(m.rolled_speed_mps); }

// Where the vehicle is, summed up from its motion: x_m and y_m of the start are parameters.
struct Place {
  bool known = false;
  Vec2 at;
  void go_on(const ActiveEffect& a, const VehicleMotion& m, double step_s) {
    if (!known) at = {a.parameter("start_x_m"), a.parameter("start_y_m")}, known = true;
    at = at + (m.speed_mps * step_s) * Vec2{std::cos(m.heading_rad), std::sin(m.heading_rad)};
  }
};

struct SlipTowardsAPoint {
  Place place;
  void act(const ActiveEffect& a, const VehicleMotion& m, double step_s, Creep& creep) {
    place.go_on(a, m, step_s);
    const Vec2 to = Vec2{a.parameter("x_m"), a.parameter("y_m")} - place.at;
    const double pull = a.parameter("amplitude") * speed(m) / (length(to) + 0.3);
    creep.velocity_mps = creep.velocity_mps + pull * rotated(to, -m.heading_rad);
  }
};

struct DrawnToADirection {
  void act(const ActiveEffect& a, const VehicleMotion& m, double, Creep& creep) {
    creep.yaw_rate_radps +=
        a.parameter("amplitude") * std::sin(a.parameter("direction_rad") - m.heading_rad) * speed(m);
  }
};

struct QuadraticSteeringGain {
  void act(const ActiveEffect& a, const VehicleMotion& m, double, Creep& creep) {
    const double rate = m.rolled_yaw_rate_radps;
    creep.yaw_rate_radps += a.parameter("amplitude") * rate * rate * speed(m);
  }
};

struct MemoryOfTheLastTurn {
  double wound_rad = 0.0;
  void act(const ActiveEffect& a, const VehicleMotion& m, double step_s, Creep& creep) {
    wound_rad = wound_rad * std::exp(-speed(m) * step_s / 0.3) + m.rolled_yaw_rate_radps * step_s;
    wound_rad = std::clamp(wound_rad, -1.5, 1.5);
    creep.yaw_rate_radps -= a.parameter("amplitude") * wound_rad * speed(m);
  }
};

struct StickSlipWithTemperature {
  double heat = 0.0, way_m = 0.0;
  void act(const ActiveEffect& a, const VehicleMotion& m, double step_s, Creep& creep) {
    heat += step_s * (std::abs(m.rolled_yaw_rate_radps) - heat / a.parameter("cools_s", 15.0));
    way_m += speed(m) * step_s;
    const double tooth = way_m / 0.15 - std::floor(way_m / 0.15);  // sticks, then slips
    creep.velocity_mps.x_m -= a.parameter("amplitude") * heat * m.rolled_speed_mps * (tooth > 0.7 ? 1.0 : 0.0);
    creep.yaw_rate_radps += 2.0 * a.parameter("amplitude") * heat * speed(m) * (tooth > 0.7 ? 1.0 : 0.0);
  }
};

struct WavyFloor {
  Place place;
  void act(const ActiveEffect& a, const VehicleMotion& m, double step_s, Creep& creep) {
    place.go_on(a, m, step_s);
    const double along_m = dot(place.at, rotated({1.0, 0.0}, a.parameter("direction_rad")));
    creep.yaw_rate_radps +=
        a.parameter("amplitude") * std::sin(2.0 * kPi * along_m / a.parameter("length_m", 1.0)) * speed(m);
  }
};

struct Gusts {
  void act(const ActiveEffect& a, const VehicleMotion& m, double, Creep& creep) {
    const double gust = a.parameter("amplitude") * std::sin(2.0 * kPi * m.time_s / a.parameter("period_s", 7.0));
    if (speed(m) > 0.0)
      creep.velocity_mps =
          creep.velocity_mps + gust * rotated({1.0, 0.0}, a.parameter("direction_rad") - m.heading_rad);
  }
};

}  // namespace

std::shared_ptr<planar::Effect> rolling_noise(double m_per_sqrt_m, double radius_m, std::uint64_t seed, double step_s) {
  return std::make_shared<RollingNoise>(m_per_sqrt_m, radius_m, seed, step_s);
}

const std::vector<OutsideEffect>& outside_effects() {
  static const std::vector<OutsideEffect> list = {
      {"slip_towards_a_point", "slips towards a point of the floor, in proportion to the way", 0.01, true,
       made<SlipTowardsAPoint>},
      {"drawn_to_a_direction", "turns towards a direction of the room as it drives", 0.02, false,
       made<DrawnToADirection>},
      {"quadratic_steering_gain", "turns to one side with the square of the turn rate", 0.05, false,
       made<QuadraticSteeringGain>},
      {"memory_of_the_last_turn", "winds back after a turn, within a third of a metre", 0.04, false,
       made<MemoryOfTheLastTurn>},
      {"stick_slip_with_temperature", "sticks and slips in steps, the more the tyres were heated by turning", 0.02,
       false, made<StickSlipWithTemperature>},
      {"wavy_floor", "is steered by waves of the floor", 0.05, true, made<WavyFloor>},
      {"gusts", "is carried to and fro along a direction of the room", 0.004, false, made<Gusts>},
  };
  return list;
}

const OutsideEffect* outside_effect(const std::string& name) {
  for (const OutsideEffect& e : outside_effects())
    if (e.name == name) return &e;
  return nullptr;
}

}  // namespace odolab::concealed
