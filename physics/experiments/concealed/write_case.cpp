#include <filesystem>

#include "core/io/number_text.h"
#include "core/io/recording_csv.h"
#include "core/io/scenario_toml.h"
#include "core/io/vehicle_toml.h"
#include "core/io/whole_file.h"
#include "physics/experiments/concealed/drawn_case.h"

namespace odolab::concealed {

Result<Done> write_case(const DrawnCase& c, const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Error{folder, failed.message(), "a folder that can be written to"};
  if (Result<Done> r = write_vehicle(folder + "/vehicle.toml", c.robot.scenario.vehicle); !r) return r;
  const auto write_run = [&](const Run& run) -> Result<Done> {
    const std::string& name = run.driven.recording.name;
    if (Result<Done> r = write_recording_csv(folder + "/" + name, run.driven.recording); !r) return r;
    return write_scenario(folder + "/" + name.substr(0, name.rfind('.')) + ".toml", run.plan.scenario());
  };
  for (const Run& run : c.given)
    if (Result<Done> r = write_run(run); !r) return r;
  for (const Run& run : c.held_out)
    if (Result<Done> r = write_run(run); !r) return r;
  std::string truth;
  const DifferentialDrive drive = c.robot.actual();
  truth += "wheel_radius_left_m " + number_text(drive.wheel_radius_left_m) + "\nwheel_radius_right_m " +
           number_text(drive.wheel_radius_right_m) + "\nwheelbase_m " + number_text(drive.wheelbase_m) +
           "\nrolling noise, m per root metre " + number_text(c.robot.rolling_noise_m_per_sqrt_m) + "\n";
  for (std::size_t k = 0; k < c.effects.size(); ++k) {
    truth += c.effects[k].active.effect + " (" + c.effects[k].active.component + ")";
    for (const auto& [name, value] : c.effects[k].active.parameters) truth += ", " + name + " " + number_text(value);
    if (c.effects[k].only_in_run >= 0)
      truth += ", in " + c.given[static_cast<std::size_t>(c.effects[k].only_in_run)].driven.recording.name;
    truth += ": " + number_text("%.1f", c.significance[k]) + " sigma\n";
  }
  return write_whole_file(folder + "/truth.txt", truth);
}

}  // namespace odolab::concealed
