#include "core/scenario/scenario.h"

#include <algorithm>

#include "core/base/formatted.h"
#include "core/scenario/effect_catalogue.h"

namespace odolab {

namespace {
constexpr double kLongestScenario_s = 1e5;  // a day and a bit: longer runs are mistakes

// Whether the planar world has this effect on a vehicle of several parts: all of what drives a truck or castor, but for
// what is laid on the floor for one wheel or acts on the base's commands; of a trailer's free wheels what they count.
bool acts_on_a_part(const VehicleKind& kind, const ActiveEffect& effect) {
  const std::string& name = effect.effect;
  if (effect.component == "truth" || name == "slip_zone" || name == "clock_rate") return true;
  const bool driven = !std::holds_alternative<Tracked>(kind) && !std::holds_alternative<SynchroDrive>(kind) &&
                      !std::holds_alternative<EncoderTrailer>(kind);
  if (name == "floor_slope_creep") return driven && !std::holds_alternative<SmartEncoderTrailer>(kind);
  if (name == "bump" || name == "actuator_lag" || name == "actuator_delay") return false;
  const PartComponent of = part_component(effect.component);
  if (of.part.empty()) return std::holds_alternative<SmartEncoderTrailer>(kind);  // of the towing vehicle
  if (!has_linked_part(kind, of.part)) return false;
  if (of.part != "trailer") return true;
  return name == "wheel_eccentricity" || name == "encoder_missed_counts" || name == "radius_drift" ||
         name == "speed_dependent_radius" || name == "encoder_data_fault";
}
}  // namespace

std::vector<std::string> problems_in(const Scenario& s) {
  std::vector<std::string> problems;
  const auto demand = [&](bool holds, const char* key, double found, const char* expected) {
    if (holds) return;
    problems.push_back(formatted("%s: found %g, expected %s", key, found, expected));
  };
  const auto demand_positive = [&](const char* key, double value, const char* unit) {
    demand(std::isfinite(value) && value > 0.0, key, value, formatted("a value above 0 %s", unit).c_str());
  };
  for (const std::string& p : problems_in(s.vehicle.kind)) problems.push_back("vehicle." + p);
  const bool one_drive = std::holds_alternative<DifferentialDrive>(s.vehicle.kind);
  for (const std::string& p : problems_in(s.machine, s.vehicle.kind)) problems.push_back("actual." + p);
  for (const ActiveEffect& effect : s.effects) {
    const bool of_a_part = effect.effect == "link_angle_bias" || effect.effect == "link_length_bias" ||
                           effect.effect == "pivot_angle_bias";
    if (of_a_part && !has_linked_part(s.vehicle.kind, effect.component))
      problems.push_back("effect: found '" + effect.effect + "' on " + effect.component +
                         ", which this kind of vehicle does not have, expected one of its own parts");
    if (!of_a_part && !one_drive && !acts_on_a_part(s.vehicle.kind, effect))
      problems.push_back("effect: found '" + effect.effect + "' on " + effect.component +
                         ", expected slip zones, clocks, biased encoders, effects of the truth, or effects of wheels " +
                         "that a part of this vehicle has, as truck_a.left_wheel");
    if (one_drive && !part_component(effect.component).part.empty() && !of_a_part)
      problems.push_back("effect: found '" + effect.effect + "' on " + effect.component +
                         ", expected a component of a vehicle without parts");
  }
  if (!one_drive) {
    if (s.benchmark) problems.push_back("benchmark: found one, expected none for this kind of vehicle");
    if (std::holds_alternative<WheelSpeedPath>(s.path))
      problems.push_back(
          "path.kind: found wheel speeds, expected a path that any kind of vehicle drives: square, "
          "straight, figure_eight, waypoints, rectangle, manoeuvres, hand or replay");
  }
  demand_positive("actual.wheel_radius_left_m", s.actual.wheel_radius_left_m, "m");
  demand_positive("actual.wheel_radius_right_m", s.actual.wheel_radius_right_m, "m");
  demand_positive("actual.wheelbase_m", s.actual.wheelbase_m, "m");
  demand(std::abs(s.actual.toe_left_rad) < 0.5, "actual.toe_left_rad", s.actual.toe_left_rad,
         "an angle within 0.5 rad");
  demand(std::abs(s.actual.toe_right_rad) < 0.5, "actual.toe_right_rad", s.actual.toe_right_rad,
         "an angle within 0.5 rad");
  demand(s.actual.mass_kg >= 0.01 && s.actual.mass_kg <= 1e5, "actual.mass_kg", s.actual.mass_kg, "0.01 to 1e5 kg");
  demand(s.actual.moment_of_inertia_kgm2 >= 1e-6 && s.actual.moment_of_inertia_kgm2 <= 1e6,
         "actual.moment_of_inertia_kgm2", s.actual.moment_of_inertia_kgm2, "1e-6 to 1e6 kg m2");
  demand(s.actual.drive_wheel_load_share > 0.0 && s.actual.drive_wheel_load_share <= 1.0,
         "actual.drive_wheel_load_share", s.actual.drive_wheel_load_share, "a share above 0, at most 1");
  demand_positive("motor.wheel_inertia_kgm2", s.motor.wheel_inertia_kgm2, "kg m2");
  demand_positive("motor.torque_limit_nm", s.motor.torque_limit_nm, "N m");
  demand(s.motor.proportional_gain > 0.0, "motor.proportional_gain", s.motor.proportional_gain, "a gain above 0");
  demand(s.motor.integral_gain >= 0.0, "motor.integral_gain", s.motor.integral_gain, "a gain of 0 or more");
  for (const std::string& p : problems_in(s.floor)) problems.push_back(p);
  const double smallest_radius_m = one_drive ? std::min(s.actual.wheel_radius_left_m, s.actual.wheel_radius_right_m)
                                             : typical_wheel_radius_m(s.vehicle.kind);
  for (const Bump& bump : s.floor.bumps)
    demand(bump.height_m < 0.5 * smallest_radius_m, "floor.bump.height_m", bump.height_m,
           "less than half a wheel's radius");
  demand(s.floor.roughness.largest_height_m == 0.0 || s.floor.roughness.largest_height_m < 0.5 * smallest_radius_m,
         "floor.roughness.largest_height_m", s.floor.roughness.largest_height_m, "less than half a wheel's radius");
  for (const std::string& p : problems_in(s.effects)) problems.push_back(p);
  for (std::size_t i = 0; i < s.effects.size(); ++i) {  // over half a wheel's radius: 2 (acos(1/2) - sqrt(3)/2) of it
    const ActiveEffect& e = s.effects[i];
    const double more_m = std::abs(e.parameter("left_more_m"));  // of one wheel, and less of the other
    const double extra_m = e.effect == "bump" ? e.parameter("extra_distance_m") + more_m : 0.0;
    const std::string key = "effect[" + std::to_string(i + 1) + "].extra_distance_m";
    demand(extra_m < 0.362 * smallest_radius_m, key.c_str(), extra_m, "less than the way over half a wheel's radius");
  }
  demand_positive("driving.speed_mps", s.driving.speed_mps, "m/s");
  demand_positive("driving.turn_rate_radps", s.driving.turn_rate_radps, "rad/s");
  demand_positive("driving.acceleration_mps2", s.driving.acceleration_mps2, "m/s2");
  demand_positive("driving.turn_acceleration_radps2", s.driving.turn_acceleration_radps2, "rad/s2");
  demand(s.driving.stands_s >= 0.0 && s.driving.stands_s <= 3600.0, "driving.stands_s", s.driving.stands_s,
         "0 to 3600 s");
  demand(s.step_s >= 1e-5 && s.step_s <= 0.02, "step_s", s.step_s, "1e-5 to 0.02 s");
  demand(s.sensors.encoder_period_s >= s.step_s, "sensors.encoder_period_s", s.sensors.encoder_period_s,
         "no less than step_s");
  demand(s.sensors.truth_period_s >= 0.0, "sensors.truth_period_s", s.sensors.truth_period_s,
         "0 (only start and end) or more");
  demand(s.sensors.truth_position_noise_m >= 0.0, "sensors.truth_position_noise_m", s.sensors.truth_position_noise_m,
         "0 m or more");
  demand(s.sensors.truth_heading_noise_rad >= 0.0, "sensors.truth_heading_noise_rad", s.sensors.truth_heading_noise_rad,
         "0 rad or more");
  demand(s.sensors.record_encoders || s.sensors.record_commands, "sensors.record_encoders", 0.0,
         "true, or else record_commands = true");
  if (const auto* square = std::get_if<SquarePath>(&s.path)) demand_positive("path.side_m", square->side_m, "m");
  if (const auto* straight = std::get_if<StraightPath>(&s.path))
    demand_positive("path.length_m", straight->length_m, "m");
  if (const auto* eight = std::get_if<FigureEightPath>(&s.path)) {
    demand_positive("path.radius_m", eight->radius_m, "m");
    demand(eight->loops >= 1 && eight->loops <= 1000, "path.loops", eight->loops, "1 to 1000");
  }
  if (const auto* way = std::get_if<WaypointPath>(&s.path))
    demand(!way->points.empty(), "path.point", 0.0, "one point or more");
  if (const auto* rectangle = std::get_if<RectanglePath>(&s.path)) {
    demand_positive("path.corner_radius_m", rectangle->corner_radius_m, "m");
    for (const auto& [key, side_m] :
         {std::pair{"path.length_m", rectangle->length_m}, std::pair{"path.width_m", rectangle->width_m}})
      demand(side_m >= 2.0 * rectangle->corner_radius_m && side_m <= 1e4, key, side_m,
             "a side no shorter than two corner radii");
  }
  if (const auto* manoeuvres = std::get_if<ManoeuvrePath>(&s.path)) {
    demand(!manoeuvres->moves.empty(), "path.move", 0.0, "one move or more");
    for (std::size_t i = 0; i < manoeuvres->moves.size(); ++i) {
      const Manoeuvre& move = manoeuvres->moves[i];
      const std::string key = "path.move[" + std::to_string(i + 1) + "].";
      demand(std::abs(move.forward_m) <= 1e4, (key + "forward_m").c_str(), move.forward_m, "a way within 1e4 m");
      demand(std::abs(move.left_m) <= 1e4, (key + "left_m").c_str(), move.left_m, "a way within 1e4 m");
      demand(std::abs(move.turn_rad) <= 1e4, (key + "turn_rad").c_str(), move.turn_rad, "a turn within 1e4 rad");
      demand(move.left_m == 0.0 || moves_sideways(s.vehicle.kind), (key + "left_m").c_str(), move.left_m,
             "0 for a vehicle that cannot move sideways");
    }
  }
  if (const auto* wheel = std::get_if<WheelSpeedPath>(&s.path)) {
    demand(!wheel->phases.empty(), "path.phase", 0.0, "one phase or more");
    demand(wheel->ramp_s >= 0.0, "path.ramp_s", wheel->ramp_s, "0 s or more");
    for (const WheelSpeeds& phase : wheel->phases)
      demand(phase.duration_s > 0.0 && phase.duration_s >= wheel->ramp_s && phase.duration_s <= kLongestScenario_s,
             "path.phase.duration_s", phase.duration_s,
             "a time above 0 s, no shorter than path.ramp_s and at most 1e5 s");
  }
  if (const auto* hand = std::get_if<HandPath>(&s.path))
    demand(hand->duration_s > 0.0 && hand->duration_s <= kLongestScenario_s, "path.duration_s", hand->duration_s,
           "a time above 0, at most 1e5 s");
  const double way_m =
      std::holds_alternative<SquarePath>(s.path)     ? 4.0 * std::get<SquarePath>(s.path).side_m
      : std::holds_alternative<StraightPath>(s.path) ? std::get<StraightPath>(s.path).length_m
      : std::holds_alternative<FigureEightPath>(s.path)
          ? 4.0 * kPi * std::get<FigureEightPath>(s.path).radius_m * std::get<FigureEightPath>(s.path).loops
          : 0.0;
  demand(!(s.driving.speed_mps > 0.0) || way_m / s.driving.speed_mps <= kLongestScenario_s, "driving.speed_mps",
         s.driving.speed_mps, "a speed that ends the path within 1e5 s");
  if (s.benchmark) {
    demand(s.benchmark->runs_each_way >= 1 && s.benchmark->runs_each_way <= 1000, "benchmark.runs_each_way",
           s.benchmark->runs_each_way, "1 to 1000");
    if (!std::holds_alternative<SquarePath>(s.path))
      problems.push_back(
          "benchmark: found another path than a square, expected path.kind = \"square\", which UMBmark "
          "drives in both directions");
  }
  return problems;
}

ActualDrive as_drawn(const DifferentialDrive& nominal) {
  ActualDrive actual;
  actual.wheel_radius_left_m = nominal.wheel_radius_left_m;
  actual.wheel_radius_right_m = nominal.wheel_radius_right_m;
  const double size = nominal.wheelbase_m / actual.wheelbase_m;
  actual.mass_kg *= size * size * size;
  actual.moment_of_inertia_kgm2 *= size * size * size * size * size;
  actual.wheelbase_m = nominal.wheelbase_m;
  return actual;
}

}  // namespace odolab
