#include "core/diagnosis/encoder_jumps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace odolab {
namespace {

constexpr double kRadius_m = 0.125, kCounts = 2048.0, kCount_rad = 2.0 * M_PI / kCounts, kReading_s = 0.01;

struct Read {
  std::vector<double> time_s, angle_rad;
};

// A wheel at speeds of its own, read in whole counts 100 times a second for four seconds.
Read read(double (*speed_radps)(double)) {
  Read out;
  double angle_rad = 0.0;
  for (int i = 0; i < 400; ++i) {
    out.time_s.push_back(kReading_s * i);
    out.angle_rad.push_back(kCount_rad * std::floor(angle_rad / kCount_rad));
    angle_rad += kReading_s * speed_radps(out.time_s.back());
  }
  return out;
}

TimeStretches jumps_of(const Read& r) { return encoder_jumps(r.time_s, r.angle_rad, kRadius_m, kCount_rad); }

double drives(double time_s) { return 6.0 + 3.0 * std::sin(2.0 * time_s); }

TEST(EncoderJumps, AreFoundWhereCountsAreLostForGoodWithinOneReading) {
  for (double lost_rad : {0.05, 0.12, -0.08}) {
    Read r = read(drives);
    for (std::size_t i = 201; i < r.angle_rad.size(); ++i) r.angle_rad[i] -= lost_rad;
    const TimeStretches jumps = jumps_of(r);
    ASSERT_EQ(jumps.size(), 1u) << lost_rad;
    EXPECT_DOUBLE_EQ(jumps.front().first, r.time_s[200]);
    EXPECT_DOUBLE_EQ(jumps.front().second, r.time_s[201]);
  }
}

TEST(EncoderJumps, AreNotWhereAWheelOnlySetsOffStopsReversesOrRunsEvenly) {
  EXPECT_TRUE(jumps_of(read(drives)).empty());
  EXPECT_TRUE(jumps_of(read([](double t) { return t < 1.0 ? 0.0 : t < 2.0 ? 6.0 : 0.0; })).empty());
  EXPECT_TRUE(jumps_of(read([](double t) { return t < 2.0 ? 6.0 : -6.0; })).empty());
}

TEST(EncoderJumps, AreNotWhereReadingsAreCoarse) {
  Read r = read([](double) { return 1.0; });
  for (double& a : r.angle_rad) a = 0.1 * std::floor(a / 0.1);
  EXPECT_TRUE(encoder_jumps(r.time_s, r.angle_rad, kRadius_m, 0.1).empty());
}

}  // namespace
}  // namespace odolab
