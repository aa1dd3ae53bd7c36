#include "core/diagnosis/generic/late_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

// Stamps that lag behind by `late_s` of the time.
void delay(Recording& r, const std::function<double(double time_s)>& late_s) {
  const auto channel = [&](const char* name) {
    return &std::find_if(r.channels.begin(), r.channels.end(), [&](const Channel& c) {
              return c.name == name;
            })->values;
  };
  for (const char* name : {"truth_x_m", "truth_y_m", "truth_heading_rad"}) {
    std::vector<double>& values = *channel(name);
    std::vector<double> times, known;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::isfinite(values[i])) times.push_back(r.time_s[i]), known.push_back(values[i]);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) continue;
      const double at_s = r.time_s[i] - late_s(r.time_s[i]);
      const auto next = static_cast<std::size_t>(
          std::clamp<std::ptrdiff_t>(std::lower_bound(times.begin(), times.end(), at_s) - times.begin(), 1,
                                     static_cast<std::ptrdiff_t>(times.size()) - 1));
      const double share = (at_s - times[next - 1]) / (times[next] - times[next - 1]);
      values[i] = known[next - 1] + share * (known[next] - known[next - 1]);
    }
  }
}

test::Case calm_case(std::uint64_t seed) {
  test::CaseSettings settings;
  settings.runs = 3;
  settings.duration_s = 60.0;
  return test::generated_case(settings, seed);
}

// A link that buffers more and more, and is emptied in the middle of each recording: no clock's rate.
TEST(TruthLateByMore, ShowsALinkThatBuffersAndIsEmptied) {
  test::Case c = calm_case(21);
  for (Recording& r : c.recordings) delay(r, [](double t) { return 0.001 * std::fmod(t, 30.0); });
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  const auto drawn = std::find_if(d->responses.begin(), d->responses.end(), [](const Response& r) {
    return r.channel == "truth late by [s]" && r.variable == "time since the start [s]";
  });
  ASSERT_NE(drawn, d->responses.end());
  // Of 30 ms that it grows by before it is emptied, hats that are eight seconds apart show two thirds and more.
  EXPECT_GT(drawn->value[3] - drawn->value[0], 0.012);
  EXPECT_GT(drawn->value[3] - drawn->value[4], 0.006);
}

// Clocks that are set anew once in each recording, by as much to and fro, at other times.
TEST(TruthLateByMore, ShowsClocksThatAreSetAnewAtOtherTimesInEachRecording) {
  test::Case c = calm_case(22);
  double at_s = 15.0, by_s = 0.02;
  for (Recording& r : c.recordings) {
    delay(r, [=](double t) { return by_s * std::clamp((t - at_s) / 2.0, 0.0, 1.0); });
    at_s += 14.0, by_s = -by_s;
  }
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  ASSERT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_NE(d->findings.front().where.regime.find("truth late by"), std::string::npos)
      << d->findings.front().where.regime;
  EXPECT_NE(d->findings.front().where.regime.find("in each recording"), std::string::npos)
      << d->findings.front().where.regime;
}

// All of them forward: the mean of a step is a rate, and what is left of it is not.
TEST(TruthLateByMore, HasNoRateBesideItWhereClocksAreSetAnew) {
  test::Case c = calm_case(23);
  double at_s = 18.0;
  for (Recording& r : c.recordings) {
    delay(r, [=](double t) { return t > at_s ? 0.1 : 0.0; });
    at_s += 12.0;
  }
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_EQ(d->findings.front().component, "truth");
  for (const Finding& f : d->findings) EXPECT_NE(f.effect, "clock_rate");
}

}  // namespace
}  // namespace odolab
