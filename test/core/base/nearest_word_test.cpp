#include "core/base/nearest_word.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

TEST(NearestWord, IsTheOneOfWhichFewestLettersDiffer) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);  // two exchanged, one put in
  EXPECT_EQ(edit_distance("", "odometry"), 8u);
  const std::vector<std::string> known{"diagnose", "calibrate", "reproduce"};
  EXPECT_EQ(*nearest_word("diagnoze", known), "diagnose");
  EXPECT_EQ(*nearest_word("calbrate", known), "calibrate");
  EXPECT_EQ(nearest_word("simulate", known), nullptr);
}

}  // namespace
}  // namespace odolab
