// The forms in which effects show: the planar world plays those that a diagnosis finds.
#include <gtest/gtest.h>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/effects/effect.h"
#include "core/scenario/effect_catalogue.h"
#include "physics/model_replay.h"
#include "test/physics/effects/effect_runs.h"

namespace odolab {
namespace {

// Straights and bends at two speeds, turns on the spot, reversals with a metre behind each, and a rest.
std::vector<WheelSpeeds> varied_drive() {
  return {phase(3.0, 0.4, 0.0), phase(3.0, 0.4, 0.7),  phase(3.0, -0.4, 0.2), phase(1.5, 0.0, 0.0),
          phase(3.0, 0.3, 0.0), phase(3.0, 0.0, -1.2), phase(3.0, -0.3, 0.0), phase(3.0, 0.25, -0.6),
          phase(3.0, 0.5, 0.4), phase(1.0, 0.0, 0.0)};
}

Recording recorded_drive() {
  Scenario scenario = table_drive(varied_drive(), {});
  std::get<DifferentialDrive>(scenario.vehicle.kind).encoder_counts_per_revolution = 200000.0;
  Simulation simulation(scenario, 1);
  run_to_end(simulation);
  return simulation.recording();
}

// Its places and times are on the varied drive.
ActiveEffect found(const Effect& effect, int form) {
  ActiveEffect active{effect.name, effect.component, {}};
  const auto size = [&](const std::string& name) {
    return name == "gap_rad"            ? 0.05
           : name == "kick_rad"         ? 0.03
           : name == "extra_distance_m" ? 0.004
           : name == "left_more_m"      ? 0.001
                                        : 0.0;
  };
  for (const Effect::Amplitude& a : effect.amplitudes)
    active.parameters.emplace_back(a.name, size(a.name) > 0.0 ? size(a.name) : std::min(3.0 * a.medium, 0.5 * a.high));
  if (effect.name == "floor_slope_creep") active.parameters = {{"direction_rad", 1.0}, {"creep_mps", 0.004}};
  for (const Effect::Amplitude& shape : effect.shapes) {
    if (shape.name == "recording" || shape.name == "gap_rad" || shape.name == "per_radps") continue;
    if (shape.name == kSessionStart && !effects::drifts_through_the_session(form)) continue;
    active.parameters.emplace_back(shape.name, shape.name == "x_m"               ? 0.7
                                               : shape.name == "y_m"             ? effect.name == "bump" ? 0.15 : 0.02
                                               : shape.name == "radius_m"        ? 0.4
                                               : shape.name == "direction_rad"   ? 1.3
                                               : shape.name == "length_m"        ? 0.6
                                               : shape.name == kSessionStart     ? -20.0
                                               : shape.name == "phase_rad"       ? 0.5
                                               : shape.name == "above_radps"     ? 3.0
                                               : shape.name == "time_constant_s" ? 0.1
                                                                                 : 4.8);
  }
  if (effect.name == "bump" && effect.component == "right_wheel")
    for (auto& [name, value] : active.parameters)
      if (name == "y_m") value = -0.15;
  if (effect.name == "bump" && effect.component == "both_wheels")  // a wheel comes up to 7 cm later: of the same phase
    for (auto& [name, value] : active.parameters)
      if (name == "at_s") value = 4.0;
  if (effect.name == "wheel_eccentricity") active.parameters = {{"amplitude", 0.02}, {"phase_rad", 0.5}};
  if (form > 0) active.parameters.emplace_back("form", form);
  return active;
}

struct Difference {
  double played_m, rest_m, played_rad,
      rest_rad;  // what the effect does, and what is left of it beside the fitted motion
};

std::optional<Difference> difference(const ActiveEffect& active, const Recording& recording, const Vehicle& vehicle) {
  FittedModel model{vehicle, {{active, {}, ""}}, {}, {}};
  const auto given = std::make_shared<const Recording>(recording);
  const Result<Replay> with = replay_with(model, vehicle, given);
  const Result<Track> fitted = predicted_track(recording, vehicle, {active});
  const Result<Track> without = predicted_track(recording, vehicle, {});
  if (!with || !fitted || !without) return std::nullopt;
  const auto rest = track_error(with->simulated, *fitted), played = track_error(*fitted, *without);
  if (!rest || !played) return std::nullopt;
  return Difference{played->position_rms_m, rest->position_rms_m, played->heading_rms_rad, rest->heading_rms_rad};
}

TEST(EffectsInForm, MoveTheVehicleAsTheyAreFitted) {
  const Recording recording = recorded_drive();
  Scenario scenario = table_drive(varied_drive(), {});
  std::get<DifferentialDrive>(scenario.vehicle.kind).encoder_counts_per_revolution = 200000.0;
  for (const Effect& effect : catalogue()) {
    if (effect.clock_rate || effect.of_the_truth || effect.only_commands) continue;
    for (int form = 0; form < std::max(1, static_cast<int>(effect.forms.size())); ++form) {
      const ActiveEffect active = found(effect, form);
      const auto d = difference(active, recording, scenario.vehicle);
      ASSERT_TRUE(d) << active.effect;
      // What is left is what the steps of 4 ms and a reversal that is sure a centimetre late make of it: a few per
      // cent. Wheels that are turned by toe push against each other on the spot; and where play ends the motor already
      // turns, at 1.6 m/s2 over 4 mm with 0.11 m/s: then they skid.
      const double share = effect.name == "drivetrain_backlash" ? 0.6 : effect.name == "wheel_toe" ? 0.25 : 0.12;
      const std::string which = active.effect + " of " + active.component + ", form " + std::to_string(form);
      EXPECT_LT(d->rest_m, share * d->played_m) << which;
      EXPECT_LT(d->rest_rad, share * d->played_rad + 5e-4) << which;
    }
  }
}

}  // namespace
}  // namespace odolab
