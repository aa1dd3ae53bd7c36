#include "core/diagnosis/naming/in_each_run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace odolab::test {
namespace {

// What a trace that was fitted to all recordings says of each, if white noise was in them and `there` times the trace.
std::vector<std::vector<SampleEvidence>> fitted_to(const std::vector<double>& there, Random& random) {
  constexpr int kSamples = 200;
  std::vector<std::vector<double>> trace(there.size()), measured(there.size());
  double product = 0.0, square = 0.0;
  for (std::size_t r = 0; r < there.size(); ++r)
    for (int i = 0; i < kSamples; ++i) {
      trace[r].push_back(random.uniform(0.0, 0.8));
      measured[r].push_back(random.normal() + there[r] * trace[r].back());
      product += trace[r].back() * measured[r].back();
      square += trace[r].back() * trace[r].back();
    }
  const double size = product / square;
  std::vector<std::vector<SampleEvidence>> of_run(there.size());
  for (std::size_t r = 0; r < there.size(); ++r)
    for (int i = 0; i < kSamples; ++i) {
      const double whole = size * trace[r][i];
      of_run[r].push_back({0.1 * i, whole * (measured[r][i] - whole), whole * whole});
    }
  return of_run;
}

TEST(GainOfEach, IsAsForeseenOfWhatIsThere) {
  constexpr int kSets = 400;
  Random random(1);
  double gain = 0.0, foreseen = 0.0;
  for (int n = 0; n < kSets; ++n) {
    const GainOfEach all = gain_of_each(fitted_to({0.5, 0.5, 0.5, 0.5}, random), 1.0);
    gain += all.gain;
    foreseen += all.foreseen;
  }
  // 200 x 0.213 x 0.25 in each of four: half of 42.7 and of what the fit takes of noise, less a sixth for each. A
  // set's gain scatters by two about what is foreseen.
  EXPECT_NEAR(foreseen / kSets, 0.5 * (42.7 + 1.0) - 4.0 / 6.0, 1.0);
  EXPECT_NEAR(gain / kSets, foreseen / kSets, 2.0);
}

TEST(GainOfEach, IsNoneOfWhatIsThereInOneRecordingAlone) {
  Random random(2);
  for (int n = 0; n < 20; ++n) {
    const GainOfEach all = gain_of_each(fitted_to({0.0, 2.0, 0.0, 0.0}, random), 1.0);
    EXPECT_LT(all.gain, 0.0);
    EXPECT_GT(all.foreseen, 6.0);
  }
}

TEST(GainOfEach, LeavesOutWhatTheOthersDoNotKnow) {
  const std::vector<std::vector<SampleEvidence>> of_run = {{{1.0, 0.0, 40.0}}, {{1.0, 0.0, 4.0}}};
  const GainOfEach all = gain_of_each(of_run, 1.0);
  EXPECT_DOUBLE_EQ(all.gain, 2.0);  // of the second alone: of the size the first has all
  EXPECT_DOUBLE_EQ(all.foreseen, 2.0 * (1.0 - 1.0 / 40.0));
}

}  // namespace
}  // namespace odolab::test
