#include "app/gui/kept_samples.h"

namespace odolab {

namespace {

constexpr std::size_t kAtOnce = 3000;  // samples: a minute of them, 20 ms apart

}  // namespace

void KeptSamples::take_from(Simulation& simulation) {
  if (simulation.samples() < seen_ + kAtOnce) return;
  seen_ = simulation.samples();
  const SampledRun run = simulation.take_samples();
  std::vector<double> commands, truth;
  for (const BaseCommand& c : run.commands)
    commands.insert(commands.end(), {c.speed_mps, c.yaw_rate_radps, c.sideways_mps});
  for (const TimedPose& t : run.truth)
    truth.insert(truth.end(), {t.time_s, t.pose.x_m, t.pose.y_m, t.pose.heading_rad});
  time_s_.append(run.time_s);
  readings_.append(run.readings);
  commands_.append(commands);
  truth_.append(truth);
}

Result<Recording> KeptSamples::recording(const Simulation& simulation) const {
  SampledRun run;
  Result<std::vector<double>> time_s = time_s_.all(), readings = readings_.all();
  Result<std::vector<double>> commands = commands_.all(), truth = truth_.all();
  for (const Result<std::vector<double>>* part : {&time_s, &readings, &commands, &truth})
    if (!*part) return part->error();
  run.time_s = std::move(*time_s);
  run.readings = std::move(*readings);
  for (std::size_t i = 0; i + 2 < commands->size(); i += 3)
    run.commands.push_back({(*commands)[i], (*commands)[i + 1], (*commands)[i + 2]});
  for (std::size_t i = 0; i + 3 < truth->size(); i += 4)
    run.truth.push_back({(*truth)[i], {(*truth)[i + 1], (*truth)[i + 2], (*truth)[i + 3]}});
  return simulation.recording(std::move(run));
}

}  // namespace odolab
