#include "core/diagnosis/gathered_evidence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/pushed_runs.h"

namespace odolab::test {
namespace {

// White noise of 400 samples in two recordings, and beside it a trace of random sizes, `there` times in the first and
// in the second; a trace that is there throughout is fitted to it and taken off.
std::vector<std::vector<SampleEvidence>> fitted(Random& random, double there_first, double there_second) {
  constexpr std::size_t kSamples = 400;
  std::vector<double> trace, measured;
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    trace.push_back(random.uniform(0.0, 1.0));
    measured.push_back(random.normal() + (2 * i < kSamples ? there_first : there_second) * trace[i]);
    product += trace[i] * measured[i];
    square += trace[i] * trace[i];
  }
  const double size = product / square;
  std::vector<std::vector<SampleEvidence>> of_run(2);
  for (std::size_t i = 0; i < kSamples; ++i)
    of_run[2 * i / kSamples].push_back({0.1 * static_cast<double>(i), size * trace[i] * (measured[i] - size * trace[i]),
                                        size * size * trace[i] * trace[i]});
  return of_run;
}

double gain_of(const std::vector<std::vector<SampleEvidence>>& of_run) {
  double square = 0.0;
  for (const auto& run : of_run)
    for (const SampleEvidence& s : run) square += s.square;
  return 0.5 * square;
}

// The share of the way, by its information, on which the gain lies between both bounds.
double share_within(const GatheredEvidence& g) {
  double within = 0.0;
  for (std::size_t i = 1; i < g.gain.size(); ++i)
    if (g.gain[i] >= g.low[i] && g.gain[i] <= g.high[i]) within += g.foreseen[i] - g.foreseen[i - 1];
  return g.gain.empty() ? 1.0 : within / (g.foreseen.back() - g.foreseen.front());
}

// Mean over many drives of the share of the way that lies in the band.
double mean_share_within(double there_first, double there_second) {
  constexpr int kDrives = 300;
  Random random(4);
  double sum = 0.0;
  for (int drive = 0; drive < kDrives; ++drive) {
    const std::vector<std::vector<SampleEvidence>> of_run = fitted(random, there_first, there_second);
    sum += share_within(gathered_evidence(of_run, {"a", "b"}, gain_of(of_run)));
  }
  return sum / kDrives;
}

TEST(GatheredEvidence, OfWhatIsThereLiesInItsBand95TimesOfAHundred) {
  // A bridge's share outside has a standard deviation of 0.11: three of 300 of them.
  EXPECT_NEAR(mean_share_within(1.0, 1.0), 0.95, 0.019);
}

TEST(GatheredEvidence, OfWhatIsThereForHalfOfTheTimeAloneLeavesIt) {
  // At the middle the line is at zero, where half of a gain of 67 is foreseen, and 11 is 1.96 standard deviations.
  EXPECT_LT(mean_share_within(0.0, 2.0), 0.4);
}

TEST(GatheredEvidence, ComesToTheGainThatIsSaidOfTheFinding) {
  Random random(5);
  const GatheredEvidence g = gathered_evidence(fitted(random, 1.0, 1.0), {"a", "b"}, 12.5);
  ASSERT_EQ(g.gain.size(), 400u);
  for (const std::vector<double>* line : {&g.gain, &g.foreseen, &g.low, &g.high}) EXPECT_NEAR(line->back(), 12.5, 1e-6);
  ASSERT_EQ(g.begins.size(), 2u);
  EXPECT_EQ(g.begins[1].first, "b");
  EXPECT_NEAR(g.begins[1].second, 19.9, 1e-9);  // the time between two recordings was not driven
  EXPECT_NEAR(g.driven_s.back(), 39.8, 1e-9);
}

TEST(GatheredEvidence, OfAPushComesWhenItIsPushed) {
  const Diagnosis d = diagnose(runs_with_a_push(0.03, 17.0), {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u);
  const GatheredEvidence& g = d.findings.front().gathered;
  ASSERT_EQ(g.begins.size(), 3u);
  const auto gain_until = [&](double in_run_s) {
    std::size_t k = 0;
    while (k + 1 < g.driven_s.size() && g.driven_s[k + 1] <= g.begins[1].second + in_run_s) ++k;
    return g.gain[k] / g.gain.back();
  };
  EXPECT_LT(std::abs(gain_until(16.8)), 0.05);
  EXPECT_GT(gain_until(17.5), 0.95);
}

TEST(GatheredEvidence, OfALoadLiesInItsBand) {
  CaseSettings settings;
  settings.effect = "payload_radius_change";
  settings.size = 4.0;
  const Case c = generated_case(settings, 7);
  const Diagnosis d = diagnose(c.recordings, {}, c.nominal).value();
  ASSERT_EQ(d.findings.front().effect, "payload_radius_change");
  EXPECT_GT(share_within(d.findings.front().gathered), 0.7);  // two standard deviations below 0.95
}

}  // namespace
}  // namespace odolab::test
