#include "core/calibration/carried_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/calibration/least_squares.h"
#include "core/diagnosis/diagnosis.h"
#include "core/odometry/differential_drive.h"
#include "test/support/known_drive.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr std::size_t kEvery = 12;

// As a map's localisation hands on its pose: every twelfth sample is measured, the others go on from it by the robot's
// own odometry, of a vehicle that is a little another one.
Recording carried_by_odometry(Recording r, const DifferentialDrive& drive, std::size_t every = kEvery) {
  const DifferentialDrive believed{1.02 * drive.wheel_radius_left_m, 1.015 * drive.wheel_radius_right_m,
                                   0.97 * drive.wheelbase_m};
  const Channel *left = r.channel("left_wheel_rad"), *right = r.channel("right_wheel_rad");
  std::vector<double> l = left->values, rt = right->values;
  fill_between(r.time_s, l), fill_between(r.time_s, rt);
  Channel* to[3] = {};
  for (Channel& c : r.channels)
    for (int k = 0; k < 3; ++k)
      if (c.name == std::array{"truth_x_m", "truth_y_m", "truth_heading_rad"}[static_cast<std::size_t>(k)]) to[k] = &c;
  Pose pose;
  std::size_t sample = 0, last = 0;
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    const bool known = std::isfinite(l[i]) && std::isfinite(rt[i]) && std::isfinite(l[last]);
    if (known) pose = dead_reckoned(pose, l[i] - l[last], rt[i] - rt[last], believed);
    last = i;
    if (std::isnan(to[0]->values[i])) continue;
    if (sample++ % every == 0 || !known)
      pose = {to[0]->values[i], to[1]->values[i], to[2]->values[i]};
    else
      to[0]->values[i] = pose.x_m, to[1]->values[i] = pose.y_m, to[2]->values[i] = wrapped(pose.heading_rad);
  }
  return r;
}

Case carried_case(const std::string& effect = "", double size = 0.0, bool without_noise = false) {
  CaseSettings c;
  c.effect = effect;
  c.size = size;
  c.runs = 3;
  c.duration_s = 60.0;
  c.without_noise = without_noise;
  return generated_case(c, 9107);
}

std::size_t count_of_truth(const Recording& r) { return truth_samples(r).size(); }

TEST(CarriedTruth, IsLeftToItsCorrections) {
  const Case c = carried_case();
  const Recording carried = carried_by_odometry(c.recordings[0], c.actual);
  const std::optional<MeasuredRecording> measured = without_carried_truth(carried);
  ASSERT_TRUE(measured);
  EXPECT_NEAR(static_cast<double>(count_of_truth(measured->recording)),
              static_cast<double>(count_of_truth(carried)) / kEvery, 3.0);
  // What is left was measured.
  const std::vector<TruthSample> all = truth_samples(c.recordings[0]), left = truth_samples(measured->recording);
  for (const TruthSample& s : left)
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const TruthSample& a) {
      return a.time_s == s.time_s && a.position.x_m == s.position.x_m;
    })) << s.time_s;
  EXPECT_NE(measured->said.find("92 %"), std::string::npos) << measured->said;  // eleven of twelve
  EXPECT_FALSE(without_carried_truth(measured->recording)) << "once is enough";
}

TEST(CarriedTruth, CalibratesAsItsCorrectionsByThemselves) {
  Case c = carried_case();
  std::vector<Recording> corrections_alone;
  for (Recording& r : c.recordings) {
    const Recording carried = carried_by_odometry(r, c.actual);
    for (Channel& channel : r.channels)
      for (std::size_t i = 0; i < r.time_s.size(); ++i)
        if (channel.name.rfind("truth_", 0) == 0 && channel.values[i] != carried.channel(channel.name)->values[i])
          channel.values[i] = std::nan("");
    corrections_alone.push_back(std::move(r));
    r = carried;
  }
  const Result<LeastSquaresCalibration> fit = calibrate_least_squares(c.recordings, c.nominal),
                                        alone = calibrate_least_squares(corrections_alone, c.nominal);
  ASSERT_TRUE(fit);
  ASSERT_TRUE(alone);
  expect_holds(*fit, c.actual);
  // A correction in a hundred goes sideways by too little to be seen, and without these an estimate moves by a tenth of
  // its standard error.
  for (std::size_t k = 0; k < fit->parameters.size(); ++k)
    EXPECT_NEAR(fit->parameters[k].value, alone->parameters[k].value, 0.3 * alone->parameters[k].stderr_value)
        << fit->parameters[k].name;
}

TEST(CarriedTruth, IsNoMissingPhysicsAndHidesNone) {
  Case sound = carried_case(), creeps = carried_case("floor_slope_creep", 3.0);
  for (Case* c : {&sound, &creeps})
    for (Recording& r : c->recordings) r = carried_by_odometry(std::move(r), c->actual);
  EXPECT_EQ(diagnose(sound.recordings, {}, sound.nominal)->verdict, Verdict::nothing_missing);
  const Result<Diagnosis> found = diagnose(creeps.recordings, {}, creeps.nominal);
  ASSERT_FALSE(found->findings.empty());
  EXPECT_EQ(found->findings.front().effect, "floor_slope_creep");
}

// Rounded to millimetres most steps sideways are the same few numbers; without noise they are next to nothing, but
// where an effect acts for longer than from one sample to the next.
TEST(CarriedTruth, IsNoneThatIsMeasuredHoweverWell) {
  for (const char* effect : {"", "slip_zone", "lateral_slip", "collision"})
    for (const bool without_noise : {false, true})
      for (const bool rounded : {false, true}) {
        Case c = carried_case(effect, 1.0, without_noise);
        for (Recording& r : c.recordings) {
          for (Channel& channel : r.channels)
            if (rounded && (channel.name == "truth_x_m" || channel.name == "truth_y_m"))
              for (double& v : channel.values) v = 1e-3 * std::round(1e3 * v);
          EXPECT_FALSE(without_carried_truth(r)) << effect << without_noise << rounded;
        }
      }
}

TEST(CarriedTruth, CannotBeToldWithoutHeadings) {
  const Case c = carried_case();
  Recording r = carried_by_odometry(c.recordings[0], c.actual);
  std::erase_if(r.channels, [](const Channel& channel) { return channel.name == "truth_heading_rad"; });
  EXPECT_FALSE(without_carried_truth(r));
}

TEST(ComputedTruth, IsSaidOfARobotsOwnOdometryAndOfNothingMeasured) {
  Case c = carried_case();
  EXPECT_FALSE(warning_of_computed_truth(c.recordings[0]));
  for (Recording& r : c.recordings) r = carried_by_odometry(std::move(r), c.actual, std::size_t{1} << 30);
  const Result<LeastSquaresCalibration> fit = calibrate_least_squares(c.recordings, c.nominal);
  ASSERT_TRUE(fit);
  EXPECT_EQ(std::count_if(fit->warnings.begin(), fit->warnings.end(),
                          [](const std::string& w) { return w.find("never errs sideways") != std::string::npos; }),
            std::ssize(c.recordings));
}

}  // namespace
}  // namespace odolab::test
