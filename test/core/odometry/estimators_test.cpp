#include "core/odometry/estimators.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/kinematics/castors.h"
#include "core/kinematics/trucks.h"
#include "core/odometry/cast_rejection.h"
#include "core/odometry/encoder_trailer.h"
#include "core/odometry/ipec.h"
#include "core/odometry/prediction.h"

namespace odolab {
namespace {

const Pose kStart{0.3, -0.2, 0.7};

std::vector<LinkedSample> linked_drive(const LinkedTrucks& vehicle) {
  LinkedKinematics drive(vehicle, kStart, 0.1, -0.2, 1.0);
  std::vector<LinkedSample> samples{rounded(drive.reading(), vehicle, 3)};
  for (int i = 0; i < 400; ++i) {
    drive.move({0.3, 0.8 * std::sin(0.03 * i)}, {0.3, 0.6 * std::cos(0.02 * i)}, 0.04);
    if (i % 70 == 0) drive.add_idle_rotation({0.03, 0.0}, {});
    samples.push_back(rounded(drive.reading(), vehicle, 3));
  }
  return samples;
}

std::vector<TrailerSample> trailer_drive(const EncoderTrailer& vehicle) {
  TrailerKinematics drive(vehicle, kStart, 0.3);
  std::vector<TrailerSample> samples{rounded(drive.reading(), vehicle, 5)};
  for (int i = 0; i < 400; ++i) {
    drive.move({i < 250 ? 0.3 : -0.3, 0.5 * std::sin(0.02 * i)}, 0.04);
    samples.push_back(rounded(drive.reading(), vehicle, 5));
  }
  return samples;
}

std::vector<CastorSample> castor_drive(const MultiCastor& vehicle) {
  CastorKinematics drive(vehicle, kStart);
  std::vector<CastorSample> samples{drive.reading()};
  for (int i = 0; i < 300; ++i) {
    drive.move({0.3 * std::cos(0.03 * i), 0.3 * std::sin(0.03 * i), 0.4, 0.05});
    if (i == 100) drive.add_idle_rotation(1, 0.4, 0.0);
    samples.push_back(drive.reading());
  }
  return samples;
}

const Estimator& estimator_named(const std::vector<Estimator>& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Estimator& e) { return e.name == name; });
  EXPECT_NE(found, list.end()) << name;
  return *found;
}

// Along all rows of a recording in which every channel was read.
Track run_along(const Estimator& estimator, const Recording& recording, const VehicleKind& kind) {
  const std::unique_ptr<RunningEstimator> running = estimator.begin(kStart);
  Track track;
  for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
    std::vector<double> readings;
    for (const std::string& name : encoder_channels(kind)) readings.push_back(recording.channel(name)->values[i]);
    running->take(recording.time_s[i], readings);
    track.push_back({recording.time_s[i], running->pose()});
  }
  return track;
}

void expect_same_track(const Track& running, const Track& whole, const std::string& name) {
  ASSERT_EQ(running.size(), whole.size()) << name;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    ASSERT_EQ(running[i].pose.x_m, whole[i].pose.x_m) << name << " at " << i;
    ASSERT_EQ(running[i].pose.y_m, whole[i].pose.y_m) << name << " at " << i;
    ASSERT_EQ(running[i].pose.heading_rad, whole[i].pose.heading_rad) << name << " at " << i;
  }
}

TEST(Estimators, OfLinkedTrucksEndWithTheBitsOfIpecOverTheWholeRecording) {
  Clapper vehicle;
  vehicle.link_angle_a_offset_rad = 0.01;
  vehicle.link_length_offset_m = 0.002;
  const std::vector<LinkedSample> samples = linked_drive(vehicle);
  const Recording recording = recording_of(samples);
  const std::vector<Estimator> list = estimators_for(vehicle);
  expect_same_track(run_along(list[0], recording, vehicle), track_of_truck_a(ipec(samples, vehicle, kStart)), "IPEC");
  IpecOptions without;
  without.composite = CompositeCorrection::none;
  expect_same_track(run_along(estimator_named(list, "no composite"), recording, vehicle),
                    track_of_truck_a(ipec(samples, vehicle, kStart, without)), "without");
}

