#include "physics/experiments/real/looked_for.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace odolab {
namespace {

constexpr double kLookedForRadius_m = 0.042, kLookedForBase_m = 0.2;

// A winding drive of 100 s whose left wheel is out of round by `amplitude`, by its own formulas: per interval of 50 ms
// each wheel rolls r dphi (1 + amplitude sin(phi + 1)). The truth scatters by 1 mm and 2 mrad.
Recording winding_drive(double amplitude, std::uint64_t seed) {
  Recording r;
  r.name = "run" + std::to_string(seed);
  for (const char* name : {"left_wheel_rad", "right_wheel_rad", "truth_x_m", "truth_y_m", "truth_heading_rad"})
    r.channels.push_back({name, {}});
  Random random(seed);
  double left = 0.0, right = 0.0;
  Pose pose;
  for (int i = 0; i <= 2000; ++i) {
    r.time_s.push_back(0.05 * i);
    const double x = pose.x_m + 0.001 * random.normal(), y = pose.y_m + 0.001 * random.normal();
    const double heading = pose.heading_rad + 0.002 * random.normal();
    const double row[] = {left, right, x, y, heading};
    for (std::size_t c = 0; c < 5; ++c) r.channels[c].values.push_back(row[c]);
    const double w = 0.6 * std::sin(0.1 * i * 0.05 * (1.0 + 0.3 * static_cast<double>(seed)));
    const double dl = (0.15 - 0.5 * kLookedForBase_m * w) * 0.05 / kLookedForRadius_m,
                 dr = (0.15 + 0.5 * kLookedForBase_m * w) * 0.05 / kLookedForRadius_m;
    const double l_m = kLookedForRadius_m * dl * (1.0 + amplitude * std::sin(left + 0.5 * dl + 1.0)),
                 r_m = kLookedForRadius_m * dr;
    left += dl;
    right += dr;
    const double turn = (r_m - l_m) / kLookedForBase_m, middle = pose.heading_rad + 0.5 * turn;
    pose = {pose.x_m + 0.5 * (l_m + r_m) * std::cos(middle), pose.y_m + 0.5 * (l_m + r_m) * std::sin(middle),
            pose.heading_rad + turn};
  }
  return r;
}

FittedModel model() {
  DifferentialDrive drive;
  drive.wheel_radius_left_m = drive.wheel_radius_right_m = kLookedForRadius_m;
  drive.wheelbase_m = kLookedForBase_m;
  FittedModel fitted;
  fitted.vehicle.kind = drive;
  return fitted;
}

TEST(LookedFor, ConfirmsAnEccentricityThatIsThere) {
  const auto found = looked_for("wheel_eccentricity", model(), {winding_drive(0.02, 1), winding_drive(0.02, 2)});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->runs, 2);
  EXPECT_GT(found->better_by, 5.0);  // by far more than the three that chance may reach
  // one wheel of two: 0.02 / sqrt(2), and what noise adds to either
  EXPECT_NEAR(found->size, 0.02 / std::sqrt(2.0), 0.002);
  EXPECT_LT(found->with.heading_rad, found->without.heading_rad);
}

TEST(LookedFor, ConfirmsNothingWhereNothingIs) {
  const std::vector<Recording> runs = {winding_drive(0.0, 1), winding_drive(0.0, 2)};
  for (const char* effect : {"wheel_eccentricity", "speed_dependent_radius", "floor_slope_creep"}) {
    const auto found = looked_for(effect, model(), runs);
    ASSERT_TRUE(found) << effect;
    EXPECT_LT(found->better_by, 3.0) << effect;
  }
}

TEST(LookedFor, SaysNothingOfARunThatIsTooShort) {
  Recording stub = winding_drive(0.02, 1);
  stub.time_s.resize(100);
  for (Channel& c : stub.channels) c.values.resize(100);
  EXPECT_FALSE(looked_for("speed_dependent_radius", model(), {stub}));
}

}  // namespace
}  // namespace odolab
