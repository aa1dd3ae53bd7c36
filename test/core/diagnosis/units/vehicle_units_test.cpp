#include "core/diagnosis/units/vehicle_units.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/crooked_vehicles.h"
#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

double angle_rad(double t) { return 0.1 + 0.3 * t + 0.8 * t * t; }

std::vector<UnitSample> samples_every(double period_s) {
  std::vector<UnitSample> samples;
  for (int i = 0; i <= 20; ++i)
    samples.push_back(
        {period_s * i, {{2.0 * angle_rad(period_s * i), 3.0 * angle_rad(period_s * i)}}, {angle_rad(period_s * i)}});
  return samples;
}

TEST(JointsAt, LieOnTheParabolaOfAnAngleThatIsReadSlowly) {
  for (const double at_s : {0.13, 0.75, 1.42})  // half way a straight line is off by 2 mrad
    EXPECT_NEAR(joints_at(samples_every(0.1), at_s)[0], angle_rad(at_s), 1e-12) << at_s;
}

TEST(JointsAt, AreReadAsTheyAreAtTheEndsAndBeyond) {
  const std::vector<UnitSample> samples = samples_every(0.1);
  EXPECT_EQ(joints_at(samples, -1.0)[0], angle_rad(0.0));
  EXPECT_EQ(joints_at(samples, 9.0)[0], samples.back().joints[0]);
}

// Wheels that both turn as t and t^2 go along one arc, whose length and turn the wheels say, however seldom they are
// read: both are the same function of time.
TEST(WayOf, IsTheArcOfWheelsThatSpeedUpTogether) {
  const DifferentialDrive drive;
  const std::vector<UnitSample> samples = samples_every(0.1);
  const Pose end = way_of(samples, 0, drive).back().pose;
  const double rad = angle_rad(2.0) - angle_rad(0.0), left_m = drive.wheel_radius_left_m * 2.0 * rad,
               right_m = drive.wheel_radius_right_m * 3.0 * rad, turn_rad = (right_m - left_m) / drive.wheelbase_m,
               radius_m = 0.5 * (left_m + right_m) / turn_rad;
  EXPECT_NEAR(end.x_m, radius_m * std::sin(turn_rad), 1e-9);
  EXPECT_NEAR(end.y_m, radius_m * (1.0 - std::cos(turn_rad)), 1e-9);
  EXPECT_NEAR(end.heading_rad, turn_rad, 1e-12);
}

TEST(VehicleUnits, StandWhereTheKinematicsPutThem) {
  const Clapper trucks = crooked_clapper();
  LinkedKinematics linked(trucks, {1.0, 2.0, 0.3}, 0.4, -0.2, 1.02);
  linked.move({0.3, 0.5}, {0.25, -0.2}, 2.0);
  const LinkedSample read = linked.reading();
  const Pose b = linked.a() * tracked_T_axle(vehicle_of(trucks), 1,
                                             {read.link_angle_a_rad, read.link_angle_b_rad, read.link_length_m});
  EXPECT_NEAR(length(b.position() - linked.b().position()), 0.0, 1e-12);
  EXPECT_NEAR(wrapped(b.heading_rad - linked.b().heading_rad), 0.0, 1e-12);

  // A castor's axle: its pivot goes with the body, and the axle rolls along itself.
  const MultiCastor platform = crooked_castors();
  CastorKinematics body(platform, {}, {0.1, 0.2, 0.3});
  const auto axle = [&] {
    std::vector<double> pivots;
    for (const CastorReading& c : body.reading().castors) pivots.push_back(c.pivot_rad);
    return body.body() * tracked_T_axle(vehicle_of(platform), 2, pivots);
  };
  const Pose before = axle();
  body.move({0.2, 0.1, 0.3, 0.001});
  const Pose moved = between(before, axle());
  EXPECT_GT(moved.x_m, 1e-5);
  EXPECT_NEAR(moved.y_m, 0.5 * moved.x_m * moved.heading_rad, 1e-9);  // the chord of an arc, and nothing sideways
}

TEST(UnitSamples, GoOnInTimeThoughAStampRepeatsTheOneBefore) {
  const Clapper trucks = fine_clapper();
  Recording read = linked_run(trucks, {}, 430);
  read.time_s.push_back(read.time_s.back());
  for (Channel& c : read.channels) c.values.push_back(c.values.back());
  const std::vector<UnitSample> samples = unit_samples(read, vehicle_of(trucks));
  ASSERT_GT(samples.size(), 2u);
  for (std::size_t i = 1; i < samples.size(); ++i) EXPECT_GT(samples[i].time_s, samples[i - 1].time_s);
}

}  // namespace
}  // namespace odolab::test
