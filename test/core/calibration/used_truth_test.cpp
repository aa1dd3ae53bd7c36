#include "core/calibration/used_truth.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/odometry/prediction.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

Vehicle drawn_drive() {
  Vehicle v;
  v.kind = DifferentialDrive{0.1, 0.1, 0.45};
  return v;
}

Recording minute() {
  test::GeneratorSettings g = test::under_motion_capture({0.0996, 0.1003, 0.4565}, 0.0005, 0.05);
  g.duration_s = 60.0;
  Random random(8);
  return generated(g, test::varied_driving(random, g.duration_s), random);
}

// Changes the truth in each row that has one; `change` is given the number of the sample and its three cells.
template <typename Change>
void change_truth(Recording& r, const Change& change) {
  std::vector<double>*x = nullptr, *y = nullptr, *heading = nullptr;
  for (Channel& c : r.channels) {
    if (c.name == "truth_x_m") x = &c.values;
    if (c.name == "truth_y_m") y = &c.values;
    if (c.name == "truth_heading_rad") heading = &c.values;
  }
  int sample = 0;
  for (std::size_t i = 0; i < r.time_s.size(); ++i)
    if (!std::isnan((*x)[i])) change(sample++, (*x)[i], (*y)[i], (*heading)[i]);
}

UsedTruth used_by_its_calibration(const Recording& r) {
  const auto found = calibrate_least_squares({r}, drawn_drive());
  return used_truth(r, found.value(), 0, {});
}

double error_m(const Recording& r, const UsedTruth& truth) {
  const auto found = calibrate_least_squares({r}, drawn_drive());
  return track_error(predicted_track(r, found->vehicle).value(), truth.track, truth.anew)->position_rms_m;
}

TEST(UsedTruth, IsAllOfItWhereNothingIsWrong) {
  const Recording r = minute();
  const UsedTruth used = used_by_its_calibration(r);
  EXPECT_EQ(used.track.size(), truth_track(r).size());
  EXPECT_EQ(std::count(used.anew.begin(), used.anew.end(), 0), static_cast<long>(used.track.size()));
}

// A tracker that says "at the origin" where it sees nothing.
TEST(UsedTruth, HasNoSamplesThatContradictTheirNeighbours) {
  Recording r = minute();
  int wrong = 0;
  change_truth(r, [&](int sample, double& x, double& y, double& heading) {
    if (sample % 40 != 39) return;
    x = y = 20.0, heading = 3.0;
    ++wrong;
  });
  const UsedTruth used = used_by_its_calibration(r);
  EXPECT_EQ(used.track.size() + static_cast<std::size_t>(wrong), truth_track(r).size());
  EXPECT_TRUE(
      std::none_of(used.track.begin(), used.track.end(), [](const TimedPose& p) { return p.pose.x_m == 20.0; }));
  EXPECT_LT(error_m(r, used), 0.01);  // of the truth's noise and slip, some millimetres in a metre
}

TEST(UsedTruth, HasNoSamplesThatRepeatThemselves) {
  Recording r = minute();
  double held[3] = {};
  change_truth(r, [&](int sample, double& x, double& y, double& heading) {
    if (sample % 300 < 200 || sample % 300 >= 210)
      held[0] = x, held[1] = y, held[2] = heading;
    else
      x = held[0], y = held[1], heading = held[2];
  });
  const UsedTruth used = used_by_its_calibration(r);
  EXPECT_LE(used.track.size() + 3 * 10, truth_track(r).size());
  EXPECT_LT(error_m(r, used), 0.01);
}

TEST(UsedTruth, BeginsAnewWhereItsFrameWasMoved) {
  Recording r = minute();
  change_truth(r, [](int sample, double& x, double&, double&) {
    if (sample >= 600) x += 1.0;
  });
  const UsedTruth used = used_by_its_calibration(r);
  EXPECT_EQ(std::count(used.anew.begin(), used.anew.end(), 1), 1);
  EXPECT_LT(error_m(r, used), 0.01);
}

}  // namespace
}  // namespace odolab
