#include "app/cli/internal_calibration.h"

#include <algorithm>

#include "app/cli/command.h"
#include "app/cli/parameter_table.h"
#include "app/cli/terminal.h"
#include "core/calibration/internal.h"
#include "core/io/vehicle_toml.h"

namespace odolab {

int calibrate_from_inside(const std::vector<Recording>& recordings, const Vehicle& nominal, const std::string& out) {
  const Result<InternalCalibration> calibration =
      calibrate_internally(recordings, nominal, terminal_progress("calibrating"));
  if (!calibration) return bad_input(calibration.error());
  if (interrupted()) return stopped_before_its_end();
  const bool anything = std::any_of(calibration->parameters.begin(), calibration->parameters.end(),
                                    [](const ParameterEstimate& p) { return p.determined; });
  if (!out.empty() && anything)
    if (Result<Done> written = write_vehicle(out, calibration->vehicle); !written) return bad_input(written.error());

  print_parameters(calibration->parameters);
  std::printf("\nfrom the encoders alone; no truth was looked at\n");
  for (const std::string& sentence : calibration->taken_as_known) std::printf("taken as known: %s\n", sentence.c_str());
  for (const std::string& sentence : calibration->cannot_tell) std::printf("cannot tell: %s\n", sentence.c_str());
  for (const std::string& warning : calibration->warnings) print_message("warning: " + warning);
  if (!anything) return nothing_determined(out);
  if (!out.empty()) std::printf("\nwritten: %s\n", name_of_output(out).c_str());
  return kDone;
}

}  // namespace odolab
