#include "physics/planar_world.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

constexpr double kGrip_n = 150.0;

// A truck on two wheels, 340 mm apart, which roll at the given speeds.
struct LoneTruck {
  PlanarWorld world;
  int body, left, right;

  LoneTruck(double step_s, Pose start) : world(step_s), body(world.add_body({start, 50.0, 3.0})) {
    left = world.add_tread(body, {0.0, 0.17});
    right = world.add_tread(body, {0.0, -0.17});
  }
  void roll(double left_mps, double right_mps) {
    world.set_tread(left, {left_mps, 0.0}, kGrip_n);
    world.set_tread(right, {right_mps, 0.0}, kGrip_n);
    world.step();
  }
};

// The wheels' speed at the middle of step k of a drive that ramps up in 1 s.
double ramped(double speed_mps, double time_s) { return speed_mps * std::min(1.0, time_s); }

TEST(PlanarWorld, KeepsToTheClosedFormOnAnArcHundredMetresAway) {
  for (const double away_m : {0.0, 100.0}) {
    const double h = 0.001;
    LoneTruck truck(h, {away_m, -away_m, 0.3});
    double travel_m = 0.0;
    for (int k = 0; k < 200000; ++k) {
      const double v = ramped(0.3, (k + 0.5) * h);
      truck.roll(v * (1.0 - 0.17 / 1.5), v * (1.0 + 0.17 / 1.5));
      travel_m += v * h;
    }
    const double turn_rad = travel_m / 1.5;  // a circle of 1.5 m radius
    const Pose start{away_m, -away_m, 0.3};
    const Vec2 end = start * Vec2{1.5 * std::sin(turn_rad), 1.5 * (1.0 - std::cos(turn_rad))};
    // 60 m of arc; the project's bar is 0.05 mm over 16 m.
    EXPECT_NEAR(length(truck.world.pose(truck.body).position() - end), 0.0, 0.05e-3) << "at " << away_m << " m";
    EXPECT_NEAR(truck.world.pose(truck.body).heading_rad, 0.3 + turn_rad, 1e-6);
  }
}

TEST(PlanarWorld, LinkOfTwoTrucksShortensByTheDifferenceOfTheirTravel) {
  for (const double h : {0.001, 0.005}) {
    PlanarWorld world(h);
    const int front = world.add_body({{0.0, 0.0, 0.0}, 30.0, 2.0});
    const int rear = world.add_body({{-1.0, 0.0, 0.0}, 30.0, 2.0});
    std::vector<int> treads;
    for (const int body : {front, rear})
      for (const double side : {0.17, -0.17}) treads.push_back(world.add_tread(body, {0.0, side}));
    world.add_spring({front, rear, {0.0, 0.0}, {0.0, 0.0}, 1.0, 2.0, 0.7});
    double front_m = 0.0;
    for (int k = 0; front_m < 4.0 - 1e-9; ++k) {
      const double v = std::min(ramped(0.3, (k + 0.5) * h), (4.0 - front_m) / h);
      front_m += v * h;
      for (std::size_t i = 0; i < 4; ++i) world.set_tread(treads[i], {i < 2 ? v : 1.01 * v, 0.0}, kGrip_n);
      world.step();
    }
    const double link_m = length(world.pose(front).position() - world.pose(rear).position());
    // 1 % of 4 m; the bar is 0.2 mm.
    EXPECT_NEAR(1.0 - link_m, 0.040, 0.2e-3) << "at a step of " << h << " s";
    RecordProperty("shortening_mm", std::to_string(1e3 * (1.0 - link_m)));
  }
}