TEST(Estimators, OfTwoTrucksAgreeWithTheirTruthWhereNothingIsRounded) {
  Clapper vehicle;
  vehicle.link_angle_b_offset_rad = 0.02;
  LinkedKinematics drive(vehicle, kStart, 0.1, -0.2, 1.0);
  std::vector<LinkedSample> samples{drive.reading()};
  for (int i = 0; i < 400; ++i) {
    drive.move({0.3, 0.3}, {0.28, -0.2}, 0.01);
    samples.push_back(drive.reading());
  }
  // The chord at the middle heading is off by turn^2 / 24 of each step: 3 mrad and 3 mm give 1e-9 m, 400 times over.
  for (const char* name : {"truck A alone", "truck B, link"}) {
    const Track track = run_along(estimator_named(estimators_for(vehicle), name), recording_of(samples), vehicle);
    EXPECT_NEAR(track.back().pose.x_m, drive.a().x_m, 1e-6) << name;
    EXPECT_NEAR(track.back().pose.y_m, drive.a().y_m, 1e-6) << name;
    EXPECT_NEAR(track.back().pose.heading_rad, drive.a().heading_rad, 1e-6) << name;
  }
}

TEST(Estimators, OfAnEncoderTrailerEndWhereThatOfTheWholeRecordingDoes) {
  EncoderTrailer vehicle;
  vehicle.tow = as_differential_drive(Tracked{});
  const std::vector<TrailerSample> samples = trailer_drive(vehicle);
  const Track running = run_along(estimators_for(vehicle)[0], recording_of(samples), vehicle);
  const Track whole = trailer_reckoned(samples, vehicle, kStart);
  ASSERT_EQ(running.size(), whole.size());
  for (std::size_t i = 0; i < whole.size();
       ++i)  // but for the last bits, since the hitch angle is unwrapped on the way
    ASSERT_LT(length(running[i].pose.position() - whole[i].pose.position()), 1e-12) << i;
}

TEST(Estimators, OfASmartTrailerEndWithTheBitsOfIpec) {
  SmartEncoderTrailer vehicle;
  EncoderTrailer alike{vehicle.tow, vehicle.trailer, 0.0, vehicle.drawbar_length_m};
  const std::vector<TrailerSample> samples = trailer_drive(alike);
  expect_same_track(run_along(estimators_for(vehicle)[0], recording_of(samples), vehicle),
                    track_of_truck_a(ipec(samples, vehicle, kStart)), "IPEC");
}

TEST(Estimators, OfCastorsEndWithTheBitsOfCastLeftOutOrDisregardedOrNot) {
  const MultiCastor vehicle = three_castor_vehicle();
  const std::vector<CastorSample> samples = castor_drive(vehicle);
  const Recording recording = recording_of(samples);
  const std::vector<Estimator> list = estimators_for(vehicle);
  ASSERT_EQ(list.size(), 8u);  // CAST-0, disregarding, CAST-1 to -3, IPEC-1 to -3
  expect_same_track(run_along(list[0], recording, vehicle), castor_track(samples, vehicle, kStart), "CAST-0");
  CastOptions second;
  second.left_out = 2;
  expect_same_track(run_along(estimator_named(list, "CAST-2"), recording, vehicle),
                    castor_track(samples, vehicle, kStart, second), "CAST-2");
  second.method = CastorMethod::ipec;
  expect_same_track(run_along(estimator_named(list, "IPEC-2"), recording, vehicle),
                    castor_track(samples, vehicle, kStart, second), "IPEC-2");
  const RejectingTrack rejecting = castor_track_with_rejection(samples, vehicle, kStart);
  expect_same_track(run_along(estimator_named(list, "CAST-reject"), recording, vehicle), rejecting.track,
                    "disregarding");
  EXPECT_FALSE(rejecting.disregarded.empty());  // the wheel that turned on the spot
}

TEST(Estimators, OfEveryKindBeginWithTheOneThatPredicts) {
  const MultiCastor castors = three_castor_vehicle();
  Vehicle vehicle;
  vehicle.kind = castors;
  const Recording recording = recording_of(castor_drive(castors));
  const Result<Track> predicted = predicted_track(recording, vehicle);
  ASSERT_TRUE(predicted);
  const Track running = run_along(estimators_for(castors)[0], recording, castors);
  // The same from the origin instead of from the start.
  EXPECT_NEAR(length(running.back().pose.position() - (kStart * predicted->back().pose).position()), 0.0, 1e-9);
}

}  // namespace
}  // namespace odolab
