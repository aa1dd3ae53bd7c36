// A scenario as a TOML file. README.md beside this file lists the keys.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/scenario/scenario.h"

namespace odolab {

class TomlTable;

// Reads a scenario and the vehicle file that it names. Errors name file and line or key, what was found and what was
// expected; a scenario that comes back has no problems. The recording of a replay is not opened.
Result<Scenario> read_scenario(const std::string& path);

// The same from a table of another file; `path` is that file. What is unknown in it comes out of the table's finish().
Result<Scenario> scenario_from(TomlTable& table, const std::string& path);

// Every value is written down, so that the file says what was really run. With a `vehicle_file` the vehicle is named by
// it and must be what stands there, relative to `path`; without one it is written into the scenario.
Result<Done> write_scenario(const std::string& path, const Scenario& scenario);

// The path of a file that a scenario names (its vehicle or its recording), relative to the scenario's own.
std::string beside(const std::string& scenario_path, const std::string& named_file);

}  // namespace odolab
