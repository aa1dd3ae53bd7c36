#include "core/calibration/smoothed_at_rest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <functional>

#include "core/base/random.h"
#include "test/support/other_clock.h"

namespace odolab::test {
namespace {

constexpr double kStep_s = 0.02;

// A number for each sample of the truth, one after the other.
using Noise = std::function<double(Random&)>;

Noise of_its_own() {
  return [](Random& random) { return 0.0003 * random.normal(); };
}

Noise mean_of(int samples, Noise of) {
  return [samples, of, last = std::deque<double>()](Random& random) mutable {
    while (static_cast<int>(last.size()) < samples) last.push_back(of(random));
    double sum = 0.0;
    for (const double v : last) sum += v;
    last.pop_front();
    return sum / samples;
  };
}

// Of so much each, and lasting for so long.
Noise wandering(double off, double lasts_s) {
  return [stays = std::exp(-kStep_s / lasts_s), off, now = 0.0](Random& random) mutable {
    return now = stays * now + std::sqrt(1.0 - stays * stays) * off * random.normal();
  };
}

Noise both(Noise a, Noise b) {
  return [a, b](Random& random) mutable { return a(random) + b(random); };
}

// Stands for three seconds and drives for two, ten times over.
Recording stands_and_drives(const Noise& noise, std::uint64_t seed, int rows = 2500) {
  Random random(seed);
  Noise off_x = noise, off_y = noise, off_heading = noise;
  Recording r;
  std::vector<double> wheel, x, y, heading;
  double rolled_rad = 0.0;
  for (int i = 0; i < rows; ++i) {
    r.time_s.push_back(kStep_s * i);
    if (i % 250 >= 150) rolled_rad += 0.1;
    wheel.push_back(rolled_rad);
    x.push_back(0.075 * rolled_rad + off_x(random));
    y.push_back(off_y(random));
    heading.push_back(off_heading(random));
  }
  r.add_channel("left_wheel_rad").values = wheel;
  r.add_channel("right_wheel_rad").values = wheel;
  r.add_channel("truth_x_m").values = x;
  r.add_channel("truth_y_m").values = y;
  r.add_channel("truth_heading_rad").values = heading;
  return r;
}

std::optional<double> told_of(const Noise& noise, std::uint64_t seed) {
  return smoothed_for_s({stands_and_drives(noise, seed)}, DifferentialDrive{});
}

TEST(SmoothedAtRest, IsNoTruthWhoseSamplesAreIndependent) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(told_of(of_its_own(), seed), 0.0) << seed;
    EXPECT_EQ(told_of(both(of_its_own(), wandering(0.0005, 1.5)), seed), 0.0) << seed;
  }
}

TEST(SmoothedAtRest, IsAMeanOfSamplesForAsLongAsThatLasts) {
  for (const int samples : {3, 5, 8})
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const std::optional<double> for_s = told_of(mean_of(samples, of_its_own()), seed);
      ASSERT_TRUE(for_s) << samples << ", " << seed;
      // At 0.75 of it the way goes back 0.25 of what it came: of some 300 in each of three channels, 0.35 by chance.
      EXPECT_GE(*for_s, 0.65 * kStep_s * samples) << samples << ", " << seed;
      EXPECT_LE(*for_s, 1.01 * kStep_s * (samples + 1)) << samples << ", " << seed;
    }
}

TEST(SmoothedAtRest, IsToldBesideWhatWanders) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::optional<double> for_s = told_of(mean_of(5, both(of_its_own(), wandering(0.0002, 2.0))), seed);
    ASSERT_TRUE(for_s) << seed;
    // What wanders goes back by nothing: less shows of what does.
    EXPECT_GE(*for_s, 0.65 * kStep_s * 5) << seed;
    EXPECT_LE(*for_s, 1.45 * kStep_s * 5) << seed;
  }
}

// They fade: their way goes back a little from the first sample on. Of what lasts for 0.3 s ten rests of two seconds
// hold some sixty, and chance is larger than that little in one of twenty.
TEST(SmoothedAtRest, IsSeldomATruthWhoseErrorsFade) {
  int told = 0;
  for (const double lasts_s : {0.05, 0.1, 0.3, 3.0})
    for (std::uint64_t seed = 0; seed < 20; ++seed)
      told += told_of(wandering(0.0003, lasts_s), seed).value_or(0.0) > 0.0;
  EXPECT_LE(told, 4);  // of 80
}

TEST(SmoothedAtRest, IsNotToldByFewSamples) {
  EXPECT_FALSE(smoothed_for_s({stands_and_drives(mean_of(5, of_its_own()), 1, 55)}, DifferentialDrive{}));
}

TEST(SmoothedAtRest, RestsWhereTheWheelsDoByWhateverClock) {
  constexpr double kLate_s = 6.0;
  const Recording r = stands_and_drives(mean_of(5, of_its_own()), 3);
  const auto own = smoothed_for_s({r}, DifferentialDrive{}),
             late = smoothed_for_s({with_truths_clock(r, kLate_s, 0.0)}, DifferentialDrive{}, kLate_s);
  ASSERT_TRUE(own && late);
  EXPECT_NEAR(*late, *own, 1e-9);
}

}  // namespace
}  // namespace odolab::test
