#include "core/diagnosis/fitted_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/obeyed_commands.h"
#include "core/scenario/effect_catalogue.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

Diagnosis with_mounting_turned_by(double rad) {
  Diagnosis d;
  d.calibration.vehicle.kind = DifferentialDrive{};
  d.calibration.vehicle.truth.axle_T_tracked = {0.1, 0.0, rad};
  d.calibration.vehicle.truth.time_offset_s = 0.02;
  d.truth_clock_s = {{"one", 0.01}, {"two", 0.03}};
  return d;
}

Finding found_effect(const std::string& effect, const std::string& parameter, double value) {
  Finding f;
  f.effect = effect;
  f.component = "vehicle";
  f.parameters = {{parameter, value, 0.0, ""}};
  return f;
}

TEST(FittedModel, DoesNotTurnTheMountingForACrawlThatIsTheWheels) {
  // a mounting turned by -0.03 shows a straight as a crawl of 0.03 to the left
  Diagnosis d = with_mounting_turned_by(-0.03);
  d.findings = {found_effect("wheel_toe", "sideways_per_metre", 0.03)};
  const FittedModel model = model_of(d);
  EXPECT_NEAR(model.vehicle.truth.axle_T_tracked.heading_rad, 0.0, 1e-15);
  ASSERT_EQ(model.effects.size(), 1u);
  EXPECT_EQ(model.effects[0].active.effect, "wheel_toe");
}

TEST(FittedModel, KeepsEachRecordingsOwnClockWhereTheMeanIsAFindingToo) {
  Diagnosis d = with_mounting_turned_by(0.0);
  d.findings = {found_effect("truth_time_offset", "offset_s", 0.02)};
  const FittedModel model = model_of(d);
  EXPECT_TRUE(model.effects_in("two").empty());
  EXPECT_DOUBLE_EQ(model.vehicle_in("two").truth.time_offset_s, 0.03);
  ASSERT_EQ(model.effects_in("another").size(), 1u);  // one that was not fitted: the mean is the best guess
}

// Written twice, a command is obeyed once.
TEST(FittedModel, PredictsFromCommandsOfWhichOneIsWrittenTwice) {
  const auto end_of = [](bool twice) {
    Recording r;
    r.name = "told";
    std::vector<double> speed_mps, yaw_rate_radps;
    for (int i = 0; i < 100; ++i)
      for (int times = twice && i == 40 ? 2 : 1; times > 0; --times) {
        r.time_s.push_back(0.05 * i);
        speed_mps.push_back(i < 60 ? 0.4 : 0.1);
        yaw_rate_radps.push_back(0.2);
      }
    r.channels = {{"command_speed_mps", speed_mps}, {"command_yaw_rate_radps", yaw_rate_radps}};
    const Result<Track> track =
        predicted_track(r, Vehicle{}, {{"actuator_lag", "vehicle", {{"time_constant_s", 0.3}}}});
    EXPECT_TRUE(track);
    EXPECT_EQ(track->size(), r.time_s.size());
    return track->back().pose;
  };
  const Pose once = end_of(false), twice = end_of(true);
  EXPECT_NEAR(once.x_m, twice.x_m, 1e-9);
  EXPECT_NEAR(once.y_m, twice.y_m, 1e-9);
}

TEST(FittedModel, PredictsAPoseForEachReadingThoughOneIsWrittenTwice) {
  const auto predicted = [](bool twice) {
    Recording r;
    r.name = "read";
    std::vector<double> left_rad, right_rad;
    for (int i = 0; i < 100; ++i)
      for (int times = twice && i == 40 ? 2 : 1; times > 0; --times) {
        r.time_s.push_back(0.05 * i);
        left_rad.push_back(0.2 * i);
        right_rad.push_back(0.25 * i);
      }
    r.channels = {{"left_wheel_rad", left_rad}, {"right_wheel_rad", right_rad}};
    const Result<Track> track = predicted_track(r, Vehicle{}, {{"turn_scrub", "vehicle", {{"amount", 0.05}}}});
    EXPECT_TRUE(track);
    EXPECT_EQ(track->size(), r.time_s.size());
    return *track;
  };
  const Track once = predicted(false), twice = predicted(true);
  EXPECT_NEAR(once.back().pose.x_m, twice.back().pose.x_m, 1e-9);
  EXPECT_NEAR(once.back().pose.heading_rad, twice.back().pose.heading_rad, 1e-9);
  EXPECT_EQ(twice[41].pose.x_m, twice[40].pose.x_m);
}

