#include "core/io/scenario_toml.h"

#include <filesystem>
#include <limits>

#include "core/io/actual_toml.h"
#include "core/io/file_kind.h"
#include "core/io/toml_table.h"
#include "core/io/toml_text.h"
#include "core/io/vehicle_toml.h"
#include "core/io/whole_file.h"
#include "core/scenario/effect_catalogue.h"
#include "core/scenario/suited_scenario.h"

namespace odolab {

namespace {

// One list of fields for each struct; TomlTable reads it, TomlText writes it.

template <typename S, typename Toml>
void motor_fields(S& motor, Toml& toml) {
  toml.field("ideal", motor.ideal);
  toml.field("wheel_inertia_kgm2", motor.wheel_inertia_kgm2);
  toml.field("torque_limit_nm", motor.torque_limit_nm);
  toml.field("proportional_gain", motor.proportional_gain);
  toml.field("integral_gain", motor.integral_gain);
}

template <typename S, typename Toml>
void floor_fields(S& floor, Toml& toml) {
  toml.field("friction", floor.friction);
  toml.field("tilt_rad", floor.tilt_rad);
  toml.field("downhill_direction_rad", floor.downhill_direction_rad);
}

template <typename S, typename Toml>
void roughness_fields(S& roughness, Toml& toml) {
  toml.field("largest_height_m", roughness.largest_height_m);
  toml.field("spacing_m", roughness.spacing_m);
}

template <typename S, typename Toml>
void point_fields(S& point, Toml& toml) {
  toml.field("x_m", point.x_m);
  toml.field("y_m", point.y_m);
}

const std::vector<std::string> kUnder = {"any_wheel", "left_wheel", "right_wheel", "inside_wheel"};

template <typename S, typename Toml>
void bump_fields(S& bump, Toml& toml) {
  point_fields(bump.centre, toml);
  toml.field("direction_rad", bump.direction_rad);
  toml.field("length_m", bump.length_m);
  toml.field("height_m", bump.height_m);
  toml.choice("under", bump.under, kUnder);
  toml.field("round", bump.round);
}

template <typename S, typename Toml>
void pose_fields(S& pose, Toml& toml) {
  point_fields(pose, toml);
  toml.field("heading_rad", pose.heading_rad);
}

template <typename S, typename Toml>
void driving_fields(S& driving, Toml& toml) {
  toml.field("speed_mps", driving.speed_mps);
  toml.field("turn_rate_radps", driving.turn_rate_radps);
  toml.field("acceleration_mps2", driving.acceleration_mps2);
  toml.field("turn_acceleration_radps2", driving.turn_acceleration_radps2);
  toml.field("stands_s", driving.stands_s);
  toml.field("internal_correction", driving.internal_correction);
  toml.field("by_eye", driving.by_eye);
}

template <typename S, typename Toml>
void sensor_fields(S& sensors, Toml& toml) {
  toml.field("encoder_period_s", sensors.encoder_period_s);
  toml.field("truth_period_s", sensors.truth_period_s);
  toml.field("truth_position_noise_m", sensors.truth_position_noise_m);
  toml.field("truth_heading_noise_rad", sensors.truth_heading_noise_rad);
  toml.field("truth_heading", sensors.truth_heading);
  toml.field("record_encoders", sensors.record_encoders);
  toml.field("record_commands", sensors.record_commands);
}

template <typename S, typename Toml>
void benchmark_fields(S& benchmark, Toml& toml) {
  toml.field("runs_each_way", benchmark.runs_each_way);
  toml.field("extended", benchmark.extended);
}

template <typename S, typename Toml>
void expectation_fields(S& expectation, Toml& toml) {
  toml.field("figure", expectation.figure);
  toml.field("at_least", expectation.at_least);
  toml.field("at_most", expectation.at_most);
}

template <typename S, typename Toml>
void manoeuvre_fields(S& move, Toml& toml) {
  toml.field("forward_m", move.forward_m);
  toml.field("left_m", move.left_m);
  toml.field("turn_rad", move.turn_rad);
}

template <typename S, typename Toml>
void wheel_speed_fields(S& phase, Toml& toml) {
  toml.field("duration_s", phase.duration_s);
  toml.field("left_radps", phase.left_radps);
  toml.field("right_radps", phase.right_radps);
}

// Shapes of a slip zone, in the order of Shape.

const std::vector<std::string> kShapes = {"disc", "rectangle", "polygon"};
const Shape kEmptyShapes[] = {Disc{}, Rectangle{}, Polygon{}};

template <typename Toml>
struct ShapeFields {
  Toml& toml;

