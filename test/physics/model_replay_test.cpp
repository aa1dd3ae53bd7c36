#include "physics/model_replay.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "physics/simulation.h"

namespace odolab {
namespace {

// A figure-eight of a robot whose left wheel is eccentric, as the planar world drives it.
Recording eccentric_eight() {
  Scenario scenario;
  scenario.path = FigureEightPath{0.8, 1};
  scenario.effects = {{"wheel_eccentricity", "left_wheel", {{"amplitude", 0.02}, {"phase_rad", 0.5}}}};
  Simulation simulation(scenario, 1);
  run_to_end(simulation);
  return simulation.recording();
}

TEST(ModelReplay, TheRightEffectMakesTheMismatchVanish) {
  const Recording recording = eccentric_eight();
  FittedModel model;
  model.effects = {{{"wheel_eccentricity", "left_wheel", {{"amplitude", 0.02}, {"phase_rad", 0.5}}}, {}, ""}};
  const Result<ModelReplay> replayed = replay_model({recording}, {}, {}, model, FitFigures{1e-4, 1e-4, 1.0});
  ASSERT_TRUE(replayed) << replayed.error().message();
  ASSERT_TRUE(replayed->fit.calibrated && replayed->fit.with_findings);
  // 2 % of a wheel's way, up to 0.075 m of radius and a phase to both sides: some 3 mm of way and 9 mrad of heading
  EXPECT_GT(replayed->fit.calibrated->heading_rms_rad, 2e-3);
  // a replay starts from encoder counts of 0.24 mm and goes evenly between samples
  EXPECT_LT(replayed->fit.with_findings->heading_rms_rad, 0.2 * replayed->fit.calibrated->heading_rms_rad);
  EXPECT_LT(replayed->fit.with_findings->normalised_chi2, 0.1 * replayed->fit.calibrated->normalised_chi2);
  EXPECT_TRUE(replayed->not_switched_on.empty());
}

TEST(ModelReplay, AnEventOfAnotherRecordingDoesNotActHere) {
  const Recording recording = eccentric_eight();
  FittedModel model;
  model.effects = {{{"collision", "vehicle", {{"at_s", 3.0}, {"dx_m", 0.1}}}, {}, "another.csv"}};
  const Result<ModelReplay> replayed = replay_model({recording}, {}, {}, model, std::nullopt);
  ASSERT_TRUE(replayed);
  EXPECT_EQ(replayed->fit.calibrated->position_rms_m, replayed->fit.with_findings->position_rms_m);
}

TEST(ModelReplay, StopsWhenTold) {
  EXPECT_FALSE(replay_model({eccentric_eight()}, {}, {}, {}, std::nullopt, [](double) { return false; }));
}

TEST(ModelReplay, IsNotHeldToTheWayThatAnEncoderDidNotTell) {
  Scenario scenario;
  scenario.path = FigureEightPath{0.8, 1};
  Simulation simulation(scenario, 1);
  run_to_end(simulation);
  Recording recording = simulation.recording();
  // In the second after that the left wheel counts 0.3 rad too little.
  constexpr double kAt_s = 10.0;
  for (Channel& c : recording.channels)
    if (c.name == "left_wheel_rad")
      for (std::size_t i = 0; i < c.values.size(); ++i)
        c.values[i] -= 0.3 * std::clamp(recording.time_s[i] - kAt_s, 0.0, 1.0);
  const FitFigures noise{1e-4, 1e-4, 1.0};
  const auto fit = [&](const WaysUnknown& unknown) {
    return replay_model({recording}, {}, {}, {}, noise, {}, unknown)->fit.calibrated->heading_rms_rad;
  };
  // 0.3 rad of a wheel of 0.075 m over an axle of 0.34 m, in one of some ten windows.
  EXPECT_GT(fit({}), 0.01);
  EXPECT_LT(fit({{recording.name, {{kAt_s, kAt_s + 1.0}}}}), 1e-3);  // half a count of each wheel
}

}  // namespace
}  // namespace odolab
