#include "physics/confirmed_diagnosis.h"

#include <gtest/gtest.h>

#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

double simulated_error_m(const std::vector<Recording>& recordings, const Vehicle& nominal) {
  const Result<Diagnosis> d = confirmed_diagnosis(recordings, {}, nominal);
  EXPECT_TRUE(d);
  EXPECT_TRUE(d->simulation.calibrated);
  return d->simulation.calibrated->position_rms_m;
}

TEST(ConfirmedDiagnosis, IsNotHeldAgainstOutliersOfTheTruth) {
  CaseSettings settings;
  settings.runs = 2;
  settings.duration_s = 30.0;
  Case c = generated_case(settings, 7401);
  const double clean_m = simulated_error_m(c.recordings, c.nominal);
  for (Recording& r : c.recordings)
    for (std::size_t i = 150; i < r.time_s.size(); i += 300)
      for (Channel& channel : r.channels)
        if (channel.name == "truth_x_m") channel.values[i] += 0.5;
  // They are a three-hundredth of the samples: at half a metre they would make 40 mm of it.
  EXPECT_NEAR(simulated_error_m(c.recordings, c.nominal), clean_m, 0.1 * clean_m);
  EXPECT_LT(clean_m, 0.01);
}

}  // namespace
}  // namespace odolab::test
