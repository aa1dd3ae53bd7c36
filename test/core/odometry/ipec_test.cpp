#include "core/odometry/ipec.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/kinematics/trucks.h"

namespace odolab {
namespace {

LinkedTrucks without_rounding() {
  LinkedTrucks vehicle;
  vehicle.link_angle_resolution_rad = 0.0;
  vehicle.link_length_resolution_m = 0.0;
  return vehicle;
}

IpecOptions plain(ResolutionRule rule = ResolutionRule::as_printed) {
  IpecOptions options;
  options.resolution = rule;
  options.composite = CompositeCorrection::none;
  return options;
}

// What the encoders of truck A's wheels read too much in an interval.
using Extra = std::function<WheelRotation(int interval)>;

struct LinkedDrive {
  std::vector<LinkedSample> samples;
  Pose true_a;
};

// Truck A on an arc from a heading, B steering after it and keeping the link's length, sampled every 40 ms.
LinkedDrive drive_linked(const LinkedTrucks& actual, double heading_rad, double speed_mps, double yaw_rate_radps,
                         double duration_s, const Extra& extra = {}) {
  LinkedKinematics vehicle(actual, {0.0, 0.0, heading_rad}, 0.0, 0.0, actual.link_length_m);
  LinkedDrive result;
  result.samples.push_back(vehicle.reading());
  const int intervals = static_cast<int>(duration_s / 0.04 + 0.5);
  for (int i = 0; i < intervals; ++i) {
    for (int k = 0; k < 20; ++k) {
      const double alpha = wrapped(vehicle.a().heading_rad - vehicle.link_heading_rad());
      const double beta = wrapped(vehicle.b().heading_rad - vehicle.link_heading_rad());
      const double speed_b_mps =
          (speed_mps * std::cos(alpha) + vehicle.link_length_m() - actual.link_length_m) / std::cos(beta);
      vehicle.move({speed_mps, yaw_rate_radps}, {speed_b_mps, -2.0 * beta}, 0.002);
    }
    if (extra) vehicle.add_idle_rotation(extra(i), {});
    result.samples.push_back(vehicle.reading());
  }
  result.true_a = vehicle.a();
  return result;
}

double heading_error_deg(const LinkedDrive& drive, const Pose& estimate) {
  return degrees(wrapped(estimate.heading_rad - drive.true_a.heading_rad));
}

// Both trucks at rest relative to each other in a straight train of 1 m; A's right wheel reports 6.8 mm more than its
// left: a turn of 20 mrad about b = 340 mm that never was, and 3.4 mm of travel.
TEST(Ipec, CorrectsAHandWorkedBump) {
  const LinkedTrucks vehicle = without_rounding();
  const LinkedSample before{0.0, {}, {}, 0.0, 0.0, 1.0};
  LinkedSample now = before;
  now.a.right_rad = 0.0068 / 0.075;
  const IpecTrucks trucks{vehicle.truck_a, vehicle.truck_b, 0.0, 0.0};
  const IpecState after = ipec_step(ipec_start(before, {}), before, now, trucks, plain());
  // Eq. 9 at the middle heading 0.01: A at (3.4 mm, 0.034 mm); Eq. 10: the link turned by 0.034 mm / 1.0034 m
  const double link_rad = std::atan2(0.0034 * std::sin(0.01), 1.0 + 0.0034 * std::cos(0.01));
  EXPECT_NEAR(after.correction_a_rad, 0.0 - (0.02 - link_rad), 1e-12);  // Eqs. 11a, 12a
  EXPECT_NEAR(after.a.heading_rad, link_rad, 1e-12);                    // Eq. 13a
  EXPECT_NEAR(after.b.x_m, after.a.x_m - std::cos(link_rad), 1e-12);    // Eq. 16

  IpecOptions composite = plain();
  composite.composite = CompositeCorrection::against_travel;
  // Eqs. 14, 15: A goes back by b sin(10 mrad) = 3.4 mm, all that the encoder had made up
  EXPECT_NEAR(ipec_step(ipec_start(before, {}), before, now, trucks, composite).a.x_m, 0.0,
              1e-5);              // the link's 34 urad, times b / 2
  now.a = {0.0068 / 0.075, 0.0};  // under the left wheel: the printed sign then doubles the error
  EXPECT_NEAR(ipec_step(ipec_start(before, {}), before, now, trucks, composite).a.x_m, 0.0, 1e-5);
  composite.composite = CompositeCorrection::as_printed;
  const double printed_left_m = ipec_step(ipec_start(before, {}), before, now, trucks, composite).a.x_m;
  now.a = {0.0, 0.0068 / 0.075};
  const double printed_right_m = ipec_step(ipec_start(before, {}), before, now, trucks, composite).a.x_m;
  EXPECT_NEAR(std::max(printed_left_m, printed_right_m), 0.0068, 1e-5);
  EXPECT_NEAR(std::min(printed_left_m, printed_right_m), 0.0, 1e-5);
}

TEST(Ipec, FollowsExactMotionToSecondOrderAtTheMiddleHeading) {
  const LinkedDrive turn = drive_linked(without_rounding(), 0.3, 0.45, 0.3, 10.0);
  const Pose middle = ipec(turn.samples, without_rounding(), {0.0, 0.0, 0.3}, plain()).back().a;
  IpecOptions printed = plain();
  printed.heading = HeadingRule::end_as_printed;
  const Pose end = ipec(turn.samples, without_rounding(), {0.0, 0.0, 0.3}, printed).back().a;
  // 4.5 m in which the middle heading is off by one part in 24 of (40 ms x 0.3 rad/s) squared, the end by half of 12
  // mrad
  EXPECT_LT(length(middle.position() - turn.true_a.position()), 0.002);
  EXPECT_GT(length(end.position() - turn.true_a.position()), 0.010);
  EXPECT_NEAR(heading_error_deg(turn, middle), 0.0, 0.05);
}

TEST(Ipec, TurnsThroughAllDirectionsAndThePlainArcTangentDoesNot) {
  const LinkedDrive turn = drive_linked(without_rounding(), 1.2, 0.45, 0.5, 12.0);  // by 6 rad, through the wrap at pi
  const Pose start{0.0, 0.0, 1.2};
  EXPECT_NEAR(heading_error_deg(turn, ipec(turn.samples, without_rounding(), start, plain()).back().a), 0.0, 0.1);
  IpecOptions printed = plain();
  printed.direction = LinkDirection::atan_as_printed;
  const std::vector<IpecState> states = ipec(turn.samples, without_rounding(), start, printed);
  double largest_deg = 0.0;
  for (std::size_t i = 1; i < states.size(); ++i)
    largest_deg = std::max(largest_deg, std::abs(degrees(states[i].correction_a_rad)));
  EXPECT_GT(largest_deg, 170.0);  // at 90 degrees the link seems to turn round
}

// Ten bumps of 3.5 mm (10 mm high, R = 75 mm) under A's right wheel on 18 m straight: 5.9 degrees by its own wheels.
TEST(Ipec, TakesOffTheTurnsThatBumpsMadeUp) {
  const Extra bumps = [](int interval) {  // every 1.8 m, over two intervals
    return interval % 100 / 2 == 25 ? WheelRotation{0.0, 0.5 * 0.0035 / 0.075} : WheelRotation{};
  };
  const LinkedTrucks vehicle = without_rounding();
  const LinkedDrive straight = drive_linked(vehicle, 0.0, 0.45, 0.0, 40.0, bumps);
  Pose alone;
  for (std::size_t i = 1; i < straight.samples.size(); ++i)
    alone = dead_reckoned(alone, straight.samples[i].a.left_rad - straight.samples[i - 1].a.left_rad,
                          straight.samples[i].a.right_rad - straight.samples[i - 1].a.right_rad, vehicle.truck_a);
  EXPECT_NEAR(heading_error_deg(straight, alone), 5.9, 0.05);
  // Each bump turns the link by what A seems to move sideways within the interval (section 3): at most 4.5 % here.
  const Pose corrected = ipec(straight.samples, vehicle, {}, plain()).back().a;
  EXPECT_LT(std::abs(heading_error_deg(straight, corrected)), 0.045 * 5.9);
  // The made-up distance is half of ten times 3.5 mm; the composite correction takes it off.
  IpecOptions composite = plain();
  composite.composite = CompositeCorrection::against_travel;
  EXPECT_NEAR(corrected.x_m - straight.true_a.x_m, 0.0175, 0.001);
  EXPECT_NEAR(ipec(straight.samples, vehicle, {}, composite).back().a.x_m - straight.true_a.x_m, 0.0, 0.002);
}

// Eq. 13 to the letter follows the rounding of both encoders; their difference turns the link on every metre.
TEST(Ipec, DoesNotFollowTheRoundingOfTheEncoders) {
  LinkedTrucks vehicle = without_rounding();
  LinkedDrive straight = drive_linked(vehicle, 0.0, 0.5, 0.0, 20.0);
  for (LinkedSample& s : straight.samples) {  // both really 0, in steps of 0.3 degrees
    s.link_angle_a_rad = radians(0.1);
    s.link_angle_b_rad = radians(-0.1);
  }
  for (LinkedSample* first = &straight.samples[0]; first; first = nullptr)
    first->link_angle_a_rad = first->link_angle_b_rad = 0.0;  // a true start
  vehicle.link_angle_resolution_rad = radians(0.3);
  const auto error_deg = [&](ResolutionRule rule) {
    return heading_error_deg(straight, ipec(straight.samples, vehicle, {}, plain(rule)).back().a);
  };
  // 0.2 degrees for each of 10 metres of a link of 1 m, less the first readings
  EXPECT_NEAR(std::abs(error_deg(ResolutionRule::as_printed)), 2.0, 0.15);
  EXPECT_NEAR(error_deg(ResolutionRule::dead_band), 0.0, 1e-9);
  EXPECT_NEAR(error_deg(ResolutionRule::least_correction), 0.0, 1e-9);
}

// The length acts on B's place in every interval of a turn: bias over length, times the turn.
TEST(Ipec, TurnsTooFarByTheLinkLengthsBias) {
  LinkedTrucks biased = without_rounding();
  biased.link_length_offset_m = 0.001;
  const LinkedDrive turn = drive_linked(biased, 0.0, 0.45, 2.0 * kPi / 60.0, 60.0);
  const Pose blind = ipec(turn.samples, without_rounding(), {}, plain()).back().a;
  EXPECT_NEAR(std::abs(heading_error_deg(turn, blind)), 0.36, 0.02);  // 1 mm / 1 m of 360 degrees
  const Pose told = ipec(turn.samples, biased, {}, plain()).back().a;
  EXPECT_NEAR(heading_error_deg(turn, told), 0.0, 0.02);
}

TEST(Ipec, CorrectsWheelbaseAndUnequalWheelsAndNotTheScale) {
  LinkedTrucks actual = without_rounding();
  actual.truck_a.wheelbase_m = 0.337;
  actual.truck_a.wheel_radius_left_m = 0.075 * 0.9985;
  const LinkedDrive turn = drive_linked(actual, 0.0, 0.45, 0.15, 40.0);  // 18 m, 344 degrees
  const Pose corrected = ipec(turn.samples, without_rounding(), {}, plain()).back().a;
  // left alone: 0.9 % of 344 degrees and 0.0015 / 0.34 m over 18 m, 3 and 4.5 degrees
  EXPECT_LT(std::abs(heading_error_deg(turn, corrected)), 0.2);

  actual = without_rounding();
  for (DifferentialDrive* truck : {&actual.truck_a, &actual.truck_b})
    truck->wheel_radius_left_m = truck->wheel_radius_right_m = 0.0757;  // 1 % larger
  const LinkedDrive straight = drive_linked(actual, 0.0, 0.5, 0.0, 20.0);
  EXPECT_NEAR(ipec(straight.samples, without_rounding(), {}, plain()).back().a.x_m, 10.0 * 0.075 / 0.0757, 1e-6);
}

// The report's simulation of the Smart Encoder Trailer: 337 mm for 340, ratio 0.9985, here on straights and arcs.
TEST(Ipec, WithATrailerAsTruckBKeepsTheHeading) {
  SmartEncoderTrailer nominal;
  nominal.hitch_angle_resolution_rad = radians(0.3);
  EncoderTrailer actual;
  actual.tow.wheelbase_m = 0.337;
  actual.tow.wheel_radius_left_m = 0.075 * 0.9985;
  actual.trailer = nominal.trailer;
  actual.hitch_offset_m = 0.0;
  actual.drawbar_length_m = nominal.drawbar_length_m;
  actual.hitch_angle_resolution_rad = nominal.hitch_angle_resolution_rad;
  double squares = 0.0, alone_deg = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    TrailerKinematics vehicle(actual, {}, 0.0);
    std::vector<TrailerSample> samples{rounded(vehicle.reading(), actual, seed)};
    Pose alone;
    for (int i = 0; i < 1000; ++i) {
      vehicle.move({0.3, i % 250 < 200 ? 0.0 : (i < 500 ? 0.5 : -0.5)}, 0.04);
      samples.push_back(rounded(vehicle.reading(), actual, seed));
      const WheelRotation &now = samples.back().tow, &before = samples[samples.size() - 2].tow;
      alone = dead_reckoned(alone, now.left_rad - before.left_rad, now.right_rad - before.right_rad, nominal.tow);
    }
    const double error_deg = degrees(ipec(samples, nominal, {}).back().a.heading_rad - vehicle.tow().heading_rad);
    squares += error_deg * error_deg / 8.0;
    alone_deg = std::abs(degrees(alone.heading_rad - vehicle.tow().heading_rad));
  }
  EXPECT_NEAR(alone_deg, 3.0, 0.2);  // 0.0015 / 0.34 m over 12 m; the wheelbase's errors cancel left and right
  // What is left is where the hitch stands within the encoder's step of 0.3 degrees, in each metre of a drawbar of 1 m;
  // the arcs tell it anew.
  EXPECT_LT(std::sqrt(squares), 1.0);
}

}  // namespace
}  // namespace odolab
