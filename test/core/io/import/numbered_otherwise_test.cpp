#include "core/io/import/numbered_otherwise.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

TEST(NumberedOtherwise, HalvesOfTwoRunsAreSeenByTheNumbersInTheirNames) {
  const auto said = numbered_otherwise({"square/s7_run-01_odo.csv", "square/s7_run-02_opti.csv"});
  ASSERT_TRUE(said);
  EXPECT_NE(said->find("square/s7_run-02_opti.csv"), std::string::npos) << *said;
  EXPECT_TRUE(numbered_otherwise({"Robot1_Odometry.dat", "Robot2_Groundtruth.dat"}));
}

TEST(NumberedOtherwise, HalvesOfOneRunAreNotHoweverTheirFoldersAreCalled) {
  EXPECT_FALSE(numbered_otherwise({"Robot1_Odometry.dat", "Robot1_Groundtruth.dat"}));
  EXPECT_FALSE(numbered_otherwise({"day1/run-01_odo.csv", "day2/run-01_opti.csv"}));
  EXPECT_FALSE(numbered_otherwise({"log.csv", "truth_2.tum"}));  // a number for one of them alone says nothing
  EXPECT_FALSE(numbered_otherwise({}));
}

}  // namespace
}  // namespace odolab
