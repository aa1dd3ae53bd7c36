// A base that follows its commands with a first-order lag; for recordings that hold only commands.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {

// For a second of lag, at that time constant tau. While a command is held over dt the excess u of the speed that was
// over the command decays: by the end it moved the base by u tau (1 - k), k = exp(-dt / tau); and in the mean over the
// step by u tau (1 - (tau / dt) (1 - k)), which is more than the half of that where tau is short, since most of it
// comes first. A motion is taken to be even over its step: the steps about it take what it then lacks in the mean.
Motions lagging(const DriveView& view, double tau_s) {
  const std::size_t steps = view.steps.size();
  Motions m(steps);
  std::vector<BodyMotion> lacks(steps + 2);  // of each step, one without before and behind
  double v = std::nan(""), w = v;  // of the base; not known before the first command
  for (std::size_t i = 0; i < steps; ++i) {
    const EffectStep& s = view.steps[i];
    if (!(s.duration_s > 0.0)) continue;  // two commands may have one stamp
    const double dt = s.duration_s, command_v = s.forward_m() / dt, command_w = s.turn_rad / dt;
    if (std::isnan(v)) v = command_v, w = command_w;
    const double keep = std::exp(-dt / tau_s), gone = 1.0 - keep, lack = 1.0 - tau_s / dt * gone - 0.5 * gone;
    m[i] = {(v - command_v) * gone, 0.0, (w - command_w) * gone};
    lacks[i + 1] = {(v - command_v) * lack, 0.0, (w - command_w) * lack};
    v = command_v + (v - command_v) * keep;
    w = command_w + (w - command_w) * keep;
  }
  for (std::size_t i = 0; i < steps; ++i) {
    m[i].forward_m += 0.5 * (lacks[i + 2].forward_m - lacks[i].forward_m);
    m[i].turn_rad += 0.5 * (lacks[i + 2].turn_rad - lacks[i].turn_rad);
  }
  return m;
}

}  // namespace

std::vector<Effect> actuator_lag() {
  Effect e;
  e.name = "actuator_lag";
  e.component = "vehicle";
  e.amplitudes = {{"time_constant_s", "s", 0.1, 0.001, 5.0}};
  e.shapes = {{"time_constant_s", "s"}};
  e.shape_follows_amplitude = true;
  e.only_commands = true;
  e.sentence = "the base follows its commands with a lag";
  e.regime = "while the commands change";
  e.looks_like = {"actuator_delay", "traction_slip"};
  e.told_apart_by = "sharp steps of the command, each held for a second or more";
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    return motions_by_number(lagging(view, std::max(shape[0], 1e-3)));
  };
  e.scan = [](const std::vector<DriveView>&) {
    return std::vector<std::vector<double>>{{0.05}, {0.1}, {0.2}, {0.3}, {0.5}, {0.8}, {1.2}};
  };
  return {e};
}

}  // namespace odolab::effects
