#include "core/diagnosis/ready_run.h"

namespace odolab {

InnovationRun ready_run(const CheckedRecording& c, InnovationRun run, double offset_s) {
  run.speeds_are_held = c.from_commands;
  if (c.from_commands) run.smooth.clear();  // a command is what it is
  for (const auto& [from, to] : c.break_s) {
    bool behind = false;
    for (std::size_t i = 0; i < run.truth.size(); ++i) {
      const double t = run.truth[i].time_s - offset_s;
      if (t >= from && t <= to) run.set_aside[i] = 1;
      if (t > to && !behind) {
        run.set_aside[i] = 2;
        behind = true;
      }
    }
  }
  return run;
}

void put_clock_right(InnovationRun& run, double rate, double offset_s) {
  const double t0 = run.truth.front().time_s - offset_s;
  for (std::vector<WheelSample>* wheels : {&run.wheels, &run.smooth})
    for (WheelSample& w : *wheels) w.time_s = t0 + (w.time_s - t0) / (1.0 + rate);
}

}  // namespace odolab
