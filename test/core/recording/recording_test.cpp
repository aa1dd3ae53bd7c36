#include "core/recording/recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace odolab {
namespace {

const double kEmpty = std::nan("");

TEST(Recording, KeepsChannelsByName) {
  Recording r;
  r.time_s = {0.0, 0.5};
  r.add_channel("left_ticks").values[1] = 7.0;
  ASSERT_TRUE(r.channel("left_ticks"));
  EXPECT_TRUE(std::isnan(r.channel("left_ticks")->values[0]));
  EXPECT_EQ(r.channel("left_ticks")->values[1], 7.0);
  EXPECT_FALSE(r.channel("right_ticks"));
  EXPECT_EQ(r.duration_s(), 0.5);
}

TEST(Recording, SaysWhatIsWrongWithIt) {
  Recording r;
  r.time_s = {0.0, 1.0, 0.5};
  r.channels = {{"truth_x_m", {1.0, 2.0}}, {"truth_y_m", {1.0, std::numeric_limits<double>::infinity(), 2.0}}};
  const std::vector<std::string> problems = problems_in(r);
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_NE(problems[0].find("truth_x_m: found 2 cells"), std::string::npos);
  EXPECT_NE(problems[1].find("infinite value in row 2"), std::string::npos);
  EXPECT_NE(problems[2].find("time going back in row 3"), std::string::npos);
  r.time_s = {0.0, 1.0, 1.0};  // never decreasing is enough
  r.channels.clear();
  EXPECT_TRUE(problems_in(r).empty());
}

TEST(WheelSamples, ComeFromTicksAcrossTheWrapOfTheCounter) {
  DifferentialDrive d;
  d.encoder_counts_per_revolution = 100;
  d.counter_bits = 8;
  Recording r;
  r.time_s = {0, 1, 2, 3};
  r.channels = {{"left_ticks", {250, 4, 20, 250}}, {"right_ticks", {0, 250, 240, 230}}};
  const std::vector<WheelSample> w = wheel_samples(r, d);
  ASSERT_EQ(w.size(), 4u);
  const double count = 2 * kPi / 100;
  EXPECT_NEAR(w[1].left_rad - w[0].left_rad, 10 * count, 1e-12);    // 250 to 256 + 4
  EXPECT_NEAR(w[3].left_rad - w[0].left_rad, 0.0, 1e-12);           // and back again
  EXPECT_NEAR(w[1].right_rad - w[0].right_rad, -6 * count, 1e-12);  // 0 to -6
}

TEST(WheelSamples, AreFilledInWhereTheOtherWheelWasRead) {
  Recording r;
  r.time_s = {0, 1, 2, 3};
  r.channels = {{"left_wheel_rad", {0, kEmpty, 4, kEmpty}}, {"right_wheel_rad", {0, 1, 2, 3}}};
  const std::vector<WheelSample> w = wheel_samples(r, {});
  ASSERT_EQ(w.size(), 3u);  // the last left one is not invented
  EXPECT_NEAR(w[1].left_rad, 2.0, 1e-15);
}

TEST(WheelSamples, AreNoneWhereAWheelIsMissing) {
  Recording r;
  r.time_s = {0};
  r.channels = {{"left_wheel_rad", {0}}, {"right_ticks", {0}}};
  EXPECT_TRUE(wheel_samples(r, {}).empty());
}

TEST(TruthSamples, UnwrapTheirHeadingsAndDoWithoutThem) {
  Recording r;
  r.time_s = {0, 1, 2, 3};
  r.channels = {
      {"truth_x_m", {0, 1, kEmpty, 3}}, {"truth_y_m", {0, 0, 0, 0}}, {"truth_heading_rad", {3.1, kEmpty, 1.0, -3.1}}};
  const std::vector<TruthSample> t = truth_samples(r);
  ASSERT_EQ(t.size(), 3u);
  EXPECT_FALSE(t[1].heading_rad);
  EXPECT_NEAR(*t[2].heading_rad, 2 * kPi - 3.1, 1e-15);
  EXPECT_EQ(truth_track(r).size(), 2u);
}

TEST(CommandSamples, NeedBothOfTheirChannels) {
  Recording r;
  r.time_s = {0, 1};
  r.channels = {{"command_speed_mps", {0.1, 0.2}}, {"command_yaw_rate_radps", {0.0, kEmpty}}};
  EXPECT_EQ(command_samples(r).size(), 1u);
  r.channels.pop_back();
  EXPECT_TRUE(command_samples(r).empty());
}

// A link that was silent for one wheel says nothing of how it went meanwhile; a wheel that is read only as it moves
// does.
TEST(WheelSamples, AreLeftOutWhereNobodyKnowsHowAWheelWent) {
  const auto samples_with = [](bool rests) {
    Recording r;
    r.channels = {{"left_wheel_rad", {}}, {"right_wheel_rad", {}}};
    for (int i = 0; i < 200; ++i) {
      const double t = 0.02 * i, gap_from_s = 1.0, gap_to_s = 3.0;
      const bool is_silent = t > gap_from_s && t < gap_to_s;
      const double turned = !rests ? 5.0 * t : 5.0 * (t < gap_to_s ? std::min(t, gap_from_s) : t - 2.0);
      r.time_s.push_back(t);
      r.channels[0].values.push_back(is_silent ? kEmpty : turned);
      r.channels[1].values.push_back(5.0 * t);
    }
    return wheel_samples(r, {});
  };
  const std::vector<WheelSample> silent = samples_with(false);
  for (const WheelSample& w : silent) EXPECT_FALSE(w.time_s > 1.01 && w.time_s < 2.99) << w.time_s;
  EXPECT_EQ(silent.size(), 101u);
  EXPECT_EQ(samples_with(true).size(), 200u);
}

// Between readings 0.2 s apart a wheel sets off and stops; on a straight line from one to the next it did not go.
TEST(WheelSamples, ComeAsOftenAsTheWheelThatIsReadFarLessOften) {
  Recording r;
  r.channels = {{"left_wheel_rad", {}}, {"right_wheel_rad", {}}};
  for (int i = 0; i <= 100; ++i) {
    r.time_s.push_back(0.02 * i);
    r.channels[0].values.push_back(i % 10 == 0 ? 0.1 * i * i : kEmpty);
    r.channels[1].values.push_back(0.1 * i * i);
  }
  const std::vector<WheelSample> w = wheel_samples(r, {});
  ASSERT_EQ(w.size(), 11u);
  for (const WheelSample& s : w) EXPECT_DOUBLE_EQ(s.left_rad, s.right_rad);
}

}  // namespace
}  // namespace odolab
