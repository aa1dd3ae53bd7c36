#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/calibration/least_squares.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// Sides of a metre and turns of a quarter, each ended by a stop of 0.6 s, at ramps of a quarter second.
SpeedProfile squares(const DifferentialDrive& drive, double speed_mps, double yaw_rate_radps) {
  struct Leg {
    double lasts_s, left_radps, right_radps;
  };
  constexpr double kRamp_s = 0.25, kStop_s = 0.6;
  const double r = drive.wheel_radius_left_m, rim_mps = 0.5 * drive.wheelbase_m * yaw_rate_radps;
  const Leg side{1.0 / speed_mps, speed_mps / r, speed_mps / r},
      turn{0.5 * kPi / yaw_rate_radps, -rim_mps / r, rim_mps / r};
  return [=](double t) {
    const double both_s = side.lasts_s + turn.lasts_s + 2.0 * (kRamp_s + kStop_s);
    double in_s = std::fmod(std::max(0.0, t - 1.0), both_s);
    const bool turns = in_s > side.lasts_s + kRamp_s + kStop_s;
    const Leg& leg = turns ? turn : side;
    if (turns) in_s -= side.lasts_s + kRamp_s + kStop_s;
    const double share = std::clamp(std::min(in_s, leg.lasts_s + kRamp_s - in_s) / kRamp_s, 0.0, 1.0);
    return WheelSpeedsAt{share * leg.left_radps, share * leg.right_radps};
  };
}

TEST(FewCountsATurn, AWheelThatTurnsInPlaceByFourCountsTellsTheWheelbase) {
  DifferentialDrive drive;
  drive.wheel_radius_left_m = drive.wheel_radius_right_m = 0.0435;
  drive.wheelbase_m = 0.1195;
  drive.encoder_counts_per_revolution = 20.0;  // a slotted disc: 13.7 mm to a count, and a turn's wheels go 94 mm
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Random random(seed);
    GeneratorSettings g = under_motion_capture(drive, 0.0006, 0.01);
    g.duration_s = 80.0;
    g.wheel_period_s = 0.01;
    const double yaw_rate_radps = random.uniform(0.5, 0.9);  // three to five counts a second
    const std::vector<Recording> recordings = three_runs(
        g, random, [&](int) { return squares(drive, 0.25, yaw_rate_radps); },
        [](int) { return std::function<void(InjectedStep&)>(); });
    Vehicle vehicle;
    vehicle.kind = drive;
    const Result<LeastSquaresCalibration> found = calibrate_least_squares(recordings, vehicle);
    ASSERT_TRUE(found) << found.error().message();
    // Of some forty turns each hides a count of each wheel at either end at most, evenly spread: 2 % of a turn's way.
    EXPECT_NEAR(std::get<DifferentialDrive>(found->vehicle.kind).wheelbase_m, drive.wheelbase_m,
                0.03 * drive.wheelbase_m)
        << seed;
  }
}

// 20 mm to a count, which a tracker looks at several times before the next.
TEST(FewCountsATurn, AreSaidInMillimetresOfFloorAndTheTruthIsNotBlamedAlone) {
  DifferentialDrive drive;
  drive.wheel_radius_left_m = drive.wheel_radius_right_m = 0.0625;
  drive.wheelbase_m = 0.42;
  const auto warnings = [&](double counts_per_turn) {
    drive.encoder_counts_per_revolution = counts_per_turn;
    Random random(5);
    GeneratorSettings g = under_motion_capture(drive, 0.0006, 0.01);
    g.duration_s = 60.0;
    const std::vector<Recording> recordings = three_runs(
        g, random, [&](int) { return varied_driving(random, g.duration_s); },
        [](int) { return std::function<void(InjectedStep&)>(); });
    Vehicle vehicle;
    vehicle.kind = drive;
    const Result<LeastSquaresCalibration> found = calibrate_least_squares(recordings, vehicle);
    std::string all;
    for (const std::string& w : found ? found->warnings : std::vector<std::string>{"none"}) all += w + "\n";
    return all;
  };
  const std::string coarse = warnings(20.0), fine = warnings(2000.0);
  EXPECT_NE(coarse.find("one count of the encoders is 20 mm on the floor"), std::string::npos) << coarse;
  EXPECT_EQ(coarse.find("the truth's noise lasts"), std::string::npos) << coarse;
  EXPECT_NE(coarse.find("as where whole counts hide where a wheel is"), std::string::npos) << coarse;
  EXPECT_EQ(fine.find("one count of the encoders"), std::string::npos) << fine;
}

// Each reading is a count too long or too short, of two or three: a noise that went by what is read would believe those
// that are short, and radii came out 2e-3 too large.
TEST(FewCountsATurn, RadiiAreNotLargerWhereReadingsAreTwoCountsLong) {
  DifferentialDrive drive;
  drive.wheel_radius_left_m = drive.wheel_radius_right_m = 0.0856;
  drive.wheelbase_m = 0.28;
  drive.encoder_counts_per_revolution = 128.0;
  double off = 0.0;
  constexpr int kSets = 4;
  for (std::uint64_t seed = 1; seed <= kSets; ++seed) {
    Random random(seed);
    GeneratorSettings g = under_motion_capture(drive, 0.0018, 1.0 / 75.0);
    g.duration_s = 120.0;
    g.wheel_period_s = 0.02;
    const std::vector<Recording> recordings = three_runs(
        g, random, [&](int) { return squares(drive, random.uniform(0.42, 0.5), 1.0); },
        [](int) { return std::function<void(InjectedStep&)>(); });
    Vehicle vehicle;
    vehicle.kind = drive;
    const Result<LeastSquaresCalibration> found = calibrate_least_squares(recordings, vehicle);
    ASSERT_TRUE(found) << found.error().message();
    const auto& by = std::get<DifferentialDrive>(found->vehicle.kind);
    off += 0.5 * (by.wheel_radius_left_m + by.wheel_radius_right_m) / drive.wheel_radius_left_m - 1.0;
  }
  // Of some 75 sides of a metre in a set each hides a count at either end, 4.2 mm of a metre evenly spread.
  EXPECT_NEAR(off / kSets, 0.0, 3.0 * 0.0042 / std::sqrt(6.0 * 75.0 * kSets));
}

}  // namespace
}  // namespace odolab::test
