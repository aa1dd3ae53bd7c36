#include "core/diagnosis/mismatch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace odolab {
namespace {

// A minute of white residuals at 50 Hz, in all channels of their own size.
Residuals white(std::uint64_t seed) {
  Residuals r;
  r.recording = "run.csv";
  Random random(seed);
  for (int i = 0; i < 3000; ++i) {
    r.time_s.push_back(0.02 * i);
    r.x_m.push_back(0.01 * i);
    r.y_m.push_back(0.0);
    r.along_m.push_back(0.001 * random.normal());
    r.across_m.push_back(0.002 * random.normal());
    r.heading_rad.push_back(0.003 * random.normal());
    r.squared.push_back(1.0);
  }
  return r;
}

TEST(Mismatch, OfNoiseAloneIsAboutOne) {
  const Residuals r = white(1);
  const ResidualSizes sizes = sizes_of(r);
  EXPECT_NEAR(sizes.along_m, 0.001, 1e-4);  // 3000 samples know a size to 2 %, by the median to 3 %
  double sum = 0.0;
  for (double v : times_noise(r, sizes)) sum += v;
  // the larger of two that are each 0.9 in the mean, with a scatter of 0.4
  EXPECT_NEAR(sum / 3000.0, 1.15, 0.15);
}

TEST(Mismatch, ThatKeepsItsDirectionStandsOutThoughItIsUnderTheNoiseOfASample) {
  Residuals r = white(2);
  for (int i = 1000; i < 1050; ++i) r.along_m[std::size_t(i)] += 0.0008;  // one second, 0.8 of the size of a sample
  const std::vector<double> m = times_noise(r, {0.001, 0.002, 0.003});
  // gathered over its 50 samples 0.8 * sqrt(50) = 5.7 in one of three channels: sqrt((32 + 3) / 3) = 3.4
  EXPECT_NEAR(m[1025], 3.4, 1.0);
}

TEST(Mismatch, IsColouredByOneScale) {
  EXPECT_EQ(mismatch_level(0.0), 0);
  EXPECT_EQ(mismatch_level(2.0), 1);
  EXPECT_EQ(mismatch_level(7.9), 3);
  EXPECT_EQ(mismatch_level(1e9), kMismatchLevels - 1);
}

TEST(Mismatch, BeforeAndAfterStandAtTheSameTimes) {
  Diagnosis d;
  d.residuals_before = {white(3)};
  d.residuals_after = {white(4)};
  d.residuals_after[0].time_s.erase(d.residuals_after[0].time_s.begin() + 7);  // one that was set aside then
  for (auto* channel :
       {&d.residuals_after[0].along_m, &d.residuals_after[0].across_m, &d.residuals_after[0].heading_rad,
        &d.residuals_after[0].x_m, &d.residuals_after[0].y_m, &d.residuals_after[0].squared})
    channel->erase(channel->begin() + 7);
  Finding f;
  f.where.time_s = {{1.0, 2.0}};
  f.where.recording = "another.csv";
  d.findings = {f};
  const MismatchOverTime m = mismatch_over_time(d, "run.csv");
  EXPECT_EQ(m.time_s.size(), 3000u);
  EXPECT_EQ(m.after.size(), m.time_s.size());
  EXPECT_GE(m.largest_before(0.0, 60.0), m.largest_before(10.0, 20.0));
  EXPECT_EQ(m.largest_before(70.0, 80.0), 0.0);
  EXPECT_TRUE(located_stretches(d, "run.csv").empty());
  EXPECT_EQ(located_stretches(d, "another.csv").size(), 1u);
  EXPECT_TRUE(mismatch_over_time(d, "no.csv").time_s.empty());
}

TEST(Mismatch, OfAZoneIsLocatedInEveryRunThatPassesItAndThatOfAPushIsNot) {
  Diagnosis d;
  d.residuals_before = {white(6)};  // along x at 0.5 m/s
  Finding f;
  f.effect = "slip_zone";
  f.where.recording = "another.csv";
  f.where.zone = WhereFound::Zone{10.0, 0.0, 1.0};
  d.findings = {f};
  const std::vector<LocatedStretch> passes = located_stretches(d, "run.csv");
  ASSERT_EQ(passes.size(), 1u);
  EXPECT_NEAR(passes[0].from_s, 18.0, 0.021);  // from 9 to 11 m, to a sample
  EXPECT_NEAR(passes[0].to_s, 22.0, 0.021);
  d.findings[0].effect = "collision";
  EXPECT_TRUE(located_stretches(d, "run.csv").empty());
}

// A push at 7.5 to 8 s by the wheels' clock, and residuals at the stamps of a truth whose clock is 1000 s ahead.
Diagnosis pushed_under_another_clock(std::uint64_t seed) {
  Diagnosis d;
  d.residuals_before = {white(seed)};
  for (double& t : d.residuals_before[0].time_s) t += 1000.0;
  d.truth_clock_s = {{"run.csv", 1000.0}};
  Finding f;
  f.effect = "collision";
  f.where.recording = "run.csv";
  f.where.time_s = {{7.5, 8.0}};
  d.findings = {f};
  return d;
}

// Residuals stand at the stamps of a truth whose clock began 1000 s before the wheels', by which findings are told.
TEST(Mismatch, IsLocatedOnTheClockOfItsResiduals) {
  Diagnosis d = pushed_under_another_clock(7);
  const std::vector<LocatedStretch> located = located_stretches(d, "run.csv");
  ASSERT_EQ(located.size(), 1u);
  EXPECT_DOUBLE_EQ(located[0].from_s, 1007.5);
  EXPECT_DOUBLE_EQ(located[0].to_s, 1008.0);
  d.findings[0].effect = "truth_frozen";  // which is told by the truth's own
  EXPECT_DOUBLE_EQ(located_stretches(d, "run.csv")[0].from_s, 7.5);
}

TEST(Mismatch, OfAUnitIsFoundByTheRecording) {
  Diagnosis d;
  d.residuals_before = {white(5)};
  d.residuals_before[0].recording = "run.csv, truck_a";
  EXPECT_FALSE(mismatch_over_time(d, "run.csv").time_s.empty());
}

// And by the unit, which its residuals are named by; they stand at the truth's stamps, too.
TEST(Mismatch, OfAUnitIsLocatedOnTheClockOfItsResiduals) {
  Diagnosis d = pushed_under_another_clock(5);
  d.residuals_before[0].recording = "run.csv, truck_a";
  for (const char* name : {"run.csv", "run.csv, truck_a"}) {
    const std::vector<LocatedStretch> located = located_stretches(d, name);
    ASSERT_EQ(located.size(), 1u) << name;
    EXPECT_DOUBLE_EQ(located[0].from_s, 1007.5) << name;
  }
}

}  // namespace
}  // namespace odolab