  template <typename S>
  void operator()(S& shape) const {
    using Plain = std::remove_const_t<S>;
    if constexpr (std::is_same_v<Plain, Polygon>) {
      toml.field("corners", shape.corners);
    } else {
      point_fields(shape.centre, toml);
      if constexpr (std::is_same_v<Plain, Disc>) {
        toml.field("radius_m", shape.radius_m);
      } else {
        toml.field("width_m", shape.width_m);
        toml.field("height_m", shape.height_m);
        toml.field("direction_rad", shape.direction_rad);
      }
    }
  }
};

template <typename Zone, typename Toml>
void zone_fields(Zone& zone, Toml& toml) {
  std::visit(ShapeFields<Toml>{toml}, zone.shape);
  toml.field("friction", zone.friction);
  toml.field("slip", zone.slip);
}

// Paths, in the order of Path. Points and phases are tables of their own.

const std::vector<std::string> kPaths = {"square", "straight",  "figure_eight", "waypoints", "wheel_speeds",
                                         "hand",   "rectangle", "manoeuvres",   "replay"};
const Path kEmptyPaths[] = {SquarePath{}, StraightPath{},  FigureEightPath{}, WaypointPath{}, WheelSpeedPath{},
                            HandPath{},   RectanglePath{}, ManoeuvrePath{},   ReplayPath{}};
const std::vector<std::string> kReplayBy = {"wheels", "commands"};

template <typename Toml>
struct PathFields {
  Toml& toml;

  template <typename P>
  void operator()(P& path) const {
    using Plain = std::remove_const_t<P>;
    if constexpr (std::is_same_v<Plain, SquarePath>) {
      toml.field("side_m", path.side_m);
      toml.field("clockwise", path.clockwise);
    } else if constexpr (std::is_same_v<Plain, StraightPath>) {
      toml.field("length_m", path.length_m);
      toml.field("there_and_back", path.there_and_back);
    } else if constexpr (std::is_same_v<Plain, FigureEightPath>) {
      toml.field("radius_m", path.radius_m);
      toml.field("loops", path.loops);
    } else if constexpr (std::is_same_v<Plain, RectanglePath>) {
      toml.field("length_m", path.length_m);
      toml.field("width_m", path.width_m);
      toml.field("corner_radius_m", path.corner_radius_m);
      toml.field("clockwise", path.clockwise);
    } else if constexpr (std::is_same_v<Plain, WheelSpeedPath>) {
      toml.field("ramp_s", path.ramp_s);
    } else if constexpr (std::is_same_v<Plain, HandPath>) {
      toml.field("duration_s", path.duration_s);
    } else if constexpr (std::is_same_v<Plain, ReplayPath>) {
      toml.field("recording", path.recording);
      toml.choice("by", path.by, kReplayBy);
    }
  }
};

template <typename S, typename Toml>
void top_fields(S& scenario, Toml& toml) {
  toml.field("name", scenario.name);
  toml.field("about", scenario.about);
  toml.field("step_s", scenario.step_s);
  toml.field("seed", scenario.seed);
}

void read_floor(TomlTable table, Floor& floor) {
  floor_fields(floor, table);
  TomlTable roughness = table.table("roughness");
  roughness_fields(floor.roughness, roughness);
  if (table.has("bump")) floor.bumps.clear();  // those of an included scenario
  if (table.has("slip_zone")) floor.slip_zones.clear();
  for (TomlTable& element : table.tables("bump")) {
    Bump bump;
    bump_fields(bump, element);
    floor.bumps.push_back(bump);
  }
  for (TomlTable& element : table.tables("slip_zone")) {
    SlipZone zone;
    element.require("shape");
    zone.shape = kEmptyShapes[element.index_of_choice("shape", 0, kShapes)];
    zone_fields(zone, element);
    floor.slip_zones.push_back(zone);
  }
}

// One effect: its words decide which parameters may stand there.
ActiveEffect read_effect(TomlTable& table) {
  std::vector<std::string> names;
  for (const EffectEntry& entry : effect_catalogue()) names.push_back(entry.name);
  table.require("effect");
  const EffectEntry& entry = effect_catalogue()[table.index_of_choice("effect", 0, names)];
  ActiveEffect active;
  active.effect = entry.name;
  if (table.failure()) return active;
  table.require("component");
  table.field("component", active.component);
  if (!may_act_on(entry, active.component)) table.index_of_choice("component", 0, entry.components);
  for (const EffectParameter& parameter : entry.parameters) {
    if (is_wanted(parameter, table.has("at_s"))) table.require(parameter.name.c_str());
    std::optional<double> value;
    table.field(parameter.name.c_str(), value);
    if (value) active.parameters.emplace_back(parameter.name, *value);
  }
  return active;
}

void write_effect(TomlText& text, const ActiveEffect& active) {
  text.table_element("effect");
  text.field("effect", active.effect);
  text.field("component", active.component);
  for (const auto& [name, value] : active.parameters) text.field(name.c_str(), value);
}

void read_path(TomlTable table, Path& path) {
  if (!table.present()) return;
  table.require("kind");
  path = kEmptyPaths[table.index_of_choice("kind", 0, kPaths)];
  std::visit(PathFields<TomlTable>{table}, path);
  if (auto* way = std::get_if<WaypointPath>(&path))
    for (TomlTable& element : table.tables("point")) {
      element.require("x_m");
      element.require("y_m");
      point_fields(way->points.emplace_back(), element);
    }
  if (auto* wheel = std::get_if<WheelSpeedPath>(&path))
    for (TomlTable& element : table.tables("phase")) wheel_speed_fields(wheel->phases.emplace_back(), element);
  if (auto* manoeuvres = std::get_if<ManoeuvrePath>(&path))
    for (TomlTable& element : table.tables("move")) manoeuvre_fields(manoeuvres->moves.emplace_back(), element);
  if (std::holds_alternative<ReplayPath>(path)) table.require("recording");
}

void write_path(TomlText& text, const Path& path) {
  text.table("path");
  text.choice("kind", path.index(), kPaths);
  std::visit(PathFields<TomlText>{text}, path);
  if (const auto* way = std::get_if<WaypointPath>(&path))
    for (const Vec2& point : way->points) {
      text.table_element("path.point");
      point_fields(point, text);
    }
  if (const auto* wheel = std::get_if<WheelSpeedPath>(&path))
    for (const WheelSpeeds& phase : wheel->phases) {
      text.table_element("path.phase");
      wheel_speed_fields(phase, text);
    }
  if (const auto* manoeuvres = std::get_if<ManoeuvrePath>(&path))
    for (const Manoeuvre& move : manoeuvres->moves) {
      text.table_element("path.move");
      manoeuvre_fields(move, text);
    }
}

// The nominal vehicle: a file named, a table inside, or the LabMate where neither stands there.
Result<Done> read_nominal(TomlTable& top, const std::string& path, Scenario& scenario) {
  if (top.has_table("vehicle")) {
    scenario.vehicle_file.clear();
    TomlTable inside = top.table("vehicle");
    scenario.vehicle = vehicle_from(inside, "vehicle.");
    return Done{};
  }
  top.field("vehicle", scenario.vehicle_file);
  if (scenario.vehicle_file.empty() || top.failure()) return Done{};
  std::error_code failure;
  const std::string vehicle_path = beside(path, scenario.vehicle_file);
  if (!std::filesystem::exists(vehicle_path, failure))
    return Error{top.place_of("vehicle") + ": vehicle", "'" + scenario.vehicle_file + "', which does not exist",
                 "a vehicle file, relative to the scenario"};
  Result<Vehicle> vehicle = read_vehicle(vehicle_path);
  if (!vehicle) return vehicle.error();
  scenario.vehicle = *vehicle;
  return Done{};
}

// A file that is being read, and the one that includes it.
struct Reading {
  std::string path;
  const Reading* included_by = nullptr;

