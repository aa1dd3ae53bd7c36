#include "core/io/vehicle_toml.h"

#include "core/io/toml_table.h"
#include "core/io/toml_text.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

// A kind of vehicle is one entry in `kKinds`, in the order of Vehicle::kind, and one list of fields.

template <typename Drive, typename Toml>
void differential_drive_fields(Drive& drive, Toml& toml) {
  toml.field("wheel_radius_left_m", drive.wheel_radius_left_m);
  toml.field("wheel_radius_right_m", drive.wheel_radius_right_m);
  toml.field("wheelbase_m", drive.wheelbase_m);
  toml.field("encoder_counts_per_revolution", drive.encoder_counts_per_revolution);
  toml.field("gear_ratio", drive.gear_ratio);
  toml.field("counter_bits", drive.counter_bits);
}

void read_differential_drive(TomlTable& table, Vehicle& vehicle) {
  // a base that is only commanded has no encoder to speak of; the lengths are what makes it this vehicle
  for (const char* key : {"wheel_radius_left_m", "wheel_radius_right_m", "wheelbase_m"}) table.require(key);
  DifferentialDrive drive;
  differential_drive_fields(drive, table);
  vehicle.kind = drive;
}

void write_differential_drive(TomlText& text, const Vehicle& vehicle) {
  differential_drive_fields(std::get<DifferentialDrive>(vehicle.kind), text);
}

struct Kind {
  const char* name;
  void (*read)(TomlTable& table, Vehicle& vehicle);
  void (*write)(TomlText& text, const Vehicle& vehicle);
};

constexpr Kind kKinds[] = {
    {"differential_drive", read_differential_drive, write_differential_drive},
};

template <typename Mounting, typename Toml>
void mounting_fields(Mounting& truth, Toml& toml) {
  toml.field("x_m", truth.axle_T_tracked.x_m);
  toml.field("y_m", truth.axle_T_tracked.y_m);
  toml.field("heading_rad", truth.axle_T_tracked.heading_rad);
  toml.field("time_offset_s", truth.time_offset_s);
}

bool is_plain(const TruthMounting& truth) {
  const Pose& p = truth.axle_T_tracked;
  return p.x_m == 0.0 && p.y_m == 0.0 && p.heading_rad == 0.0 && truth.time_offset_s == 0.0;
}

std::vector<std::string> problems_in_kind(const Vehicle& vehicle) {
  return std::visit([](const auto& kind) { return problems_in(kind); }, vehicle.kind);
}

}  // namespace

Vehicle vehicle_from(TomlTable& table, const std::string& key_path) {
  Vehicle vehicle;
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  table.require("kind");
  const Kind& kind = kKinds[table.index_of_choice("kind", 0, names)];
  if (table.failure()) return vehicle;
  table.field("name", vehicle.name);
  table.require(kind.name);
  if (table.failure()) return vehicle;
  TomlTable of_kind = table.table(kind.name);
  if (table.failure()) return vehicle;
  kind.read(of_kind, vehicle);
  TomlTable mounting = table.table("truth_mounting");
  mounting_fields(vehicle.truth, mounting);
  for (const std::string& problem : problems_in_kind(vehicle))
    table.fail(table.error_of(key_path + kind.name + "." + problem));
  return vehicle;
}

void write_vehicle_to(TomlText& text, const Vehicle& vehicle, const std::string& key_path) {
  const Kind& kind = kKinds[vehicle.kind.index()];
  text.field("kind", std::string(kind.name));
  text.field("name", vehicle.name);
  text.table(key_path + kind.name);
  kind.write(text, vehicle);
  if (is_plain(vehicle.truth)) return;
  text.table(key_path + "truth_mounting");
  mounting_fields(vehicle.truth, text);
}

Result<Vehicle> read_vehicle(const std::string& path) {
  Result<TomlTable> table = TomlTable::read(path);
  if (!table) return table.error();
  Vehicle vehicle = vehicle_from(*table, "");
  const Result<Done> done = table->finish();
  if (!done) return done.error();
  return vehicle;
}

Result<Done> write_vehicle(const std::string& path, const Vehicle& vehicle) {
  const std::vector<std::string> problems = problems_in_kind(vehicle);
  if (!problems.empty()) return Error{path + ": " + problems.front(), "", ""};
  TomlText text;
  write_vehicle_to(text, vehicle, "");
  return write_whole_file(path, text.text());
}

}  // namespace odolab