TEST(PlanarWorld, ABodyWithoutGripKeepsItsVelocityWhileItSpins) {
  const double h = 0.001;
  PlanarWorld world(h);
  const int body = world.add_body({{0.0, 0.0, 0.0}, 10.0, 0.5});
  world.apply_force(body, {10.0 / h, 0.0}, 0.5 * 3.0 / h);  // 1 m/s and 3 rad/s at once
  world.step();
  for (int k = 1; k < 5000; ++k) world.step();
  EXPECT_NEAR(world.velocity_mps(body).x_m, 1.0, 1e-6);
  EXPECT_NEAR(world.velocity_mps(body).y_m, 0.0, 1e-6);
  EXPECT_NEAR(world.pose(body).heading_rad, 15.0, 1e-5);
  EXPECT_NEAR(world.pose(body).x_m, 5.0, 1e-5);
  EXPECT_NEAR(world.pose(body).y_m, 0.0,
              2e-3);  // the one step in which the spin begins bends the way by up to h/2 of it
}

TEST(PlanarWorld, CurvesNeedTheCentripetalForce) {
  const double h = 0.001, speed = 0.5, radius = 1.0;
  LoneTruck truck(h, {});
  for (int k = 0; k < 4000; ++k) {
    const double v = ramped(speed, (k + 0.5) * h);
    truck.roll(v * (1.0 - 0.17 / radius), v * (1.0 + 0.17 / radius));
  }
  const double sideways_n = truck.world.tread_force_n(truck.left).y_m + truck.world.tread_force_n(truck.right).y_m;
  EXPECT_NEAR(sideways_n, 50.0 * speed * speed / radius, 0.01);  // m v^2 / R = 12.5 N
}

TEST(PlanarWorld, ASlidingTruckIsBrakedByCoulombFriction) {
  const double h = 0.001;
  LoneTruck truck(h, {});
  truck.world.apply_force(truck.body, {50.0 * 2.0 / h, 0.0});  // 2 m/s at once, wheels blocked
  int steps = 0;
  do {
    truck.roll(0.0, 0.0);
    ++steps;
  } while (truck.world.velocity_mps(truck.body).x_m > 1e-6 && steps < 100000);
  const double deceleration = 2.0 * kGrip_n / 50.0;
  EXPECT_NEAR(steps * h, 2.0 / deceleration, 2.0 * h);
  EXPECT_NEAR(truck.world.pose(truck.body).x_m, 2.0 * 2.0 / (2.0 * deceleration),
              2.0 * h);  // v^2 / 2a, a step's travel
}

// Whatever the body's inertia about its wheels, friction acts against the slip and nowhere else.
TEST(PlanarWorld, AThrownTruckWithLockedWheelsSlidesStraightAndStopsWhereItsGripSays) {
  constexpr double kGrip_n = 60.0, kMass_kg = 50.0, kSpeed_mps = 1.0;
  for (const double step_s : {0.005, 0.001}) {
    PlanarWorld world(step_s);
    const int truck = world.add_body({{0.0, 0.0, 0.3}, kMass_kg, 3.0});
    const int left = world.add_tread(truck, {0.0, 0.17}), right = world.add_tread(truck, {0.0, -0.17});
    const Vec2 direction{std::cos(1.0), std::sin(1.0)};  // 40 degrees off its heading
    world.set_velocity(truck, kSpeed_mps * direction, 0.0);
    for (int k = 0; k < static_cast<int>(1.0 / step_s); ++k) {
      world.set_tread(left, {}, kGrip_n);
      world.set_tread(right, {}, kGrip_n);
      world.step();
    }
    const double way_m = kSpeed_mps * kSpeed_mps * kMass_kg / (2.0 * 2.0 * kGrip_n);  // v^2 / (2 a): 208 mm
    const Vec2 end = world.pose(truck).position();
    // It stops within a step, in which it has a h / 2 at most on average for h: 15 um at 5 ms.
    EXPECT_NEAR(dot(end, direction), way_m, 2.4 * step_s * step_s);
    EXPECT_NEAR(cross(direction, end), 0.0, 1e-9);
    EXPECT_NEAR(world.pose(truck).heading_rad, 0.3, 1e-9);
  }
}

}  // namespace
}  // namespace odolab
