#include "core/recording/vehicle_samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace odolab {
namespace {

constexpr double kNotSampled = std::numeric_limits<double>::quiet_NaN();

TEST(VehicleSamples, BringChannelsOfDifferentTimesTogether) {
  Recording r;
  r.time_s = {0.0, 1.0, 2.0, 3.0};
  for (const char* name : {"left_wheel_rad", "right_wheel_rad", "trailer_left_wheel_rad", "trailer_right_wheel_rad"})
    r.channels.push_back({name, {0.0, kNotSampled, 2.0, kNotSampled}});
  // read at other times than the wheels, and wrapping from +3.1 to -3.1
  r.channels.push_back({"hitch_angle_rad", {3.0, 3.1, kNotSampled, -3.1}});
  const std::vector<TrailerSample> samples = trailer_samples(r);
  ASSERT_EQ(samples.size(), 3u);  // the wheels end at 2 s
  EXPECT_DOUBLE_EQ(samples[1].tow.left_rad, 1.0);
  EXPECT_NEAR(samples[2].hitch_angle_rad, 0.5 * (3.1 + 2.0 * kPi - 3.1), 1e-12);  // halfway, the shorter way round
}

TEST(VehicleSamples, ReadOneTripleForEachCastor) {
  Recording r;
  r.time_s = {0.0};
  double value = 1.0;
  for (const char* castor : {"castor1", "castor2"})
    for (const char* what : {"_left_wheel_rad", "_right_wheel_rad", "_pivot_rad"})
      r.channels.push_back({std::string(castor) + what, {value++}});
  const std::vector<CastorSample> samples = castor_samples(r, 2);
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples[0].castors[1].wheels.left_rad, 4.0);
  EXPECT_EQ(samples[0].castors[1].pivot_rad, 6.0);
  EXPECT_TRUE(castor_samples(r, 3).empty());
}

TEST(VehicleSamples, SayWhichColumnsAreMissing) {
  Recording r;
  r.time_s = {0.0};
  for (const char* name :
       {"a_left_wheel_rad", "a_right_wheel_rad", "b_left_wheel_rad", "b_right_wheel_rad", "link_angle_a_rad"})
    r.channels.push_back({name, {0.0}});
  Vehicle vehicle;
  vehicle.kind = Clapper{};
  EXPECT_EQ(missing_columns(r, vehicle), "link_angle_b_rad, link_length_m");
  vehicle.kind = SynchroDrive{};
  EXPECT_EQ(missing_columns(r, vehicle), "drive_wheel_rad, steering_rad");
}

}  // namespace
}  // namespace odolab
