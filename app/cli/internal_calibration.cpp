#include "app/cli/internal_calibration.h"

#include <algorithm>

#include "app/cli/command.h"
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

  std::vector<std::vector<std::string>> rows{{"parameter", "before", "estimate", "+- (1 sigma)", "unit"}};
  for (const ParameterEstimate& p : calibration->parameters)
    rows.push_back({p.name, text_of("%.6g", p.nominal), p.determined ? text_of("%.7g", p.value) : "as before",
                    p.determined ? text_of("%.1e", p.stderr_value) : "not determined", p.unit});
  print_table(rows);
  std::printf("\nfrom the encoders alone; no truth was looked at\n");
  for (const std::string& sentence : calibration->taken_as_known) std::printf("taken as known: %s\n", sentence.c_str());
  for (const std::string& sentence : calibration->cannot_tell) std::printf("cannot tell: %s\n", sentence.c_str());
  for (const std::string& warning : calibration->warnings) print_message("warning: " + warning);
  if (!anything)
    std::printf("\nNothing could be determined, and no vehicle was written.\n");
  else if (!out.empty())
    std::printf("\nwritten: %s\n", name_of_output(out).c_str());
  return kDone;
}

}  // namespace odolab
