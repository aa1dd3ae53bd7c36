// A base that follows its commands with a first-order lag; for recordings that hold only commands.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

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
    Motions m(view.steps.size());
    const double tau = std::max(shape[0], 1e-3);
    double v = 0.0, w = 0.0;
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const double dt = s.duration_s, command_v = s.forward_m() / dt, command_w = s.turn_rad / dt;
      if (i == 0) v = command_v, w = command_w;
      const double keep = std::exp(-dt / tau), mean = tau / dt * (1.0 - keep);  // of the old excess over the step
      m[i] = {(v - command_v) * mean * dt / tau, 0.0, (w - command_w) * mean * dt / tau};
      v = command_v + (v - command_v) * keep;
      w = command_w + (w - command_w) * keep;
    }
    return std::vector<Motions>{m};
  };
  e.scan = [](const std::vector<DriveView>&) {
    return std::vector<std::vector<double>>{{0.05}, {0.1}, {0.2}, {0.3}, {0.5}, {0.8}, {1.2}};
  };
  return {e};
}

}  // namespace odolab::effects
