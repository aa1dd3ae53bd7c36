// A base that follows its commands with a first-order lag; for recordings that hold only commands.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {

struct Speeds {
  double forward_mps, turn_radps;
};

Speeds told(const EffectStep& s) { return {s.told_forward_m() / s.duration_s, s.told_turn_rad() / s.duration_s}; }

// A recording begins with its first command: to a base that stood, where nothing was logged before there was one, or to
// one that had long been on its way, where a part of a drive is kept. Which of both is seen by how far it came in the
// first two time constants; forward and in its turn by itself, since it may have turned on the spot.
Speeds speeds_at_start(const DriveView& view, std::size_t first, double tau_s) {
  constexpr double kSeenOver = 2.0, kSeenAtLeast_s = 0.3;
  const EffectStep& start = view.steps[first];
  const Speeds at_once = told(start);
  if (at_once.forward_mps == 0.0 && at_once.turn_radps == 0.0) return at_once;
  // Between the middles of two steps: what a base comes that is as fast as it was told at first; and what it came, step
  // by step, since within two time constants it may go round in a circle.
  double forward_m = 0.0, turn_rad = 0.0, over_s = 0.0, came_m = 0.0, turned_rad = 0.0;
  Speeds base = at_once;
  for (std::size_t i = first; i + 1 < view.steps.size() && over_s < std::max(kSeenOver * tau_s, kSeenAtLeast_s); ++i) {
    const EffectStep &before = view.steps[i], &s = view.steps[i + 1];
    const double by_rad = wrapped(s.heading_rad - before.heading_rad), middle = before.heading_rad + 0.5 * by_rad;
    came_m += dot(s.position - before.position, {std::cos(middle), std::sin(middle)});
    turned_rad += by_rad;
    if (!(s.duration_s > 0.0)) continue;
    const Speeds now = told(s);
    const double follows = 1.0 - std::exp(-s.duration_s / tau_s);
    base.forward_mps += follows * (now.forward_mps - base.forward_mps);
    base.turn_radps += follows * (now.turn_radps - base.turn_radps);
    forward_m += base.forward_mps * s.duration_s;
    turn_rad += base.turn_radps * s.duration_s;
    over_s += s.duration_s;
  }
  const double less_s = tau_s * (1.0 - std::exp(-over_s / tau_s));  // of the first speed, of a base that stood
  const auto is_from_rest = [&](double seen, double at_once_comes, double speed) {
    return std::abs(seen - at_once_comes + speed * less_s) < std::abs(seen - at_once_comes);
  };
  return {is_from_rest(came_m, forward_m, at_once.forward_mps) ? 0.0 : at_once.forward_mps,
          is_from_rest(turned_rad, turn_rad, at_once.turn_radps) ? 0.0 : at_once.turn_radps};
}

// For a second of lag, at that time constant tau. While a command is held over dt the excess u of the speed that was
// over the command decays: by the end it moved the base by u tau (1 - k), k = exp(-dt / tau); and in the mean over the
// step by u tau (1 - (tau / dt) (1 - k)), which is more than the half of that where tau is short, since most of it
// comes first. A motion is taken to be even over its step: the steps about it take what it then lacks in the mean.
Motions lagging(const DriveView& view, double tau_s) {
  const std::size_t steps = view.steps.size();
  Motions m(steps);
  std::vector<BodyMotion> lacks(steps + 2);  // of each step, one without before and behind
  double v = std::nan(""), w = v;            // of the base; not known before the first command
  for (std::size_t i = 0; i < steps; ++i) {
    const EffectStep& s = view.steps[i];
    if (!(s.duration_s > 0.0)) continue;  // two commands may have one stamp
    const double dt = s.duration_s;
    const auto [command_v, command_w] = told(s);
    if (std::isnan(v)) {
      const Speeds start = speeds_at_start(view, i, tau_s);
      v = start.forward_mps, w = start.turn_radps;
    }
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
    // Of recordings of one robot some may hold its encoders, which read what its wheels did.
    if (!view.from_commands) return motions_by_number(Motions());
    return motions_by_number(lagging(view, std::max(shape[0], 1e-3)));
  };
  e.scan = [](const std::vector<DriveView>&) {
    return std::vector<std::vector<double>>{{0.05}, {0.1}, {0.2}, {0.3}, {0.5}, {0.8}, {1.2}};
  };
  return {e};
}

}  // namespace odolab::effects