// A base without encoders whose wheels are 3 and 2 % larger than its file says, on a base 4 % wider, and that follows a
// tenth of a second late: what is predicted from the model stays within the truth's noise over a minute.
TEST(FittedModel, PredictsFromCommandsAsTheyWereObeyed) {
  constexpr double kDelay_s = 0.1, kNoise_m = 0.001;
  Vehicle file;
  const DifferentialDrive drawn{0.05, 0.05, 0.3};
  file.kind = drawn;
  Random random(7);
  std::vector<Recording> recordings;
  for (int run = 0; run < 2; ++run) {
    test::GeneratorSettings g;
    g.drive = {0.0515, 0.051, 0.312};
    g.duration_s = 60.0;
    g.counts = false;
    g.truth.time_offset_s = kDelay_s;
    g.truth_position_noise_m = kNoise_m;
    g.truth_heading_noise_rad = 0.002;
    Recording r = generated(g, test::varied_driving(random, g.duration_s), random);
    const std::vector<WheelSample> wheels = wheel_samples(r, g.drive);
    for (Channel& c : r.channels)
      if (c.name.find("_wheel_rad") != std::string::npos) c.name = "of_" + c.name;  // an extra column, ignored
    std::vector<double> v(r.time_s.size(), std::nan("")), w = v;
    std::size_t k = 0;
    for (std::size_t i = 0; i < r.time_s.size() && k + 1 < wheels.size(); ++i) {
      if (r.time_s[i] != wheels[k].time_s) continue;
      const double dt = wheels[k + 1].time_s - wheels[k].time_s;
      const double left_mps = drawn.wheel_radius_left_m * (wheels[k + 1].left_rad - wheels[k].left_rad) / dt,
                   right_mps = drawn.wheel_radius_right_m * (wheels[k + 1].right_rad - wheels[k].right_rad) / dt;
      v[i] = 0.5 * (left_mps + right_mps);
      w[i] = (right_mps - left_mps) / drawn.wheelbase_m;
      ++k;
    }
    r.channels.push_back({"command_speed_mps", v});
    r.channels.push_back({"command_yaw_rate_radps", w});
    r.name = "run_" + std::to_string(run + 1);
    recordings.push_back(std::move(r));
  }
  const Diagnosis d = diagnose(recordings, {}, file).value();
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.findings.front().effect, "actuator_delay");
  const FittedModel model = model_of(d);
  for (const Recording& r : recordings) {
    const Vehicle vehicle = model.vehicle_in(r.name);
    const Track track =
        predicted_track(with_obeyed_commands(r, file, vehicle), vehicle, model.effects_in(r.name)).value();
    const auto error = track_error(track, truth_track(r));
    ASSERT_TRUE(error);
    // Both ends of a metre err by the truth's noise, the start's heading swings it about: 2.4 mm; drawn it is 30 mm
    // off.
    EXPECT_LT(error->position_rms_m, 0.003);
  }
}

// A finding that the simulator refuses would be left unconfirmed. A bump is the exception: what climbs more than a
// wheel does is one in the recording alone.
TEST(FittedModel, HasNoSizeThatCannotBeSwitchedOn) {
  for (const Effect& e : catalogue()) {
    const EffectEntry* entry = effect_entry(e.name);
    if (!entry || e.name == "bump") continue;
    for (const Effect::Amplitude& a : e.amplitudes)
      for (const EffectParameter& p : entry->parameters) {
        if (p.name != a.name) continue;
        EXPECT_LE(p.at_least, a.low) << e.name;
        EXPECT_GE(p.at_most, a.high) << e.name;
      }
  }
}

// Every simulated run is a recording.csv; and who copies one calls it as he likes.
TEST(FittedModel, KnowsARecordingByItsSamplesAndNotByItsName) {
  Recording fitted, other;
  fitted.name = other.name = "recording.csv";
  fitted.time_s = other.time_s = {0.0, 1.0};
  fitted.channels = {{"left_wheel_rad", {0.0, std::nan("")}}};
  other.channels = {{"left_wheel_rad", {0.0, 1.0}}};
  Diagnosis d = with_mounting_turned_by(0.0);
  d.truth_clock_s = {{"recording.csv", 0.01}};
  FittedModel model = model_of(d, {fitted});
  EXPECT_EQ(model.fitted_as(fitted), "recording.csv");
  EXPECT_EQ(model.fitted_as(other), std::nullopt);
  Recording copy = fitted;
  copy.name = "copy.csv";
  EXPECT_EQ(model.fitted_as(copy), "recording.csv");
  model.fingerprints.clear();
  EXPECT_EQ(model.fitted_as(other), "recording.csv");  // all that is known
  EXPECT_EQ(model.fitted_as(copy), std::nullopt);
}

}  // namespace
}  // namespace odolab