  bool is_under_way(const std::string& other) const {
    std::error_code failure;
    return std::filesystem::equivalent(path, other, failure) || (included_by && included_by->is_under_way(other));
  }
};

Result<Scenario> read_scenario(const Reading& reading);

// What an included scenario says, seen from the including file.
Result<Done> read_included(TomlTable& top, const Reading& reading, Scenario& scenario) {
  const std::string& path = reading.path;
  std::string named;
  top.field("include", named);
  const std::string file = beside(path, named), place = top.place_of("include") + ": include";
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file, failure))
    return Error{place, "'" + named + "', which does not exist", "a scenario, relative to this file"};
  if (reading.is_under_way(file)) return Error{place, "'" + named + "', which includes itself", "another scenario"};
  Result<Scenario> included = read_scenario(Reading{file, &reading});
  if (!included) return included.error();
  scenario = std::move(*included);
  scenario.expectations.clear();
  const auto seen_from_here = [&](std::string& other) {
    if (!other.empty())
      other = std::filesystem::path(beside(file, other))
                  .lexically_relative(std::filesystem::path(path).parent_path().lexically_normal())
                  .string();
  };
  seen_from_here(scenario.vehicle_file);
  if (ReplayPath* replays = std::get_if<ReplayPath>(&scenario.path)) seen_from_here(replays->recording);
  return Done{};
}

