#include "physics/coulomb_solve.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"

namespace odolab {
namespace {

// What is left of the equations of motion and of Coulomb's law, as velocities.
struct Residual {
  double momentum_mps = 0.0;
  double law_mps = 0.0;
};

Vec2 slip_of(const CoulombSolve& solved, const CoulombContact& c) {
  const CoulombBody& b = solved.bodies[static_cast<std::size_t>(c.body)];
  const Vec2 above = b.velocity_mps + Vec2{-b.yaw_rate_radps * c.arm.y_m, b.yaw_rate_radps * c.arm.x_m};
  const Vec2 slip = above - c.surface_mps;
  return c.drive < 0 ? slip : slip - solved.drives[static_cast<std::size_t>(c.drive)].added_mps * c.direction;
}

Residual residual_of(const CoulombSolve& solved, const std::vector<CoulombBody>& before) {
  Residual worst;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const CoulombBody& b = solved.bodies[i];
    Vec2 push = b.mass_kg * (b.velocity_mps - before[i].velocity_mps);
    double spin = b.inertia_kgm2 * (b.yaw_rate_radps - before[i].yaw_rate_radps);
    for (const CoulombContact& c : solved.contacts)
      if (c.body == static_cast<int>(i)) {
        push = push - c.impulse_ns;
        spin -= cross(c.arm, c.impulse_ns);
      }
    for (const CoulombLink& link : solved.links) {
      const Vec2 impulse = link.impulse_ns * link.direction;
      if (link.body_b == static_cast<int>(i)) push = push - impulse, spin -= cross(link.arm_b, impulse);
      if (link.body_a == static_cast<int>(i)) push = push + impulse, spin += cross(link.arm_a, impulse);
    }
    worst.momentum_mps =
        std::max(worst.momentum_mps, std::max(length(push) / b.mass_kg, std::abs(spin) / b.inertia_kgm2));
  }
  for (std::size_t d = 0; d < solved.drives.size(); ++d) {
    double push = solved.drives[d].inertia_kg * (solved.drives[d].added_mps - solved.drives[d].free_mps);
    for (const CoulombContact& c : solved.contacts)
      if (c.drive == static_cast<int>(d)) push += dot(c.direction, c.impulse_ns);
    worst.momentum_mps = std::max(worst.momentum_mps, std::abs(push) / solved.drives[d].inertia_kg);
  }
  for (const CoulombContact& c : solved.contacts) {
    const Vec2 slip = slip_of(solved, c);
    // Either it holds, or it pulls with all its grip against the slip.
    const Vec2 lacking = c.impulse_ns + (c.grip_ns / std::max(length(slip), 1e-300)) * slip;
    if (length(slip) > 1e-6) worst.law_mps = std::max(worst.law_mps, length(lacking) / c.grip_ns * length(slip));
    EXPECT_LE(length(c.impulse_ns), c.grip_ns * (1.0 + 1e-12));
  }
  return worst;
}

TEST(CoulombSolve, MeetsTheEquationsOfMotionWhateverSticksAndSlips) {
  Random random(1);
  Residual worst;
  int held = 0, slid = 0;
  for (int k = 0; k < 3000; ++k) {
    CoulombSolve problem;
    for (int i = 0; i < 2; ++i) {
      CoulombBody body;
      body.mass_kg = 50.0;
      body.inertia_kgm2 = 3.0;
      body.velocity_mps = {random.uniform(-0.5, 0.5), random.uniform(-0.05, 0.05)};
      body.yaw_rate_radps = random.uniform(-1.0, 1.0);
      body.guess_mps = body.velocity_mps;
      body.guess_radps = body.yaw_rate_radps;
      problem.bodies.push_back(body);
      const double heading_rad = random.uniform(-3.0, 3.0);
      // From far off to nearly what the body does anyway: most slip, or most hold.
      const double off_mps = std::pow(10.0, random.uniform(-5.0, -1.0));
      for (const double y_m : {0.17, -0.17}) {
        CoulombContact c;
        c.body = i;
        c.arm = rotated(Vec2{0.0, y_m}, heading_rad);
        c.surface_mps = body.velocity_mps + Vec2{-body.yaw_rate_radps * c.arm.y_m, body.yaw_rate_radps * c.arm.x_m} +
                        off_mps * Vec2{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
        c.grip_ns = 1e-3 * random.uniform(10.0, 140.0);
        if (k % 2 == 0) {
          c.direction = {std::cos(heading_rad), std::sin(heading_rad)};
          // One motor for each wheel of the first body, one for both of the second.
          if (i == 0 || y_m > 0.0) {
            CoulombDrive drive;
            drive.body = i;
            drive.inertia_kg = 4.0;
            drive.free_mps = off_mps * random.uniform(-1.0, 1.0);
            problem.drives.push_back(drive);
          }
          c.drive = static_cast<int>(problem.drives.size()) - 1;
        }
        problem.contacts.push_back(c);
      }
    }
    CoulombLink spring;
    spring.body_a = 0;
    spring.body_b = 1;
    spring.direction = {1.0, 0.0};
    spring.resistance_kg = 0.4;
    spring.bias_ns = 1e-3 * random.uniform(-30.0, 30.0);
    problem.links.push_back(spring);
    const std::vector<CoulombBody> before = problem.bodies;
    problem.solve();
    const Residual r = residual_of(problem, before);
    worst.momentum_mps = std::max(worst.momentum_mps, r.momentum_mps);
    worst.law_mps = std::max(worst.law_mps, r.law_mps);
    for (const CoulombContact& c : problem.contacts) ++(length(slip_of(problem, c)) > 1e-6 ? slid : held);
  }
  EXPECT_GT(held, 1000);
  EXPECT_GT(slid, 1000);
  // A contact that holds says its force by a slip of 1 nm/s or less, which rounding leaves at 1e-4 of it or so: of
  // 0.14 Ns, against 50 kg of a body or 4 kg of a motor.
  EXPECT_LT(worst.momentum_mps, 1e-4);
  EXPECT_LT(worst.law_mps, 1e-9);  // what 1 nm/s of softness leaves above 1 um/s is a millionth of the slip
}

TEST(CoulombSolve, AMotorYieldsToTheFloorByItsInertia) {
  // A wheel of 4 kg at 0.1 m/s over the floor under a body of 12 kg at rest, which it grips: both move with the mean.
  CoulombSolve problem;
  problem.bodies.push_back({12.0, 1.0, {}, 0.0, {}, 0.0});
  CoulombContact wheel;
  wheel.grip_ns = 1.0;
  wheel.direction = {1.0, 0.0};
  wheel.drive = 0;
  problem.drives.push_back({0, 4.0, 0.1, 0.0});
  problem.contacts.push_back(wheel);
  problem.solve();
  EXPECT_NEAR(problem.bodies[0].velocity_mps.x_m, 0.025, 2e-9);  // softness
  EXPECT_NEAR(problem.drives[0].added_mps, 0.025, 1e-9);
  // With a tenth of the impulse that takes, it spins: 0.03 Ns.
  problem.bodies[0] = {12.0, 1.0, {}, 0.0, {}, 0.0};
  problem.contacts[0].grip_ns = 0.03;
  problem.solve();
  EXPECT_NEAR(problem.bodies[0].velocity_mps.x_m, 0.03 / 12.0, 1e-9);
  EXPECT_NEAR(problem.drives[0].added_mps, 0.1 - 0.03 / 4.0, 1e-9);
}

TEST(CoulombSolve, AJointHoldsTwoBodiesTogether) {
  CoulombSolve problem;
  problem.bodies.push_back({30.0, 2.0, {1.0, 0.0}, 0.0, {}, 0.0});
  problem.bodies.push_back({10.0, 1.0, {0.0, 0.5}, 0.0, {}, 0.0});
  for (const Vec2 along : {Vec2{1.0, 0.0}, Vec2{0.0, 1.0}}) {
    CoulombLink link;
    link.body_a = 0;
    link.direction = along;
    link.resistance_kg = CoulombLink::rigid_kg;
    problem.links.push_back(link);
    link.body_b = 1;
  }
  for (CoulombLink& link : problem.links) link.body_b = 1;
  problem.solve();
  for (const CoulombBody& body : problem.bodies) {   // joined at their centres: momentum shared
    EXPECT_NEAR(body.velocity_mps.x_m, 0.75, 1e-7);  // 10 Ns open a joint of 1e9 kg at 1e-8 m/s
    EXPECT_NEAR(body.velocity_mps.y_m, 0.125, 1e-7);
  }
}

}  // namespace
}  // namespace odolab
