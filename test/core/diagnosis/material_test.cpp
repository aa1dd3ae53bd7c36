#include "core/diagnosis/naming/material.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace odolab {
namespace {

using GatheredError = JointModel::GatheredError;

GatheredError of(const std::vector<Pose>& errors) {
  GatheredError e;
  e.windows = static_cast<int>(errors.size());
  for (const Pose& p : errors) {
    e.position_m2 += dot(p.position(), p.position()) / e.windows;
    e.heading_rad2 += p.heading_rad * p.heading_rad / e.windows;
  }
  e.of_window = errors;
  return e;
}

struct Pair {
  GatheredError before, after;
};

// 100 windows of noise; a cause that is in the first `there` of them and a term that takes it away from the first
// `taken`. In times the noise.
Pair windows(std::uint64_t seed, double cause, int there, double term, int taken) {
  Random random(seed);
  std::vector<Pose> before, after;
  for (int i = 0; i < 100; ++i) {
    const double is = i < there ? cause : 0.0, by = i < taken ? term : 0.0;
    const Pose e{0.003 * (random.normal() + is), 0.003 * random.normal(), 0.005 * (random.normal() + is)};
    before.push_back(e);
    after.push_back({e.x_m - 0.003 * by, e.y_m, e.heading_rad - 0.005 * by});
  }
  return {of(before), of(after)};
}

TEST(WorseThanChance, IsATermThatTakesAwayWhatIsNotThere) {
  // It adds its square, half of the position's and all of the heading's; chance makes a fifth of that.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Pair p = windows(seed, 0.0, 100, 1.0, 100);
    EXPECT_GT(worse_than_chance(p.before, p.after), 0.0) << seed;
  }
}

// In a world without noise all is significant: a hundredth of a millimetre over a metre is still nothing that acts.
TEST(IsMaterial, IsNothingThatMovesDeadReckoningNowhereByWhatAnybodyResolves) {
  const auto is_believed = [](double share_of_noise) {
    const Pair p = windows(1, share_of_noise, 100, share_of_noise, 100);
    return is_material(0.0, false, p.before, p.after);
  };
  EXPECT_FALSE(is_believed(0.003));  // 0.009 mm and 0.015 mrad
  EXPECT_TRUE(is_believed(0.008));   // 0.024 mm and 0.04 mrad
}

TEST(WorseThanChance, IsNoTermThatIsRightHoweverSmall) {
  int refused = 0;
  for (double size : {0.05, 0.2, 1.0})
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const Pair p = windows(seed, size, 100, size, 100);
      refused += worse_than_chance(p.before, p.after) > 0.0;
    }
  // 2.5 standard deviations of the position's and the heading's chance together: 0.6 % each, and some
  EXPECT_LE(refused, 5) << "of 300";
}

TEST(WorseThanChance, IsNoEventThatIsRightAndMadeDeadReckoningALittleWorse) {
  // Two kicks of twice the noise in a hundred windows: chance takes two of them to where the sum of squares grows by
  // 2 %.
  std::vector<Pose> before(100, Pose{0.003, 0.0, 0.005}), after = before;
  for (int i : {10, 60}) {
    before[static_cast<std::size_t>(i)] = {0.0015, 0.0, 0.0025};
    after[static_cast<std::size_t>(i)] = {-0.0045, 0.0, -0.0075};
  }
  const GatheredError b = of(before), a = of(after);
  ASSERT_GT(a.position_m2, 1.02 * b.position_m2);
  EXPECT_LE(worse_than_chance(b, a), 0.0);
}

TEST(WorseThanChance, IsNothingWhereTheWindowsAreNotTheSame) {
  const Pair p = windows(1, 0.0, 100, 1.0, 100);
  GatheredError fewer = p.after;
  fewer.windows = 99;
  EXPECT_EQ(worse_than_chance(p.before, fewer), 0.0);
}

TEST(GatheredError, OfSetsOfRunsIsTheirMeanByWindows) {
  const Pair p = windows(3, 1.0, 40, 1.0, 40);
  GatheredError both = of({p.before.of_window.begin(), p.before.of_window.begin() + 30});
  both.add(of({p.before.of_window.begin() + 30, p.before.of_window.end()}));
  EXPECT_EQ(both.windows, 100);
  EXPECT_NEAR(both.position_m2, p.before.position_m2, 1e-12);
  EXPECT_NEAR(both.heading_rad2, p.before.heading_rad2, 1e-12);
}

}  // namespace
}  // namespace odolab
