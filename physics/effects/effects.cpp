#include "physics/effects/effects.h"

#include <cassert>

namespace odolab::planar {

// Every effect: a file of its own defines the function that makes it. Words for scenarios:
// core/scenario/effect_catalogue.
#define ODOLAB_EACH_EFFECT(X) \
  X(wheel_eccentricity)       \
  X(encoder_missed_counts)    \
  X(drivetrain_backlash)      \
  X(wheel_toe)                \
  X(castor_reversal_kick)     \
  X(radius_drift)             \
  X(tyre_compression)         \
  X(speed_dependent_radius)   \
  X(payload_radius_change)    \
  X(lateral_slip)             \
  X(traction_slip)            \
  X(turn_scrub)               \
  X(one_sided_drag)           \
  X(bump)                     \
  X(slip_zone)                \
  X(floor_slope_creep)        \
  X(collision)                \
  X(turn_speed_loss)          \
  X(clock_rate)               \
  X(truth_frozen)             \
  X(encoder_data_fault)       \
  X(truth_time_offset)        \
  X(truth_mounting_offset)    \
  X(truth_smoothing)          \
  X(actuator_lag)             \
  X(actuator_delay)           \
  X(link_angle_bias)          \
  X(link_length_bias)         \
  X(pivot_angle_bias)

#define ODOLAB_DECLARE_EFFECT(name) std::unique_ptr<Effect> name(const ActiveEffect&, const Machine&);
ODOLAB_EACH_EFFECT(ODOLAB_DECLARE_EFFECT)

namespace {

struct Entry {
  const char* name;
  std::unique_ptr<Effect> (*make)(const ActiveEffect&, const Machine&);
};

#define ODOLAB_LIST_EFFECT(name) {#name, &name},
const Entry kEffects[] = {ODOLAB_EACH_EFFECT(ODOLAB_LIST_EFFECT)};

}  // namespace

bool has_effect(const std::string& name) {
  for (const Entry& entry : kEffects)
    if (name == entry.name) return true;
  return false;
}

Effects::Effects(const std::vector<ActiveEffect>& active, const Machine& machine,
                 const std::vector<std::shared_ptr<Effect>>& own) {
  for (const ActiveEffect& effect : active)
    for (const Entry& entry : kEffects)
      if (effect.effect == entry.name) effects_.push_back(entry.make(effect, machine));
  assert(effects_.size() == active.size());
  effects_.insert(effects_.end(), own.begin(), own.end());
}

Floor Effects::laid_on(Floor floor) const {
  for (const auto& effect : effects_) effect->lay_on(floor);
  return floor;
}

ActualDrive Effects::built_into(ActualDrive actual) const {
  for (const auto& effect : effects_) effect->build_into(actual);
  return actual;
}

ActualMachine Effects::built_into(ActualMachine machine, const VehicleKind& nominal) const {
  if (effects_.empty()) return machine;
  if (!machine.lengths) machine.lengths = nominal;
  for (const auto& effect : effects_) effect->build_into_lengths(*machine.lengths);
  return machine;
}

TruthMounting Effects::mounted(TruthMounting truth) const {
  for (const auto& effect : effects_) effect->mount(truth);
  return truth;
}

double Effects::robot_stamp_s(double begin_s, double since_start_s) const {
  double stamp_s = begin_s + since_start_s;
  for (const auto& effect : effects_) effect->stamp_robot(since_start_s, stamp_s);
  return stamp_s;
}

double Effects::since_start_of_stamp_s(double begin_s, double stamp_s) const {
  double since_start_s = stamp_s - begin_s;
  for (int k = 0; k < 60; ++k)
    since_start_s += stamp_s - robot_stamp_s(begin_s, since_start_s);  // a rate of 0.5 halves the rest
  return since_start_s;
}

}  // namespace odolab::planar
