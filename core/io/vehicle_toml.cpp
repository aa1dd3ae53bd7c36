#include "core/io/vehicle_toml.h"

#include <array>
#include <type_traits>

#include "core/io/file_kind.h"
#include "core/io/toml_table.h"
#include "core/io/toml_text.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

// What is written is not changed.
template <typename Toml, typename T>
using Constness = std::conditional_t<std::is_same_v<Toml, TomlText>, const T, T>;

// A kind of vehicle is one list of fields, read and written alike; sub-tables are opened by `in_table`, which knows
// both ways. What must stand in a file is asked for where it is read: a base that is only commanded has no encoder to
// speak of; the lengths are what makes it this vehicle.

// A sub-table of a kind's own table, for reading and for writing.
template <typename Fields>
void in_table(TomlTable& table, const std::string&, const char* name, const Fields& fields) {
  table.require_table(name);
  if (table.failure()) return;
  TomlTable inner = table.table(name);
  if (!table.failure()) fields(inner);
}
template <typename Fields>
void in_table(TomlText& text, const std::string& path, const char* name, const Fields& fields) {
  text.table(path + "." + name);
  fields(text);
}

void require(TomlTable& table, std::initializer_list<const char*> keys) {
  for (const char* key : keys) table.require(key);
}
void require(TomlText&, std::initializer_list<const char*>) {}

template <typename Drive, typename Toml>
void wheel_fields(Drive& drive, Toml& toml) {
  require(toml, {"wheel_radius_left_m", "wheel_radius_right_m", "wheelbase_m"});
  toml.field("wheel_radius_left_m", drive.wheel_radius_left_m);
  toml.field("wheel_radius_right_m", drive.wheel_radius_right_m);
  toml.field("wheelbase_m", drive.wheelbase_m);
}

constexpr const char* kCounts = "encoder_counts_per_revolution";

template <typename Drive>
void counts_field(Drive& drive, TomlTable& table) {
  drive.counts_are_assumed = !table.has(kCounts);
  table.field(kCounts, drive.encoder_counts_per_revolution);
}
template <typename Drive>
void counts_field(const Drive& drive, TomlText& text) {
  if (drive.counts_are_assumed && drive.encoder_counts_per_revolution == Drive{}.encoder_counts_per_revolution) return;
  text.field(kCounts, drive.encoder_counts_per_revolution);
}

template <typename Drive, typename Toml>
void encoder_fields(Drive& drive, Toml& toml) {
  counts_field(drive, toml);
  toml.field("gear_ratio", drive.gear_ratio);
  toml.field("counter_bits", drive.counter_bits);
}

template <typename Toml, typename Drive>
void drive_fields(Drive& drive, Toml& toml) {
  wheel_fields(drive, toml);
  encoder_fields(drive, toml);
}

template <typename Toml>
void fields(Constness<Toml, DifferentialDrive>& drive, Toml& toml, const std::string&) {
  drive_fields(drive, toml);
}

template <typename Toml>
void fields(Constness<Toml, SynchroDrive>& drive, Toml& toml, const std::string&) {
  require(toml, {"wheel_radius_m"});
  toml.field("wheel_radius_m", drive.wheel_radius_m);
  toml.field("steering_ratio", drive.steering_ratio);
  toml.field("wheel_rad_per_steering_rad", drive.wheel_rad_per_steering_rad);
  toml.field("base_turn_rad_per_m", drive.base_turn_rad_per_m);
  toml.field("base_turn_rad_per_steering_rad", drive.base_turn_rad_per_steering_rad);
  toml.field("base_turn_cos_rad_per_m", drive.base_turn_cos_rad_per_m);
  toml.field("base_turn_sin_rad_per_m", drive.base_turn_sin_rad_per_m);
  toml.field("drive_counts_per_revolution", drive.drive_counts_per_revolution);
  toml.field("steering_counts_per_revolution", drive.steering_counts_per_revolution);
}

// A tracked vehicle's file may have a differential drive's names instead.
bool calls_sprockets_wheels(const TomlTable& table) { return table.has("wheel_radius_left_m"); }
bool calls_sprockets_wheels(const TomlText&) { return false; }

