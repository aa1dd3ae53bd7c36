#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kSlip_per_mps2 = 0.02, kSlippingWheelbase_m = 0.34, kSlippingRadius_m = 0.075;
// Of a body of m = 20 kg: I = 0.35 kg m2 about the axle's middle, its mass 75 mm ahead of it.
constexpr double kMass_kg = 20.0, kInertia_kgm2 = 0.35, kAhead_m = 0.075;

// Newton and Euler about the axle's middle: both wheels together push m a, and unlike each other they hold
// I dw/dt + m d v w. Each gives way by its force, against half the mass.
std::function<void(InjectedStep&)> giving_way() {
  return [speed = 0.0, yaw = 0.0](InjectedStep& s) mutable {
    const double v = 0.5 * kSlippingRadius_m * (s.left_radps + s.right_radps),
                 w = kSlippingRadius_m * (s.right_radps - s.left_radps) / kSlippingWheelbase_m;
    const double push_n = kMass_kg * (v - speed) / s.dt_s,
                 moment_nm = kInertia_kgm2 * (w - yaw) / s.dt_s + kMass_kg * kAhead_m * v * w;
    speed = v, yaw = w;
    const auto lost_m = [&](double force_n, double way_m) {
      return kSlip_per_mps2 * force_n / (0.5 * kMass_kg) * std::abs(way_m);
    };
    s.left_m -= lost_m(0.5 * push_n - moment_nm / kSlippingWheelbase_m, s.left_m);
    s.right_m -= lost_m(0.5 * push_n + moment_nm / kSlippingWheelbase_m, s.right_m);
  };
}

TEST(TractionSlip, IsNoTyreCompressionWhereTheMassStandsAheadOfTheAxle) {
  Random random(81);
  GeneratorSettings g =
      under_motion_capture({kSlippingRadius_m, kSlippingRadius_m, kSlippingWheelbase_m}, 0.0004, 0.01);
  g.duration_s = 60.0;
  const std::vector<Recording> recordings = three_runs(
      g, random, [&](int) { return varied_driving(random, g.duration_s); }, [](int) { return giving_way(); });
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.findings.front().effect, "traction_slip");
  // A form with another place of the mass is off by that much at most: 0.44 of the wheelbase's half, for 0.3 or 0.6.
  const FoundParameter& p = d.findings.front().parameters.front();
  EXPECT_NEAR(p.value, kSlip_per_mps2, 0.2 * kSlip_per_mps2 + 3.0 * p.stderr_value);
  for (const Finding& f : d.findings) EXPECT_NE(f.effect, "tyre_compression");
}

// A tread of relaxation length sigma that a wheel drags along: deflected by u it pushes its share of the mass with
// u / (k sigma), and slips by |v| u / sigma. A fifth of what is critical damps it.
std::function<void(InjectedStep&)> on_yielding_treads(double slip_per_mps2, double relaxes_over_m) {
  struct Tread {
    double speed_mps = 0.0, deflected_m = 0.0;
    double rolls_m(double wheel_mps, double k, double sigma_m, double dt_s) {
      constexpr double kDamped = 0.2;
      const double stiffness = 1.0 / (k * sigma_m), damping = 2.0 * kDamped * std::sqrt(stiffness),
                   yields_mps = wheel_mps - speed_mps - std::abs(speed_mps) * deflected_m / sigma_m;
      speed_mps += dt_s * (stiffness * deflected_m + damping * yields_mps);
      deflected_m += dt_s * yields_mps;
      return speed_mps * dt_s;
    }
  };
  return [=, left = Tread{}, right = Tread{}](InjectedStep& s) mutable {
    s.left_m = left.rolls_m(kSlippingRadius_m * s.left_radps, slip_per_mps2, relaxes_over_m, s.dt_s);
    s.right_m = right.rolls_m(kSlippingRadius_m * s.right_radps, slip_per_mps2, relaxes_over_m, s.dt_s);
  };
}

// Of another program's robots with such tyres the slip had been *unknown*, or play, tyres and loads beside it.
TEST(TractionSlip, StandsAloneOnTreadsThatYieldBeforeTheySlip) {
  for (const double slip_per_mps2 : {0.015, 0.03})
    for (const double relaxes_over_radii : {0.4, 0.8}) {
      Random random(83);
      GeneratorSettings g =
          under_motion_capture({kSlippingRadius_m, kSlippingRadius_m, kSlippingWheelbase_m}, 0.0004, 0.01);
      g.duration_s = 60.0;
      const std::vector<Recording> recordings = three_runs(
          g, random, [&](int) { return varied_driving(random, g.duration_s); },
          [&](int) { return on_yielding_treads(slip_per_mps2, relaxes_over_radii * kSlippingRadius_m); });
      const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
      ASSERT_EQ(d.findings.size(), 1U) << slip_per_mps2 << " " << relaxes_over_radii;
      EXPECT_EQ(d.findings.front().effect, "traction_slip");
      // What shows is the slip times that length, for as long as it is pushed: of forms in steps of two the nearest is
      // off by a seventh, and accelerations are known over 0.4 s, as long as these legs take to speed up.
      EXPECT_NEAR(d.findings.front().parameters.front().value, slip_per_mps2, 0.5 * slip_per_mps2);
    }
}

}  // namespace
}  // namespace odolab::test
