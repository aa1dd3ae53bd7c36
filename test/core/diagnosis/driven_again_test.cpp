#include "core/diagnosis/model/driven_again.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/diagnosis/diagnosis.h"
#include "test/support/calibrated_model.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// A vehicle goes where it goes, and its wheels turn unevenly beside it: by 2 mm per root metre. Its readings have then
// what the truth has not, as if that were smoothed.
std::vector<Recording> beside_uneven_wheels(const DifferentialDrive& drive, std::uint64_t seed) {
  constexpr double kUneven_m_per_sqrt_m = 0.002;
  Random random(seed);
  GeneratorSettings g = under_motion_capture(drive, 0.0, 0.01);
  g.duration_s = 90.0;
  g.wheel_period_s = 0.025;
  g.truth_position_noise_m = 0.0007;
  g.truth_heading_noise_rad = 0.0014;
  return three_runs(
      g, random, [&](int) { return varied_driving(random, g.duration_s); },
      [&](int) {
        return [&](InjectedStep& s) {
          s.left_read_rad +=
              kUneven_m_per_sqrt_m / drive.wheel_radius_left_m * std::sqrt(std::abs(s.left_m)) * random.normal();
          s.right_read_rad +=
              kUneven_m_per_sqrt_m / drive.wheel_radius_right_m * std::sqrt(std::abs(s.right_m)) * random.normal();
        };
      });
}

TEST(DrivenAgain, WheelsThatTurnUnevenlyFeignATruthThatIsSmoothed) {
  DifferentialDrive drive{0.029, 0.029, 0.23};
  drive.encoder_counts_per_revolution = 2000.0;
  Vehicle vehicle;
  vehicle.kind = drive;
  const Effect* smoothing = catalogue_entry({"truth_smoothing", "truth", {}});
  ASSERT_TRUE(smoothing);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::vector<Recording> recordings = beside_uneven_wheels(drive, seed);
    JointModel joint = calibrated_model(recordings, vehicle);
    joint.fit_noise_and_all();
    joint.driven_again = std::make_shared<const DrivenAgain>(joint, false);
    CandidateTest t = joint.test(joint.columns_of(*smoothing, {}));
    EXPECT_GT(t.judged(), 20.0);  // beyond all chance
    widen_by_readings(t, joint, *smoothing, {});
    EXPECT_LT(t.judged(), 6.6);  // chi-square of one number, one time in a hundred
  }
}

// Headings that are off by half a milliradian in one recording and a whole one in the next, and back, under a tracker
// that errs by two from one sample to the next: that was a tracked point that sits elsewhere in each, or wheels that
// are toed in.
TEST(DrivenAgain, ATruthThatTurnsSlowlyWithinItsErrorFeignsNothing) {
  constexpr double kOff_rad = 0.001, kLasts_s = 25.0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    GeneratorSettings g = under_motion_capture({0.03, 0.03, 0.15}, 0.0003, 0.01, 0.0003, 0.003);
    g.duration_s = 60.0;
    std::vector<Recording> recordings = three_runs(
        g, random, [&](int) { return varied_driving(random, g.duration_s); },
        [](int) -> std::function<void(InjectedStep&)> { return {}; });
    for (Recording& r : recordings) {
      double off_rad = kOff_rad * random.normal(), before_s = r.time_s.front();
      for (Channel& c : r.channels)
        for (std::size_t i = 0; c.name == "truth_heading_rad" && i < c.values.size(); ++i) {
          const double keeps = std::exp(-(r.time_s[i] - before_s) / kLasts_s);
          off_rad = keeps * off_rad + std::sqrt(1.0 - keeps * keeps) * kOff_rad * random.normal();
          before_s = r.time_s[i];
          c.values[i] += off_rad;
        }
    }
    Vehicle file;
    file.kind = DifferentialDrive{0.03, 0.03, 0.15};
    const Diagnosis d = diagnose(recordings, {}, file).value();
    for (const Finding& f : d.findings) {
      EXPECT_EQ(f.component, "truth") << seed << ": " << f.effect << " " << f.where.regime;
      EXPECT_NE(f.effect, "unknown") << seed << ": " << f.where.regime;
    }
  }
}

}  // namespace
}  // namespace odolab::test