template <typename Toml>
void fields(Constness<Toml, Tracked>& vehicle, Toml& toml, const std::string&) {
  const bool as_wheels = calls_sprockets_wheels(toml);
  const char* left = as_wheels ? "wheel_radius_left_m" : "sprocket_radius_left_m";
  const char* right = as_wheels ? "wheel_radius_right_m" : "sprocket_radius_right_m";
  const char* width = as_wheels ? "wheelbase_m" : "track_width_m";
  require(toml, {left, right, width});
  toml.field(left, vehicle.sprocket_radius_left_m);
  toml.field(right, vehicle.sprocket_radius_right_m);
  toml.field(width, vehicle.track_width_m);
  toml.field("slip_factor", vehicle.slip_factor);
  encoder_fields(vehicle, toml);
}

template <typename Toml>
void fields(Constness<Toml, LinkedTrucks>& vehicle, Toml& toml, const std::string& path) {
  require(toml, {"link_length_m"});
  toml.field("link_length_m", vehicle.link_length_m);
  toml.field("encoder_counts_per_revolution", vehicle.truck_a.encoder_counts_per_revolution);
  toml.field("link_angle_resolution_rad", vehicle.link_angle_resolution_rad);
  toml.field("link_length_resolution_m", vehicle.link_length_resolution_m);
  toml.field("link_angle_a_offset_rad", vehicle.link_angle_a_offset_rad);
  toml.field("link_angle_b_offset_rad", vehicle.link_angle_b_offset_rad);
  toml.field("link_length_offset_m", vehicle.link_length_offset_m);
  in_table(toml, path, "truck_a", [&](auto& inner) { wheel_fields(vehicle.truck_a, inner); });
  in_table(toml, path, "truck_b", [&](auto& inner) { wheel_fields(vehicle.truck_b, inner); });
  if constexpr (std::is_same_v<Toml, TomlTable>)
    vehicle.truck_b.encoder_counts_per_revolution = vehicle.truck_a.encoder_counts_per_revolution;
}
template <typename Toml>
void fields(Constness<Toml, Clapper>& vehicle, Toml& toml, const std::string& path) {
  fields<Toml>(static_cast<Constness<Toml, LinkedTrucks>&>(vehicle), toml, path);
}
template <typename Toml>
void fields(Constness<Toml, OmniMate>& vehicle, Toml& toml, const std::string& path) {
  fields<Toml>(static_cast<Constness<Toml, LinkedTrucks>&>(vehicle), toml, path);
}

template <typename Toml>
void fields(Constness<Toml, EncoderTrailer>& vehicle, Toml& toml, const std::string& path) {
  require(toml, {"hitch_offset_m", "drawbar_length_m"});
  toml.field("hitch_offset_m", vehicle.hitch_offset_m);
  toml.field("drawbar_length_m", vehicle.drawbar_length_m);
  toml.field("hitch_angle_resolution_rad", vehicle.hitch_angle_resolution_rad);
  toml.field("hitch_angle_offset_rad", vehicle.hitch_angle_offset_rad);
  in_table(toml, path, "tow", [&](auto& inner) { drive_fields(vehicle.tow, inner); });
  in_table(toml, path, "trailer", [&](auto& inner) { drive_fields(vehicle.trailer, inner); });
}

template <typename Toml>
void fields(Constness<Toml, SmartEncoderTrailer>& vehicle, Toml& toml, const std::string& path) {
  require(toml, {"drawbar_length_m"});
  toml.field("drawbar_length_m", vehicle.drawbar_length_m);
  toml.field("hitch_angle_resolution_rad", vehicle.hitch_angle_resolution_rad);
  toml.field("hitch_angle_offset_rad", vehicle.hitch_angle_offset_rad);
  in_table(toml, path, "tow", [&](auto& inner) { drive_fields(vehicle.tow, inner); });
  in_table(toml, path, "trailer", [&](auto& inner) { drive_fields(vehicle.trailer, inner); });
}

template <typename Castor, typename Toml>
void castor_fields(Castor& castor, Toml& toml) {
  require(toml, {"pivot_radius_m", "pivot_angle_rad", "offset_m", "wheel_radius_left_m", "wheel_radius_right_m",
                 "wheel_offset_left_m", "wheel_offset_right_m"});
  toml.field("pivot_radius_m", castor.pivot_radius_m);
  toml.field("pivot_angle_rad", castor.pivot_angle_rad);
  toml.field("offset_m", castor.offset_m);
  toml.field("wheel_radius_left_m", castor.wheel_radius_left_m);
  toml.field("wheel_radius_right_m", castor.wheel_radius_right_m);
  toml.field("wheel_offset_left_m", castor.wheel_offset_left_m);
  toml.field("wheel_offset_right_m", castor.wheel_offset_right_m);
  toml.field("pivot_encoder_offset_rad", castor.pivot_encoder_offset_rad);
}

