#include "core/io/import/sample_streams.h"

#include <cmath>
#include <limits>

#include "core/geometry/angles.h"
#include "core/io/recording_csv.h"
#include "core/recording/clock_jump.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

void add(SampleSpool& spool, std::int64_t ns, double a) { spool.add(ns, &a); }

TEST(SampleStreams, ShareARowWhereTheyShareAStamp) {
  SampleStreams streams;
  SampleSpool& a = streams.add_stream({"left_wheel_rad"});
  SampleSpool& b = streams.add_stream({"truth_x_m"});
  add(a, 5'000'000'000, 1.0);
  add(a, 5'100'000'000, 2.0);
  add(b, 5'100'000'000, 3.0);
  add(b, 4'000'000'000, 4.0);
  const Result<Recording> r = recording_of(streams);
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r->time_s, (std::vector<double>{0.0, 1.0, 1.1}));
  EXPECT_TRUE(std::isnan(r->channel("left_wheel_rad")->values[0]));
  EXPECT_EQ(r->channel("truth_x_m")->values[0], 4.0);
  EXPECT_EQ(r->channel("left_wheel_rad")->values[2], 2.0);
  EXPECT_EQ(r->channel("truth_x_m")->values[2], 3.0);
}

TEST(SampleStreams, SortLateSamplesInAndCountThoseThatComeTooLate) {
  for (const char* where : {"", "."}) {
    SampleSpool spool({"truth_x_m"}, where);
    for (int i = 0; i < 200000; ++i) add(spool, (i % 500 == 499 ? i - 300 : i) * 1000, i);
    add(spool, 5, -1.0);  // 200000 samples late
    ASSERT_TRUE(spool.finish().ok());
    EXPECT_EQ(spool.size(), 200000u);
    EXPECT_EQ(spool.late(), 1u);
    std::int64_t last = -1, ns = 0;
    double value = 0.0, sum = 0.0;
    int n = 0;
    while (spool.next(ns, &value)) {
      ASSERT_GE(ns, last);
      last = ns;
      sum += value;
      ++n;
    }
    EXPECT_EQ(n, 200000);
    EXPECT_EQ(sum, 199999.0 * 100000.0);  // none lost, none twice
  }
}

TEST(SampleStreams, MakeAWrappedAngleContinuousAndLeaveAContinuousOneAlone) {
  for (const bool wrapped_in_file : {true, false}) {
    SampleStreams streams;
    SampleSpool& wheel = streams.add_stream({"left_wheel_rad"});
    wheel.unwrap(0);
    for (int i = 0; i < 100; ++i) add(wheel, i * 1000, wrapped_in_file ? wrapped(-0.5 * i) : -5.0 * i);
    const Result<Recording> r = recording_of(streams);
    ASSERT_TRUE(r.ok());
    for (int i = 0; i < 100; ++i)
      EXPECT_NEAR(r->channels[0].values[static_cast<std::size_t>(i)], wrapped_in_file ? -0.5 * i : -5.0 * i, 1e-12);
    EXPECT_EQ(streams.warnings.size(), wrapped_in_file ? 1u : 0u);
  }
}

TEST(SampleStreams, LeaveOutTimesThatCannotBe) {
  SampleStreams streams;
  SampleSpool& spool = streams.add_stream({"truth_x_m"});
  for (const std::int64_t ns : {std::numeric_limits<std::int64_t>::min(), std::int64_t{5}, std::int64_t{-5},
                                std::numeric_limits<std::int64_t>::max()})
    add(spool, ns, 1.0);
  const Result<Recording> r = recording_of(streams);
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r->time_s, (std::vector<double>{0.0, 1e-8}));
  EXPECT_EQ(streams.warnings, std::vector<std::string>{"2 samples of truth_x_m left out: a time that cannot be"});
}

TEST(SampleStreams, RefuseAClockThatWasSetOnTheWay) {
  for (const bool into_file : {false, true}) {
    ScratchFolder folder;
    SampleStreams streams;
    streams.name = "run.mcap";
    SampleSpool& spool = streams.add_stream({"truth_x_m"});
    for (const std::int64_t ns : {0ll, 50'000'000ll, 1'700'000'000'000'000'000ll}) add(spool, ns, 1.0);
    const std::string out = folder.path("run.csv");
    EXPECT_EQ(into_file ? message_of(write_streams_csv(out, streams), out) : recording_of(streams).error().message(),
              std::string("run.mcap: time_s: found a row 1700000000 s after the one before, which is at 0.05 s, "
                          "expected ") +
                  kRowsOfOneClock);
    EXPECT_EQ(folder.files(), 0u);
  }
}

TEST(SampleStreams, RefuseAValueThatNoRobotHas) {
  SampleStreams streams;
  streams.name = "run.mcap";
  SampleSpool& spool = streams.add_stream({"truth_x_m"});
  for (const std::int64_t ns : {0ll, 50'000'000ll}) add(spool, ns, ns > 0 ? 1e200 : 1.0);
  EXPECT_EQ(recording_of(streams).error().message(),
            "run.mcap: truth_x_m: found 1e+200 at 0.05 s, expected a number from -1e+08 to 1e+08 (m)");
}

TEST(SampleStreams, RefuseTwoSourcesForOneChannel) {
  SampleStreams streams;
  add(streams.add_stream({"truth_x_m"}), 0, 1.0);
  add(streams.add_stream({"truth_x_m"}), 0, 1.0);
  EXPECT_EQ(recording_of(streams).error().message(), ": found two sources for truth_x_m, expected one");
}

}  // namespace
}  // namespace odolab
