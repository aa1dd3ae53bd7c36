#include "core/diagnosis/model/ready_run.h"

namespace odolab {

Result<InnovationRun> ready_run(const CheckedRecording& c, const Vehicle& vehicle) {
  Result<InnovationRun> run = innovation_run(c.recording, vehicle, c.left_out_s);
  if (!run) return run;
  run->speeds_are_held = c.from_commands;
  if (c.from_commands) run->smooth.clear();  // a command is what it is
  return run;
}

}  // namespace odolab
