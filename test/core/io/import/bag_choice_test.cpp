#include "core/io/import/bag_choice.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

BagTopicContents topic(const std::string& name, const std::string& type, std::vector<std::string> joints = {}) {
  BagTopicContents contents;
  contents.topic = {name, type, "cdr"};
  contents.kind = ros_kind(type);
  contents.messages = 10;
  contents.joints = std::move(joints);
  return contents;
}

using Names = std::pair<std::string, std::string>;

TEST(BagChoice, KnowsDriveWheelsByTheirNames) {
  EXPECT_EQ(wheel_joints({"wheel_right_joint", "wheel_left_joint"}), (Names{"wheel_left_joint", "wheel_right_joint"}));
  EXPECT_EQ(wheel_joints({"drivewhl_l_joint", "drivewhl_r_joint", "caster_l_wheel"}),
            (Names{"drivewhl_l_joint", "drivewhl_r_joint"}));
  EXPECT_EQ(wheel_joints({"arm_left", "arm_right", "leftWheel", "rightWheel"}), (Names{"leftWheel", "rightWheel"}));
  EXPECT_EQ(wheel_joints({"left", "right"}), (Names{"left", "right"}));
  // four wheels, or nothing that says which: a person must say
  EXPECT_EQ(wheel_joints({"front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel"}), Names{});
  EXPECT_EQ(wheel_joints({"joint1", "joint2"}), Names{});
  EXPECT_EQ(wheel_joints({"upper_wheel", "lower_wheel"}), Names{});  // an r or l within a word is no side
}

TEST(BagChoice, TakesWhatSaysThatItIsTheTruthAndNeverTheRobotsOwnEstimate) {
  BagContents bag;
  bag.topics = {topic("/odom", "nav_msgs/msg/Odometry"),
                topic("/amcl_pose", "geometry_msgs/msg/PoseWithCovarianceStamped"),
                topic("/goal_pose", "geometry_msgs/msg/PoseStamped"),
                topic("/joint_states", "sensor_msgs/msg/JointState", {"wheel_left", "wheel_right"})};
  Result<BagChoice> choice = chosen_of_bag("b", bag, {});
  ASSERT_TRUE(choice.ok()) << choice.error().message();
  EXPECT_EQ(choice->truth, "");
  EXPECT_EQ(choice->warnings, std::vector<std::string>{"no outside truth was found; --truth can name one of /odom, "
                                                       "/amcl_pose, /goal_pose"});
  bag.topics.push_back(topic("/vrpn_client_node/create1/pose", "geometry_msgs/msg/PoseStamped"));
  choice = chosen_of_bag("b", bag, {});
  ASSERT_TRUE(choice.ok());
  EXPECT_EQ(choice->truth, "/vrpn_client_node/create1/pose");
  bag.topics.push_back(topic("/vrpn_client_node/create2/pose", "geometry_msgs/msg/PoseStamped"));
  EXPECT_EQ(chosen_of_bag("b", bag, {}).error().message(),
            "b: found several that may be the outside truth, expected --truth with one of "
            "/vrpn_client_node/create1/pose, /vrpn_client_node/create2/pose, or none");
}

TEST(BagChoice, AsksForWhatIsNotPlain) {
  BagContents bag;
  bag.topics = {topic("/joint_states", "sensor_msgs/msg/JointState", {"fl_wheel", "fr_wheel", "joint3"})};
  EXPECT_EQ(chosen_of_bag("b", bag, {}).error().message(),
            "b: found joints of which two are not plainly the drive wheels, expected --joints LEFT,RIGHT of fl_wheel, "
            "fr_wheel, joint3");
  ImportWishes wishes;
  wishes.left_joint = "fl_wheel";
  wishes.right_joint = "fr_whel";
  EXPECT_EQ(chosen_of_bag("b", bag, wishes).error().message(),
            "b: found no joint 'fr_whel', expected --joints LEFT,RIGHT of fl_wheel, fr_wheel, joint3");
  wishes.right_joint = "fr_wheel";
  EXPECT_EQ(chosen_of_bag("b", bag, wishes)->right_joint, "fr_wheel");
  bag.topics.push_back(topic("/base/joint_states", "sensor_msgs/msg/JointState", {"fl_wheel", "fr_wheel"}));
  EXPECT_EQ(chosen_of_bag("b", bag, wishes).error().message(),
            "b: found drive wheels on several topics, expected --wheels with one of /joint_states, /base/joint_states");
  wishes.wheels = "/base/joint_states";
  EXPECT_EQ(chosen_of_bag("b", bag, wishes)->wheels, "/base/joint_states");
  wishes.commands = "/cmd_vel";
  EXPECT_EQ(chosen_of_bag("b", bag, wishes).error().message(),
            "b: found no twists on '/cmd_vel', expected a bag with twists");
}

}  // namespace
}  // namespace odolab
