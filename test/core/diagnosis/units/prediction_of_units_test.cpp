#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/odometry/prediction.h"

namespace odolab::test {
namespace {

constexpr double kReadingPeriod_s = 0.1;

// What goes evenly, a column for each, read ten times a second.
Recording going_evenly(const std::vector<std::pair<const char*, double>>& columns_by_reading, int readings) {
  Recording recording;
  for (int i = 0; i < readings; ++i) recording.time_s.push_back(kReadingPeriod_s * i);
  for (const auto& [name, by_reading] : columns_by_reading) {
    Channel& channel = recording.add_channel(name);
    for (std::size_t i = 0; i < recording.time_s.size(); ++i) channel.values[i] = by_reading * static_cast<double>(i);
  }
  return recording;
}

ActiveEffect none_on(const char* component) { return {"one_sided_drag", component, {{"rad_per_m", 0.0}}}; }

// Tracks that turn 1.6 rad/s: the chord of what they turn between readings is a thousandth shorter than the arc, and a
// model in which nothing acts had put them 0.9 mm aside after ten seconds.
TEST(PredictionOfUnits, DrivesTracksWithoutEffectsAsThePlainOneDoes) {
  Vehicle vehicle;
  vehicle.kind = Tracked{};
  const Recording recording = going_evenly({{"left_wheel_rad", 0.3}, {"right_wheel_rad", 1.1}}, 100);
  const Track plain = predicted_track(recording, vehicle).value(),
              with = predicted_track(recording, vehicle, {none_on("vehicle")}).value();
  ASSERT_EQ(with.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i)
    EXPECT_NEAR(length(with[i].pose.position() - plain[i].pose.position()), 0.0, 1e-9);
}

// The contract: a pose for each reading, though its stamp repeats the one before.
TEST(PredictionOfUnits, HasAPoseForEachReading) {
  Vehicle vehicle;
  vehicle.kind = Clapper{};
  Recording recording = going_evenly({{"a_left_wheel_rad", 0.1},
                                      {"a_right_wheel_rad", 0.1},
                                      {"b_left_wheel_rad", 0.1},
                                      {"b_right_wheel_rad", 0.1},
                                      {"link_angle_a_rad", 0.0},
                                      {"link_angle_b_rad", 0.0}},
                                     100);
  recording.add_channel("link_length_m").values.assign(recording.time_s.size(), 1.0);
  constexpr std::size_t kAgain = 50;
  recording.time_s[kAgain] = recording.time_s[kAgain - 1];
  for (Channel& channel : recording.channels) channel.values[kAgain] = channel.values[kAgain - 1];
  const Track plain = predicted_track(recording, vehicle).value(),
              with = predicted_track(recording, vehicle, {none_on("truck_a")}).value();
  ASSERT_EQ(with.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(with[i].time_s, plain[i].time_s);
    EXPECT_NEAR(with[i].pose.x_m, plain[i].pose.x_m, 1e-9);
  }
}

}  // namespace
}  // namespace odolab::test
