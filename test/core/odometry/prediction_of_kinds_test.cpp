// predicted_track() finds the encoders of every kind of vehicle.
#include <gtest/gtest.h>

#include "core/kinematics/castors.h"
#include "core/kinematics/trucks.h"
#include "core/odometry/prediction.h"

namespace odolab {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// The truth only at the start, (1, 2) looking along y.
void add_truth(Recording& recording) {
  for (const auto& [name, value] :
       {std::pair<const char*, double>{"truth_x_m", 1.0}, {"truth_y_m", 2.0}, {"truth_heading_rad", 0.5 * kPi}}) {
    std::vector<double> values(recording.time_s.size(), kNoNumber);
    values.front() = value;
    recording.channels.push_back({name, values});
  }
}

void expect_one_metre_along_y(Recording recording, const VehicleKind& kind) {
  add_truth(recording);
  Vehicle vehicle;
  vehicle.kind = kind;
  const Result<Track> track = predicted_track(recording, vehicle);
  ASSERT_TRUE(track) << track.error().message();
  ASSERT_EQ(track->size(), recording.time_s.size()) << kind_name(vehicle);
  EXPECT_NEAR(track->back().pose.x_m, 1.0, 1e-9) << kind_name(vehicle);
  EXPECT_NEAR(track->back().pose.y_m, 3.0, 1e-9) << kind_name(vehicle);
}

TEST(Prediction, WorksForEveryKindOfVehicle) {
  Recording wheels;
  wheels.time_s = {0.0, 1.0};
  wheels.channels = {{"left_wheel_rad", {0.0, 10.0}}, {"right_wheel_rad", {0.0, 10.0}}};
  expect_one_metre_along_y(wheels, Tracked{});
  expect_one_metre_along_y(recording_of(std::vector<SynchroSample>{{0.0, 0.0, 0.0}, {1.0, 1.0 / 0.127, 0.0}}),
                           SynchroDrive{});
  LinkedKinematics linked(LinkedTrucks{}, {}, 0.0, 0.0, 1.0);
  std::vector<LinkedSample> linked_samples{linked.reading()};
  linked.move({1.0, 0.0}, {1.0, 0.0}, 1.0);
  linked_samples.push_back(linked.reading());
  expect_one_metre_along_y(recording_of(linked_samples), Clapper{});
  expect_one_metre_along_y(recording_of(linked_samples), OmniMate{});
  TrailerKinematics trailer(EncoderTrailer{}, {}, 0.0);
  std::vector<TrailerSample> trailer_samples{trailer.reading()};
  trailer.move({1.0, 0.0}, 1.0);
  trailer_samples.push_back(trailer.reading());
  expect_one_metre_along_y(recording_of(trailer_samples), EncoderTrailer{});
  expect_one_metre_along_y(recording_of(trailer_samples), SmartEncoderTrailer{});
  CastorKinematics castors(three_castor_vehicle(), {});
  std::vector<CastorSample> castor_samples{castors.reading()};
  castors.move({1.0, 0.0, 0.0, 1.0});
  castor_samples.push_back(castors.reading());
  expect_one_metre_along_y(recording_of(castor_samples), three_castor_vehicle());
}

TEST(Prediction, NamesTheEncodersThatAVehicleLacks) {
  Recording recording;
  recording.name = "run.csv";
  recording.time_s = {0.0};
  recording.channels = {{"link_angle_a_rad", {0.0}}, {"link_angle_b_rad", {0.0}}, {"link_length_m", {1.0}}};
  Vehicle vehicle;
  vehicle.kind = Clapper{};
  EXPECT_EQ(predicted_track(recording, vehicle).error().message(),
            "run.csv: found no a_left_wheel_rad, a_right_wheel_rad, b_left_wheel_rad, b_right_wheel_rad, expected the "
            "encoders of a clapper, or commands");
}

}  // namespace
}  // namespace odolab
