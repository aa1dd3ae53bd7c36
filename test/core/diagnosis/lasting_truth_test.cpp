#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

constexpr double kOff_m = 0.008, kOff_rad = 0.007, kLasts_s = 2.0;

// Four runs of a minute, as a laser sees them that is matched to a map: its error lasts, beside a white one of 4 mm.
// The left radius grows by so much in a second.
std::vector<Recording> seen_by_laser(double grows_per_s) {
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.001, 0.1);
  g.truth_position_noise_m = 0.004;
  g.truth_heading_noise_rad = 0.003;
  g.duration_s = 60.0;
  Random random(12);
  std::vector<Recording> recordings;
  for (int run = 0; run < 4; ++run) {
    g.inject = [=](InjectedStep& s) { s.left_m *= 1.0 + grows_per_s * s.time_s; };
    recordings.push_back(generated(g, varied_driving(random, g.duration_s), random));
    Recording& r = recordings.back();
    r.name = "run_" + std::to_string(run + 1);
    double off[3] = {}, last_s = -100.0;
    for (std::size_t i = 0; i < r.time_s.size(); ++i) {
      if (std::isnan(r.channels[2].values[i])) continue;
      const double decay = std::exp(-(r.time_s[i] - last_s) / kLasts_s);
      last_s = r.time_s[i];
      for (std::size_t k = 0; k < 3; ++k) {
        off[k] = decay * off[k] + std::sqrt(1.0 - decay * decay) * (k < 2 ? kOff_m : kOff_rad) * random.normal();
        r.channels[2 + k].values[i] += off[k];
      }
    }
  }
  return recordings;
}

bool is_said_to_last(const Diagnosis& d) {
  for (const std::string& w : d.warnings)
    if (w.find("the truth's error lasts for about 2 s") != std::string::npos) return true;
  return false;
}

TEST(LastingTruth, IsKnownForWhatItIs) {
  const Result<Diagnosis> d = diagnose(seen_by_laser(0.0), {}, Vehicle{});
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::nothing_missing);
  EXPECT_TRUE(is_said_to_last(*d));
}

// Six thousandths in a minute. Where such noise was taken for one that never comes back, nothing was said of it.
TEST(LastingTruth, DoesNotHideWhatIsSlow) {
  constexpr double kGrows_per_s = 1e-4;
  const Result<Diagnosis> d = diagnose(seen_by_laser(kGrows_per_s), {}, Vehicle{});
  ASSERT_TRUE(d);
  EXPECT_TRUE(is_said_to_last(*d));
  ASSERT_FALSE(d->findings.empty());
  const Finding& f = d->findings.front();
  ASSERT_EQ(f.effect, "radius_drift");
  EXPECT_EQ(f.component, "left_wheel");
  EXPECT_NEAR(f.parameters.front().value, kGrows_per_s, 4.0 * f.parameters.front().stderr_value);
}

}  // namespace
}  // namespace odolab::test