// All but the checks at the end, which are the whole file's.
Result<Done> read_fields(TomlTable& top, const Reading& reading, Scenario& scenario) {
  const std::string& path = reading.path;
  const bool includes = top.has("include");
  if (includes)
    if (const Result<Done> done = read_included(top, reading, scenario); !done) return done.error();
  top_fields(scenario, top);
  const bool another_vehicle = top.has("vehicle");
  const Result<Done> nominal = read_nominal(top, path, scenario);
  if (!nominal) return nominal.error();
  if (another_vehicle) {
    scenario.machine = {};
    if (!includes) scenario.motor = usual_motor(scenario.vehicle.kind);
  }

  read_actual(top.table("actual"), scenario, !includes || another_vehicle);
  TomlTable motor = top.table("motor");
  motor_fields(scenario.motor, motor);
  read_floor(top.table("floor"), scenario.floor);
  if (top.has("effect")) scenario.effects.clear();
  for (TomlTable& element : top.tables("effect")) scenario.effects.push_back(read_effect(element));
  TomlTable start = top.table("start");
  pose_fields(scenario.start, start);
  TomlTable driving = top.table("driving");
  driving_fields(scenario.driving, driving);
  read_path(top.table("path"), scenario.path);
  TomlTable sensors = top.table("sensors");
  sensor_fields(scenario.sensors, sensors);
  if (TomlTable benchmark = top.table("benchmark"); benchmark.present()) {
    if (!scenario.benchmark) scenario.benchmark.emplace();
    benchmark_fields(*scenario.benchmark, benchmark);
  }
  for (TomlTable& element : top.tables("expect")) {
    element.require("figure");
    expectation_fields(scenario.expectations.emplace_back(), element);
    if (!element.has("at_least")) element.require("at_most");
  }
  return Done{};
}

Result<Scenario> read_scenario(const Reading& reading) {
  Result<TomlTable> file = TomlTable::read(reading.path);
  if (!file) return file.error();
  TomlTable& top = *file;
  Scenario scenario;
  if (const Result<Done> read = read_fields(top, reading, scenario); !read) return read.error();
  const Result<Done> done = top.finish();
  if (!done) return done.error();
  for (const std::string& problem : problems_in(scenario)) return top.error_of(problem);
  return scenario;
}

}  // namespace

std::string beside(const std::string& scenario_path, const std::string& named_file) {
  const std::filesystem::path named(named_file);
  if (named.is_absolute()) return named_file;
  return (std::filesystem::path(scenario_path).parent_path() / named).lexically_normal().string();
}

Result<Scenario> read_scenario(const std::string& path) {
  Result<Scenario> scenario = read_scenario(Reading{path});
  return scenario ? scenario : or_another_kind(scenario.error(), path, FileKind::scenario);
}

Result<Scenario> scenario_from(TomlTable& table, const std::string& path) {
  Scenario scenario;
  if (const Result<Done> read = read_fields(table, Reading{path}, scenario); !read) return read.error();
  if (table.failure()) return *table.failure();
  for (const std::string& problem : problems_in(scenario)) return Error{path + ": scenario." + problem, "", ""};
  return scenario;
}

Result<Done> write_scenario(const std::string& path, const Scenario& scenario) {
  for (const std::string& problem : problems_in(scenario)) return Error{path + ": " + problem, "", ""};
  constexpr auto kLargestSeed = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (scenario.seed > kLargestSeed)
    return Error{path + ": seed", std::to_string(scenario.seed), "at most " + std::to_string(kLargestSeed)};
  TomlText text;
  top_fields(scenario, text);
  if (scenario.vehicle_file.empty()) {
    text.table("vehicle");
    write_vehicle_to(text, scenario.vehicle, "vehicle.");
  } else {
    text.field("vehicle", scenario.vehicle_file);
  }
  write_actual(text, scenario);
  text.table("motor");
  motor_fields(scenario.motor, text);
  text.table("floor");
  floor_fields(scenario.floor, text);
  text.table("floor.roughness");
  roughness_fields(scenario.floor.roughness, text);
  for (const Bump& bump : scenario.floor.bumps) {
    text.table_element("floor.bump");
    bump_fields(bump, text);
  }
  for (const SlipZone& zone : scenario.floor.slip_zones) {
    text.table_element("floor.slip_zone");
    text.choice("shape", zone.shape.index(), kShapes);
    zone_fields(zone, text);
  }
  for (const ActiveEffect& active : scenario.effects) write_effect(text, active);
  text.table("start");
  pose_fields(scenario.start, text);
  text.table("driving");
  driving_fields(scenario.driving, text);
  write_path(text, scenario.path);
  text.table("sensors");
  sensor_fields(scenario.sensors, text);
  if (scenario.benchmark) {
    text.table("benchmark");
    benchmark_fields(*scenario.benchmark, text);
  }
  for (const Expectation& expectation : scenario.expectations) {
    text.table_element("expect");
    expectation_fields(expectation, text);
  }
  return write_whole_file(path, text.text());
}

}  // namespace odolab
