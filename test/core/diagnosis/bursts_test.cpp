#include "core/diagnosis/generic/bursts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

double chi_square_of_three(Random& random) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += std::pow(random.normal(), 2);
  return sum;
}

// Statistics of two recordings of four minutes each.
std::vector<Burst> statistics(Random& random, double apart_s) {
  std::vector<Burst> all;
  for (int run = 0; run < 2; ++run)
    for (int k = 0; k * apart_s < 240.0; ++k) all.push_back({run, k * apart_s, chi_square_of_three(random)});
  return all;
}

TEST(Bursts, OfNoiseFallOffAsAChiSquareDoes) {
  Random random(3);
  double sum = 0.0, count = 0.0;
  for (int drive = 0; drive < 200; ++drive)
    for (const Burst& b : bursts_of(statistics(random, 1.1))) sum += b.excess, ++count;
  // E(X - u | X > u) at the 97 % point of a chi-square of three, from that of five; three standard errors of 2600.
  EXPECT_NEAR(sum / count, 2.16, 0.13);
}

TEST(Bursts, OfNoiseAreNotUnlikely) {
  Random random(3);
  for (int drive = 0; drive < 200; ++drive) EXPECT_GT(chance_of(bursts_of(statistics(random, 0.3))), 0.005) << drive;
}

TEST(Bursts, AreNoNoise) {
  Random random(4);
  std::vector<Burst> with = statistics(random, 0.3);
  for (std::size_t k = 40; k < with.size(); k += 80) with[k].excess += 25.0;  // 20 times in eight minutes
  EXPECT_LT(chance_of(bursts_of(with)), 1e-6);
}

TEST(Bursts, CountOnceWithinASecond) {
  std::vector<Burst> all;
  for (int k = 0; k < 10; ++k) all.push_back({0, 5.0 + 0.3 * k, 20.0 + k});
  all.push_back({0, 30.0, 12.0});
  all.push_back({1, 30.0, 11.0});
  const std::vector<Burst> bursts = bursts_of(all);
  ASSERT_EQ(bursts.size(), 3u);
  EXPECT_NEAR(bursts[0].at_s, 7.7, 1e-9);
  EXPECT_NEAR(bursts[0].excess, 29.0 - 8.947, 1e-9);
}

// A wheel that slips for a third of a second every few seconds, by half a millimetre: nothing that could be named.
TEST(Bursts, OfSlipAreSomethingWithoutAName) {
  Random random(34), slips(35);  // of which no three slips make pushes, each by itself
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0005, 0.01);
  g.duration_s = 60.0;
  const auto slipping = [&](int) {
    auto until_s = std::make_shared<double>(0.0), rate_mps = std::make_shared<double>(0.0);
    auto own = std::make_shared<Random>(slips.next());
    auto next_s = std::make_shared<double>(2.0);
    return [=](InjectedStep& s) {
      if (s.time_s > *next_s) {
        *until_s = s.time_s + 0.3;
        *next_s = s.time_s + own->uniform(3.0, 6.0);
        *rate_mps = 0.002 * own->normal();
      }
      if (s.time_s < *until_s) s.left_m += *rate_mps * s.dt_s;
    };
  };
  const auto driving = [&](int) { return varied_driving(random, g.duration_s); };
  const Diagnosis with = diagnose(three_runs(g, random, driving, slipping), {}, Vehicle{}).value();
  ASSERT_EQ(with.verdict, Verdict::unknown_effect);
  EXPECT_NE(with.findings[0].where.regime.find("larger and more often than noise"), std::string::npos)
      << with.findings[0].where.regime;
}

// Tags on a wall: nothing is missing, and a pose errs by 2 mm and 4 mrad beside them, by six times as much where the
// vehicle is 4 m away.
TEST(Bursts, AreNotWhereATruthIsWorseFarAway) {
  for (std::uint64_t seed = 36; seed < 39; ++seed) {
    Random random(seed);
    GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 3e-4, 0.1);
    g.duration_s = 90.0;
    g.truth_position_noise_m = g.truth_heading_noise_rad = 0.0;
    std::vector<Recording> runs = three_runs(
        g, random, [&](int) { return varied_driving(random, g.duration_s); },
        [](int) { return std::function<void(InjectedStep&)>(); });
    for (Recording& r : runs) {
      const std::vector<double> x = r.channel("truth_x_m")->values, y = r.channel("truth_y_m")->values;
      for (Channel& c : r.channels) {
        if (c.name.rfind("truth", 0) != 0) continue;
        const double least = c.name == "truth_heading_rad" ? 0.004 : 0.002;
        for (std::size_t i = 0; i < x.size(); ++i)
          c.values[i] += least * (1.0 + 5.0 * std::pow(std::hypot(x[i], y[i]) / 4.0, 2)) * random.normal();
      }
    }
    const Result<Diagnosis> d = diagnose(runs, {}, Vehicle{});
    ASSERT_TRUE(d);
    EXPECT_NE(d->verdict, Verdict::unknown_effect) << seed;
  }
}

// Motion capture that loses sight of its markers now and then and bridges the hole with a curve: for a third of a
// second its poses are up to 2 mm and 6 mrad beside those of the vehicle, and then back.
TEST(Bursts, AreNotWhereATruthMovesAndMovesBack) {
  for (std::uint64_t seed = 41; seed < 44; ++seed) {
    Random random(seed);
    GeneratorSettings g = under_motion_capture(DifferentialDrive{}, 3e-4, 0.02, 0.0003, 0.001);
    g.duration_s = 90.0;
    std::vector<Recording> runs = three_runs(
        g, random, [&](int) { return varied_driving(random, g.duration_s); },
        [](int) { return std::function<void(InjectedStep&)>(); });
    for (Recording& r : runs)
      for (double begins_s = 4.0; begins_s < 86.0; begins_s += random.uniform(6.0, 14.0)) {
        constexpr double kLasts_s = 0.35, kMost[] = {0.002, 0.002, 0.006};
        std::size_t channel = 0;
        for (Channel& c : r.channels) {
          if (c.name.rfind("truth", 0) != 0) continue;
          const double most = kMost[channel++] * random.uniform(-1.0, 1.0);
          for (std::size_t i = 0; i < r.time_s.size(); ++i) {
            const double gone = (r.time_s[i] - begins_s) / kLasts_s;
            if (gone > 0.0 && gone < 1.0) c.values[i] += most * std::sin(kPi * gone);
          }
        }
      }
    const Result<Diagnosis> d = diagnose(runs, {}, Vehicle{});
    ASSERT_TRUE(d);
    EXPECT_NE(d->verdict, Verdict::unknown_effect) << seed << " " << d->findings.front().where.regime;
  }
}

}  // namespace
}  // namespace odolab::test
