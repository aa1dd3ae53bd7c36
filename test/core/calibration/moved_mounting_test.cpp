#include "core/calibration/moved_mounting.h"

#include <gtest/gtest.h>

#include "test/support/missing_physics.h"

namespace odolab {
namespace {

struct Set {
  std::vector<Recording> runs;
  Vehicle nominal;
};

// Four runs with the tracked point at `mounting`, in the third at `moved`.
Set four_runs(const Pose& mounting, const Pose& moved, const std::function<void(test::InjectedStep&)>& inject = {}) {
  Set set;
  Random random(17);
  for (int i = 0; i < 4; ++i) {
    test::GeneratorSettings g;
    g.drive.wheel_radius_left_m *= 1.01;
    g.drive.wheelbase_m *= 1.03;
    g.truth.axle_T_tracked = i == 2 ? moved : mounting;
    g.truth.time_offset_s = 0.02;
    g.truth_position_noise_m = 0.001;
    g.truth_heading_noise_rad = 0.001;
    g.wheel_noise = 0.001;
    g.duration_s = 40.0;
    g.inject = inject;
    set.runs.push_back(generated(g, test::varied_driving(random, g.duration_s), random));
    set.runs.back().name = "run_" + std::to_string(i + 1) + ".csv";
  }
  return set;
}

TEST(MovedMounting, FindsTheOneRunAndCarriesItsTruthBack) {
  const Pose mounting{0.03, -0.02, 0.01}, moved{0.09, -0.05, 0.07};
  const Set set = four_runs(mounting, moved);
  const PutRight right = mountings_put_right(set.runs, set.nominal);
  ASSERT_EQ(right.moved.size(), 1u);
  const MovedMounting& m = right.moved[0];
  EXPECT_EQ(m.recording, "run_3.csv");
  EXPECT_EQ(m.index, 2u);
  // Five of its own standard errors, which white noise of 1 mm on 800 samples makes about a tenth of a millimetre.
  EXPECT_NEAR(m.axle_T_tracked.x_m, moved.x_m, 5.0 * m.stderrs.x_m);
  EXPECT_NEAR(m.axle_T_tracked.y_m, moved.y_m, 5.0 * m.stderrs.y_m);
  EXPECT_NEAR(m.axle_T_tracked.heading_rad, moved.heading_rad, 5.0 * m.stderrs.heading_rad);
  EXPECT_LT(m.stderrs.x_m, 0.001);
  EXPECT_NE(m.sentence().find("60 mm further forward and 30 mm further right"), std::string::npos) << m.sentence();
  // What was put right has nothing more to find.
  EXPECT_TRUE(mountings_put_right(right.recordings, set.nominal).moved.empty());
}

TEST(MovedMounting, FindsHeadingsThatCountFromAnotherDirection) {
  const Set set = four_runs({0.03, 0.0, 0.0}, {0.03, 0.0, 0.5 * kPi});
  const PutRight right = mountings_put_right(set.runs, set.nominal);
  ASSERT_EQ(right.moved.size(), 1u);
  EXPECT_EQ(right.moved[0].recording, "run_3.csv");
  EXPECT_NEAR(right.moved[0].axle_T_tracked.heading_rad, 0.5 * kPi, 5.0 * right.moved[0].stderrs.heading_rad);
}

TEST(MovedMounting, IsNotFeignedByPhysicsOfOneRun) {
  for (const char* effect : {"lateral_slip", "floor_slope_creep", "collision", "slip_zone"}) {
    test::CaseSettings s;
    s.effect = effect;
    s.size = 3.0;
    s.runs = 3;
    s.duration_s = 30.0;
    const test::Case with = test::generated_case(s, 21);
    s.effect = "";
    test::Case c = test::generated_case(s, 21);
    c.recordings[0] = with.recordings[0];  // the same vehicle and ways, the effect in one run alone
    EXPECT_TRUE(mountings_put_right(c.recordings, c.nominal).moved.empty()) << effect;
  }
}

// A truth that was carried from a marker half a metre ahead to the axle, with the noise of its headings.
void carry_to_axle(Recording& recording, double marker_m) {
  std::vector<double>*x = nullptr, *y = nullptr, *heading = nullptr;
  for (Channel& c : recording.channels) {
    if (c.name == "truth_x_m") x = &c.values;
    if (c.name == "truth_y_m") y = &c.values;
    if (c.name == "truth_heading_rad") heading = &c.values;
  }
  for (std::size_t i = 0; i < x->size(); ++i) {
    (*x)[i] -= marker_m * std::cos((*heading)[i]);
    (*y)[i] -= marker_m * std::sin((*heading)[i]);
  }
}

// What sits further along a circle looks turned, so a run of nothing else tells neither from the other but by the noise
// of the truth, which is least where the marker is: it had said that the tracked point sat there, turned by 15 degrees.
TEST(MovedMounting, IsNotSaidOfARunOnACircle) {
  constexpr double kRadius_m = 1.6, kSpeed_mps = 0.29;
  test::GeneratorSettings g;
  g.drive.wheel_radius_left_m = g.drive.wheel_radius_right_m = 0.06;
  g.drive.wheelbase_m = 0.132;
  g.truth.axle_T_tracked.x_m = 0.45;
  g.truth_position_noise_m = 0.0003;
  g.truth_period_s = 0.033;
  g.wheel_period_s = 0.01;
  g.truth_heading_noise_rad = 0.002;
  g.wheel_noise = 0.00055;
  g.duration_s = 33.0;
  const auto around = [&](double time_s) {
    const double outer = 1.0 + 0.5 * g.drive.wheelbase_m / kRadius_m, speed = kSpeed_mps * std::min(1.0, time_s);
    return test::WheelSpeedsAt{outer * speed / g.drive.wheel_radius_left_m,
                               (2.0 - outer) * speed / g.drive.wheel_radius_right_m};
  };
  Vehicle nominal;
  nominal.kind = DifferentialDrive{
      .wheel_radius_left_m = 0.06 / 1.025, .wheel_radius_right_m = 0.06 / 1.025, .wheelbase_m = 0.132};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    std::vector<Recording> runs;
    for (int i = 0; i < 4; ++i)
      runs.push_back(
          generated(g, i == 2 ? test::SpeedProfile(around) : test::varied_driving(random, g.duration_s), random));
    for (Recording& run : runs) carry_to_axle(run, g.truth.axle_T_tracked.x_m);
    EXPECT_TRUE(mountings_put_right(runs, nominal).moved.empty()) << seed;
  }
}

TEST(MovedMounting, IsNotATruthThatJumpsOnTheWay) {
  Set set = four_runs({0.03, 0.0, 0.0}, {0.03, 0.0, 0.0});
  for (Channel& c : set.runs[1].channels)
    if (c.name == "truth_heading_rad")
      for (std::size_t i = c.values.size() / 2; i < c.values.size(); ++i) c.values[i] += 0.1;
  EXPECT_TRUE(mountings_put_right(set.runs, set.nominal).moved.empty());
}

}  // namespace
}  // namespace odolab
