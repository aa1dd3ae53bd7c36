#include <gtest/gtest.h>

#include <map>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/fitted_model.h"
#include "core/geometry/track.h"
#include "core/odometry/prediction.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kEpoch_s = 1.7e9, kApart_s = 600.0;

// One after the other on one clock, that begins long before them.
void put_stamps_apart(std::vector<Recording>& recordings) {
  for (std::size_t r = 0; r < recordings.size(); ++r)
    for (double& t : recordings[r].time_s) t += kEpoch_s + kApart_s * static_cast<double>(r);
}

TEST(PayloadRadiusChange, IsKnownToTheRestThatItCameIn) {
  constexpr double kFrom_s = 18.0, kTo_s = 24.0, kLoaded_s = 19.0;
  Random random(51);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.01);
  g.duration_s = 45.0;
  const auto with_a_rest = [&](int) -> SpeedProfile {
    return [driving = varied_driving(random, g.duration_s)](double t) {
      return t > kFrom_s && t < kTo_s ? WheelSpeedsAt{} : driving(t);
    };
  };
  const auto loaded = [](int run) {
    return [run](InjectedStep& s) {
      if (run == 1 && s.time_s > kLoaded_s) s.left_m *= 0.994, s.right_m *= 0.997;
    };
  };
  const std::vector<Recording> recordings = three_runs(g, random, with_a_rest, loaded);
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].effect, "payload_radius_change");
  for (const FoundParameter& p : d.findings[0].parameters) {
    if (p.name != "at_s") continue;
    EXPECT_NEAR(p.value, 0.5 * (kFrom_s + kTo_s), 0.3);                     // any time of it is as likely
    EXPECT_NEAR(p.stderr_value, (kTo_s - kFrom_s) / std::sqrt(12.0), 0.3);  // that of an even distribution
  }
}

// Only one run lasts until then: what comes in every run from that time on is that run's own.
TEST(PayloadRadiusChange, IsOfTheOneRunThatLastsSoLong) {
  constexpr double kLoaded_s = 45.0;
  Random random(53);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.02);
  std::vector<Recording> recordings;
  for (const double lasts_s : {35.0, 70.0, 30.0}) {
    g.duration_s = lasts_s;
    g.inject = [](InjectedStep& s) {
      if (s.time_s > kLoaded_s) s.left_m *= 0.994, s.right_m *= 0.997;
    };
    recordings.push_back(generated(g, varied_driving(random, g.duration_s), random));
    recordings.back().name = "run_" + std::to_string(recordings.size());
  }
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].effect, "payload_radius_change");
  EXPECT_EQ(d.findings[0].where.recording, "run_2");
  ASSERT_EQ(d.findings[0].where.time_s.size(), 1u);
  EXPECT_NEAR(0.5 * (d.findings[0].where.time_s[0].first + d.findings[0].where.time_s[0].second), kLoaded_s, 0.5);
}

// A gripper that takes up its load half a minute into every run, whose stamps go on from run to run.
TEST(PayloadRadiusChange, ComesInEveryRunAsLongAfterItBeganWhereverItsStampsBegin) {
  constexpr double kLoaded_s = 20.0;
  Random random(52);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.02);
  g.duration_s = 45.0;
  const auto driving = [&](int) { return varied_driving(random, g.duration_s); };
  const auto loaded = [](int) {
    return [](InjectedStep& s) {
      if (s.time_s > kLoaded_s) s.left_m *= 0.994, s.right_m *= 0.997;
    };
  };
  std::vector<Recording> recordings = three_runs(g, random, driving, loaded);
  put_stamps_apart(recordings);
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].effect, "payload_radius_change");
  EXPECT_TRUE(d.findings[0].where.recording.empty());
  const std::map<std::string, double> truth = {{"left", -0.006}, {"right", -0.003}, {"at_s", kLoaded_s}};
  for (const FoundParameter& p : d.findings[0].parameters)
    EXPECT_NEAR(p.value, truth.at(p.name), 4.0 * p.stderr_value) << p.name;
  // And so in the track that the model predicts, of each run.
  const FittedModel model = model_of(d);
  for (const Recording& r : recordings) {
    const Vehicle vehicle = model.vehicle_in(r.name);
    const Track with = predicted_track(r, vehicle, model.effects_in(r.name)).value(),
                without = predicted_track(r, vehicle).value();
    const double started_s = r.time_s.front();
    const auto apart_m = [&](double at_s) {
      return length(pose_at(with, started_s + at_s)->position() - pose_at(without, started_s + at_s)->position());
    };
    EXPECT_EQ(apart_m(kLoaded_s - 2.0), 0.0) << r.name;
    EXPECT_GT(apart_m(40.0), 0.002) << r.name;
  }
}

// Put on in the second run and left there.
TEST(PayloadRadiusChange, LastsFromTheMomentInOneRunThroughThoseAfterItWhereverTheirStampsBegin) {
  constexpr double kLoaded_s = 20.0;
  Random random(54);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.02);
  g.duration_s = 45.0;
  const auto driving = [&](int) { return varied_driving(random, g.duration_s); };
  const auto loaded = [](int run) {
    return [run](InjectedStep& s) {
      if (run == 2 || (run == 1 && s.time_s > kLoaded_s)) s.left_m *= 0.994, s.right_m *= 0.997;
    };
  };
  std::vector<Recording> recordings = three_runs(g, random, driving, loaded);
  put_stamps_apart(recordings);
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].effect, "payload_radius_change");
  EXPECT_EQ(d.findings[0].where.recording, recordings[1].name);
  EXPECT_TRUE(d.findings[0].where.and_later_recordings);
  const std::map<std::string, double> truth = {
      {"left", -0.006}, {"right", -0.003}, {"at_s", kEpoch_s + kApart_s + kLoaded_s}};
  for (const FoundParameter& p : d.findings[0].parameters)
    EXPECT_NEAR(p.value, truth.at(p.name), 4.0 * p.stderr_value) << p.name;
}

}  // namespace
}  // namespace odolab::test