void castors(MultiCastor& vehicle, TomlTable& table, const std::string&) {
  table.require("castor");
  for (TomlTable& element : table.tables("castor")) castor_fields(vehicle.castors.emplace_back(), element);
}
void castors(const MultiCastor& vehicle, TomlText& text, const std::string& path) {
  for (const Castor& castor : vehicle.castors) {
    text.table_element(path + ".castor");
    castor_fields(castor, text);
  }
}

template <typename Toml>
void fields(Constness<Toml, MultiCastor>& vehicle, Toml& toml, const std::string& path) {
  toml.field("wheel_encoder_resolution_rad", vehicle.wheel_encoder_resolution_rad);
  toml.field("pivot_encoder_resolution_rad", vehicle.pivot_encoder_resolution_rad);
  castors(vehicle, toml, path);
}

struct Kind {
  const char* name;
  void (*read)(TomlTable& table, Vehicle& vehicle);
  void (*write)(TomlText& text, const Vehicle& vehicle, const std::string& path);
};

template <typename K>
constexpr Kind kind_of() {
  return {K::kKind, [](TomlTable& table, Vehicle& vehicle) { fields<TomlTable>(vehicle.kind.emplace<K>(), table, ""); },
          [](TomlText& text, const Vehicle& vehicle, const std::string& path) {
            fields<TomlText>(std::get<K>(vehicle.kind), text, path);
          }};
}

// One for each type of VehicleKind, in its order.
template <typename... Ks>
constexpr std::array<Kind, sizeof...(Ks)> kinds_of(const std::variant<Ks...>*) {
  return {kind_of<Ks>()...};
}
constexpr auto kKinds = kinds_of(static_cast<const VehicleKind*>(nullptr));

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

}  // namespace

Vehicle vehicle_from(TomlTable& table, const std::string& key_path) {
  Vehicle vehicle;
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  table.require("kind");
  const Kind& kind = kKinds[table.index_of_choice("kind", 0, names)];
  if (table.failure()) return vehicle;
  table.field("name", vehicle.name);
  table.require_table(kind.name);
  if (table.failure()) return vehicle;
  TomlTable of_kind = table.table(kind.name);
  if (table.failure()) return vehicle;
  kind.read(of_kind, vehicle);
  TomlTable mounting = table.table("truth_mounting");
  mounting_fields(vehicle.truth, mounting);
  for (const std::string& problem : problems_in(vehicle.kind))
    table.fail(table.error_of(key_path + kind.name + "." + problem));
  return vehicle;
}

void write_vehicle_to(TomlText& text, const Vehicle& vehicle, const std::string& key_path) {
  const Kind& kind = kKinds[vehicle.kind.index()];
  text.field("kind", std::string(kind.name));
  text.field("name", vehicle.name);
  text.table(key_path + kind.name);
  kind.write(text, vehicle, key_path + kind.name);
  if (is_plain(vehicle.truth)) return;
  text.table(key_path + "truth_mounting");
  mounting_fields(vehicle.truth, text);
}

void read_vehicle_kind(TomlTable& table, VehicleKind& kind) {
  Vehicle vehicle;
  kKinds[kind.index()].read(table, vehicle);
  kind = vehicle.kind;
}

void write_vehicle_kind(TomlText& text, const VehicleKind& kind, const std::string& path) {
  kKinds[kind.index()].write(text, {{}, kind, {}}, path);
}

Result<Vehicle> read_vehicle(const std::string& path) {
  const auto failed = [&](const Error& error) { return or_another_kind(error, path, FileKind::vehicle); };
  Result<TomlTable> table = TomlTable::read(path);
  if (!table) return failed(table.error());
  Vehicle vehicle = vehicle_from(*table, "");
  const Result<Done> done = table->finish();
  if (!done) return failed(done.error());
  return vehicle;
}

Result<Done> write_vehicle(const std::string& path, const Vehicle& vehicle) {
  const std::vector<std::string> problems = problems_in(vehicle.kind);
  if (!problems.empty()) return Error{path + ": " + problems.front(), "", ""};
  TomlText text;
  write_vehicle_to(text, vehicle, "");
  return write_whole_file(path, text.text());
}

}  // namespace odolab
