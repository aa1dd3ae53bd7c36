// A vehicle as a TOML file: `kind`, `name`, a table named after the kind, and where the truth sits, if that is known.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

class TomlTable;
class TomlText;

// Errors name file and line or key; a vehicle that comes back has no problems.
Result<Vehicle> read_vehicle(const std::string& path);
Result<Done> write_vehicle(const std::string& path, const Vehicle& vehicle);

// The same as part of another file. Reading leaves what is wrong in the table; `key_path` is the path to it, as
// "vehicle." for problems in a table of that name. Writing puts the sub-tables under `key_path`.
Vehicle vehicle_from(TomlTable& table, const std::string& key_path);
void write_vehicle_to(TomlText& text, const Vehicle& vehicle, const std::string& key_path);

// The table of a kind alone, without its name and mounting. `kind` holds the kind that is to be read.
void read_vehicle_kind(TomlTable& table, VehicleKind& kind);
void write_vehicle_kind(TomlText& text, const VehicleKind& kind, const std::string& path);

}  // namespace odolab
