#include "core/io/unread_columns.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

std::vector<std::string> unread_of(const std::vector<std::string>& names) {
  Recording recording;
  recording.time_s = {0.0, 1.0};
  for (const std::string& name : names) recording.channels.push_back({name, {0.0, 0.0}});
  return unread_columns(recording);
}

TEST(UnreadColumns, AreSaidWhereTheyLookLikeOneThatIsMissing) {
  const std::vector<std::string> heading =
      unread_of({"left_wheel_rad", "right_wheel_rad", "truth_x_m", "truth_y_m", "truth_theta_rad"});
  ASSERT_EQ(heading.size(), 1u);
  EXPECT_NE(heading[0].find("'truth_theta_rad'"), std::string::npos) << heading[0];
  EXPECT_NE(heading[0].find("'truth_heading_rad'"), std::string::npos) << heading[0];
  const std::vector<std::string> wheels =
      unread_of({"left_wheel_deg", "right_wheel_deg", "truth_x_m", "truth_y_m", "truth_heading_rad"});
  ASSERT_EQ(wheels.size(), 2u);
  EXPECT_NE(wheels[0].find("'left_wheel_rad'"), std::string::npos) << wheels[0];
}

TEST(UnreadColumns, MayStandBesideAllThatIsNeeded) {
  EXPECT_TRUE(unread_of({"left_ticks", "right_ticks", "left_current_a", "truth_x_m", "truth_y_m", "truth_heading_rad",
                         "truth_quality", "battery_v"})
                  .empty());
}

}  // namespace
}  // namespace odolab
