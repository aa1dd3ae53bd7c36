#include <gtest/gtest.h>

#include <algorithm>

#include "physics/planar_world.h"

namespace odolab {
namespace {

// A 50 kg truck that tows a 10 kg trailer by a pin at its centre; the trailer's axle has one free wheel on its middle.
struct Train {
  static constexpr double kDrawbar_m = 0.8;
  PlanarWorld world;
  int truck, trailer, left, right, wheel;

  explicit Train(double step_s, Pose start = {}) : world(step_s) {
    truck = world.add_body({start, 50.0, 3.0});
    trailer = world.add_body({start * Pose{-kDrawbar_m, 0.0, 0.0}, 10.0, 0.5});
    left = world.add_tread(truck, {0.0, 0.17});
    right = world.add_tread(truck, {0.0, -0.17});
    world.add_pin({truck, trailer, {}, {kDrawbar_m, 0.0}});
    wheel = world.add_free_wheel(trailer, {});
  }
  void roll(double left_mps, double right_mps) {
    world.set_tread(left, {left_mps, 0.0}, 150.0);
    world.set_tread(right, {right_mps, 0.0}, 150.0);
    world.step();
  }
  double gap_m() const { return length(world.pose(trailer) * Vec2{kDrawbar_m, 0.0} - world.pose(truck).position()); }
};

TEST(RigidJoints, PinHoldsItsPointOverTwoHundredMetresFarFromTheOrigin) {
  for (const double h : {0.001, 0.005}) {
    const double speed = 0.5, radius = 1.5;
    const Pose start{100.0, -100.0, 0.3};
    Train train(h, start);
    double largest_gap_m = 0.0, travel_m = 0.0;
    const int steps = static_cast<int>(400.0 / h);
    for (int k = 0; k < steps; ++k) {
      const double v = speed * std::min(1.0, (k + 0.5) * h);
      train.roll(v * (1.0 - 0.17 / radius), v * (1.0 + 0.17 / radius));
      travel_m += v * h;
      largest_gap_m = std::max(largest_gap_m, train.gap_m());
    }
    // After a correction that is linear in the gap its square over the drawbar is left: (1e-6)^2 / 0.8 and the rounding
    // of doubles at 100 m, 1e-14.
    EXPECT_LT(largest_gap_m, 1e-9) << "at a step of " << h << " s";
    // The trailer's axle runs on a circle of sqrt(R^2 - L^2), so that sin(hitch angle) = L / R. Its angle is that of a
    // chord of h v / R = 0.1 to 1.7 mrad, half of which a first-order step may miss in the pursuit.
    const double hitch_rad = train.world.pose(train.truck).heading_rad - train.world.pose(train.trailer).heading_rad;
    EXPECT_NEAR(hitch_rad, std::asin(Train::kDrawbar_m / radius), h * speed / radius);
    // The truck itself: the free truck's bar is 0.05 mm over 60 m of arc; what the pin's corrections push comes on top.
    const double turn_rad = travel_m / radius;
    const Vec2 end = start * Vec2{radius * std::sin(turn_rad), radius * (1.0 - std::cos(turn_rad))};
    EXPECT_LT(length(train.world.pose(train.truck).position() - end), 0.2e-3) << "at a step of " << h << " s";
    RecordProperty(h < 0.002 ? "gap_1ms_nm" : "gap_5ms_nm", std::to_string(1e9 * largest_gap_m));
    RecordProperty(h < 0.002 ? "end_1ms_um" : "end_5ms_um",
                   std::to_string(1e6 * length(train.world.pose(train.truck).position() - end)));
  }
}

TEST(RigidJoints, TrailerFollowsTheTractrix) {
  // From a right angle behind a truck that drives straight: y = L sech(t), x = L (t - tanh t) behind the pin's way L t.
  const double h = 0.001, speed = 0.2, drawbar = Train::kDrawbar_m;
  PlanarWorld world(h);
  const int truck = world.add_body({{0.0, 0.0, 0.0}, 50.0, 3.0});
  const int trailer = world.add_body({{0.0, drawbar, -0.5 * kPi}, 10.0, 0.5});
  const int left = world.add_tread(truck, {0.0, 0.17}), right = world.add_tread(truck, {0.0, -0.17});
  world.add_pin({truck, trailer, {}, {drawbar, 0.0}});
  world.add_free_wheel(trailer, {});
  for (int k = 0; k < 10000; ++k) {
    const double v = speed * std::min(1.0, (k + 0.5) * h);
    for (const int tread : {left, right}) world.set_tread(tread, {v, 0.0}, 150.0);
    world.step();
  }
  const double t = world.pose(truck).x_m / drawbar;
  const Pose& end = world.pose(trailer);
  EXPECT_NEAR(end.y_m, drawbar / std::cosh(t), 0.2e-3);  // a step's travel: the pursuit is of first order in it
  EXPECT_NEAR(end.x_m, drawbar * (t - std::tanh(t)), 0.2e-3);
}

TEST(RigidJoints, PinnedBodiesKeepTheirMomentum) {
  const double h = 0.001;
  PlanarWorld world(h);
  const int a = world.add_body({{0.0, 0.0, 0.0}, 20.0, 1.0});
  const int b = world.add_body({{1.0, 0.0, 0.0}, 10.0, 0.5});
  world.add_pin({a, b, {0.6, 0.0}, {-0.4, 0.0}});
  world.apply_force(b, {0.0, 10.0 * 0.5 / h});  // 5 kg m/s, sideways at b's centre
  double largest_gap_m = 0.0;
  for (int k = 0; k < 5000; ++k) {
    world.step();
    const Vec2 gap = world.pose(a) * Vec2{0.6, 0.0} - world.pose(b) * Vec2{-0.4, 0.0};
    largest_gap_m = std::max(largest_gap_m, length(gap));
  }
  const Vec2 momentum = 20.0 * world.velocity_mps(a) + 10.0 * world.velocity_mps(b);
  EXPECT_NEAR(momentum.x_m, 0.0, 1e-4);  // the push in single precision, 6e-8, added up over 5000 steps
  EXPECT_NEAR(momentum.y_m, 5.0, 1e-4);
  const Vec2 centre = (1.0 / 30.0) * (20.0 * world.pose(a).position() + 10.0 * world.pose(b).position());
  EXPECT_NEAR(centre.y_m, 5.0 / 30.0 * 5.0, 1e-4);
  EXPECT_LT(largest_gap_m, 1e-6);
}

TEST(RigidJoints, SliderKeepsItsPointOnTheLineAndItsSpringCentresIt) {
  const double h = 0.001;
  PlanarWorld world(h);
  const int a = world.add_body({{0.0, 0.0, 0.5}, 20.0, 1.0});
  const int b = world.add_body({Pose{0.0, 0.0, 0.5} * Pose{1.0, 0.0, 0.0}, 10.0, 0.5});
  world.add_slider({a, b, {1.0, 0.0}, {}, 0.0, 2.0, 0.7});
  world.apply_force(b, rotated({10.0 * 0.3 / h, 10.0 * 0.1 / h}, 0.5));  // along the line and across it
  double largest_m = 0.0, largest_slide_m = 0.0;
  for (int k = 0; k < 5000; ++k) {
    world.step();
    const Vec2 seen = inverse(world.pose(a)) * world.pose(b).position();
    largest_m = std::max(largest_m, std::abs(seen.y_m));
    largest_slide_m = std::max(largest_slide_m, std::abs(seen.x_m - 1.0));
  }
  EXPECT_LT(largest_m, 1e-6);
  EXPECT_GT(largest_slide_m, 5e-3);  // 0.3 m/s against 2 Hz: some 24 mm undamped
  EXPECT_LT(std::abs((inverse(world.pose(a)) * world.pose(b).position()).x_m - 1.0), 5e-3);
}

}  // namespace
}  // namespace odolab
