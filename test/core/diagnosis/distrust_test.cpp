#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/ready_recordings.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

// A second noise of the truth beside the white one, that is forgotten in a sixth of a second.
void add_lasting_noise(Recording& recording, double sd_m, Random& random) {
  constexpr double kForgotten_s = 0.16;
  for (Channel& c : recording.channels) {
    if (c.name != "truth_x_m" && c.name != "truth_y_m") continue;
    double noise_m = 0.0, last_s = -1e9;
    for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
      if (!std::isfinite(c.values[i])) continue;
      const double kept = std::exp(-(recording.time_s[i] - last_s) / kForgotten_s);
      noise_m = kept * noise_m + std::sqrt(1.0 - kept * kept) * sd_m * random.normal();
      last_s = recording.time_s[i];
      c.values[i] += noise_m;
    }
  }
}

// A creep of a fifth of a millimetre a second, which moves dead reckoning over a metre by less than the noise does.
TEST(Distrust, HidesNothingThatIsPlain) {
  CaseSettings settings;
  settings.effect = "floor_slope_creep";
  settings.size = 0.12;
  settings.runs = 3;
  settings.duration_s = 50.0;
  Case c = generated_case(settings, 7811);
  Random random(3);
  for (Recording& r : c.recordings) add_lasting_noise(r, 0.0002, random);
  const ReadyRecordings ready = ready_recordings(c.recordings, {}, c.nominal, {}).value();
  const double distrust = calibrated_model(ready, c.nominal)->distrust();
  EXPECT_GT(distrust, 0.1);
  EXPECT_LT(distrust, 0.9);
  const Diagnosis d = diagnose(c.recordings, {}, c.nominal).value();
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.findings.front().effect, "floor_slope_creep");
}

}  // namespace
}  // namespace odolab::test
