#include "physics/experiments/drawn_mystery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace odolab {
namespace {

// Drawn once for all tests here: each takes a second or more.
const DrawnMystery& mystery() {
  static const DrawnMystery drawn = *drawn_mystery(3);
  return drawn;
}

bool same_bits(const Recording& a, const Recording& b) {
  if (a.time_s.size() != b.time_s.size() || a.channels.size() != b.channels.size()) return false;
  for (std::size_t c = 0; c < a.channels.size(); ++c)
    if (std::memcmp(a.channels[c].values.data(), b.channels[c].values.data(), a.time_s.size() * sizeof(double)) != 0)
      return false;
  return std::memcmp(a.time_s.data(), b.time_s.data(), a.time_s.size() * sizeof(double)) == 0;
}

TEST(DrawnMystery, OfTheSameSeedIsTheSameToTheBit) {
  const DrawnMystery& first = mystery();
  const DrawnMystery again = *drawn_mystery(3);
  ASSERT_EQ(first.recordings.size(), again.recordings.size());
  EXPECT_EQ(first.effect.effect, again.effect.effect);
  for (std::size_t r = 0; r < first.recordings.size(); ++r)
    EXPECT_TRUE(same_bits(first.recordings[r], again.recordings[r])) << first.recordings[r].name;
}

TEST(DrawnMystery, ConcealsWhatCanBeGuessed) {
  const std::vector<std::string> guesses = mystery_guesses();
  EXPECT_EQ(std::count(guesses.begin(), guesses.end(), right_guess(mystery())), 1);
  for (const Recording& r : mystery().recordings) EXPECT_EQ(r.name.find(mystery().effect.effect), std::string::npos);
}

TEST(DrawnMystery, StopsBeforeItsStartWhenTold) {
  EXPECT_FALSE(drawn_mystery(3, [](double) { return false; }).has_value());
}

TEST(AdvisedRun, GoesAlongThePathThatIsShown) {
  DifferentialDrive drive;
  FittedModel model;
  model.vehicle.kind = drive;
  const std::vector<DriveLeg> legs{{0.5, 0.0, 0.0}, {6.0, 0.2, 0.0}, {1.0, 0.0, 0.0}, {3.0, 0.0, 0.5}, {1.0, 0.0, 0.0}};
  const Pose start{1.0, 2.0, 0.5};
  const std::vector<Vec2> path = advised_path(drive, legs, start);
  const Recording run = advised_run(robot_of(model, {}), legs, start, "advised", 1);
  const std::vector<TruthSample> truth = truth_samples(run);
  ASSERT_GT(truth.size(), 100u);
  EXPECT_NEAR(length(truth.front().position - start.position()), 0.0, 1e-9);
  // 1.2 m of way; the two ramps of speed differ by some tenths of a second, at 0.2 m/s
  EXPECT_NEAR(length(truth.back().position - path.back()), 0.0, 0.06);
  EXPECT_GT(length(path.back() - path.front()), 1.0);
}

}  // namespace
}  // namespace odolab
