#include "core/diagnosis/quality/truth_jumps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab::test {
namespace {

// Jumps of a centimetre at places a metre apart, each in another direction of the room.
std::vector<TruthJump> jumps(int count, double forward_share, double sideways_share) {
  std::vector<TruthJump> out;
  for (int k = 0; k < count; ++k) {
    TruthJump j;
    const double angle = 2.4 * k;
    j.at = {static_cast<double>(k), 0.0};
    j.by = {0.01 * std::cos(angle), 0.01 * std::sin(angle)};
    j.of_axle = {forward_share * j.by.x_m, sideways_share * j.by.y_m, 0.003};
    j.by_chance_m = 0.001;
    out.push_back(j);
  }
  return out;
}

TEST(TruthJumps, AreTheTruthsWhereManyGoAnyWay) { EXPECT_TRUE(are_of_the_truth(jumps(8, 1.0, 1.0))); }

TEST(TruthJumps, AreNotTheTruthsWhereTheyAreFew) { EXPECT_FALSE(are_of_the_truth(jumps(5, 1.0, 1.0))); }

TEST(TruthJumps, AreNotTheTruthsWhereNoneGoesSidewaysAsWheelsDoNot) {
  EXPECT_FALSE(are_of_the_truth(jumps(8, 1.0, 0.1)));
}

TEST(TruthJumps, AreNotTheTruthsWhereOnePlaceMakesThemOneWayAndBack) {
  // As where one camera hands over to another.
  std::vector<TruthJump> all = jumps(8, 1.0, 1.0);
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].at = {0.05 * static_cast<double>(k), 0.0};
    all[k].by = {k % 2 == 0 ? 0.01 : -0.01, 0.0};
  }
  EXPECT_FALSE(are_of_the_truth(all));
}

TEST(TruthJumps, AreNotTheTruthsWhereTheyGoAlongOneLineOfTheVehicle) {
  // As where castors shove it to the left forwards and to the right in reverse.
  std::vector<TruthJump> all = jumps(8, 1.0, 1.0);
  for (std::size_t k = 0; k < all.size(); ++k) all[k].of_axle = {0.002, k % 2 == 0 ? 0.01 : -0.01, 0.003};
  EXPECT_FALSE(are_of_the_truth(all));
}

// Eight jumps of 10 mm among 1600 changes: of those that go 3 mm in x and in y, six are as large by chance.
TEST(TruthJumps, StandOutOnlyWhereSoManyAreNoChance) {
  TruthJumps of_run;
  of_run.jumps = jumps(8, 1.0, 1.0);
  of_run.changes = 1600.0;
  of_run.change_m = 0.003;
  EXPECT_FALSE(stand_out({of_run}));
  of_run.change_m = 0.002;
  EXPECT_TRUE(stand_out({of_run}));
}

}  // namespace
}  // namespace odolab::test
