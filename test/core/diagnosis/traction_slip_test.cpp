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

}  // namespace
}  // namespace odolab::test
