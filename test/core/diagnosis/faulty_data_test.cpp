#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"
#include "test/support/short_cases.h"

namespace odolab::test {
namespace {

TEST(FaultyData, ReportsFrozenTruthAsAFaultOfTheDataAndNotAsPhysics) {
  Case c = generated_case(short_case("", 0.0), 7501);
  Recording& r = c.recordings[1];
  std::vector<double> last(r.channels.size(), 0.0);
  bool any = false;
  for (std::size_t i = 0; i < r.time_s.size(); ++i)
    for (std::size_t k = 2; k < r.channels.size(); ++k) {
      double& v = r.channels[k].values[i];
      if (!std::isfinite(v)) continue;
      if (r.time_s[i] > 12.0 && r.time_s[i] < 13.5) v = last[k], any = true;
      last[k] = v;
    }
  ASSERT_TRUE(any);
  const Diagnosis d = diagnosed(c);
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
  EXPECT_EQ(d.findings[0].effect, "truth_frozen");
  EXPECT_NEAR(d.findings[0].where.time_s.front().first, 12.0, 0.2);
}

TEST(FaultyData, ReportsAnEncoderThatStoodStillAsAFaultOfTheData) {
  Case c = generated_case(short_case("", 0.0), 7502);
  Recording& r = c.recordings[0];
  double held = 0.0, lost = 0.0, before = 0.0, start_s = 0.0;
  // Freeze the left wheel for a second from the first moment after 10 s at which it turns quickly.
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    double& v = r.channels[0].values[i];
    if (!std::isfinite(v)) continue;
    const double true_value = v;
    if (start_s == 0.0 && r.time_s[i] > 10.0 && true_value - before > 0.06) start_s = r.time_s[i], held = before;
    if (start_s > 0.0 && r.time_s[i] < start_s + 1.0) {
      v = held;
      lost = true_value - held;
    } else {
      v = true_value - lost;
    }
    before = true_value;
  }
  ASSERT_GT(start_s, 0.0);
  const Diagnosis d = diagnosed(c);
  EXPECT_TRUE(std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& f) {
    return f.effect == "encoder_data_fault";
  })) << said(d);
  for (const Finding& f : d.findings) EXPECT_TRUE(f.effect == "encoder_data_fault") << f.effect;
}

// Wheels that were not read for a while: their counts go on behind.
void lose_wheels(Recording& r, double from_s, double to_s) {
  for (std::size_t i = 0; i < r.time_s.size(); ++i)
    if (r.time_s[i] > from_s && r.time_s[i] < to_s) r.channels[0].values[i] = r.channels[1].values[i] = std::nan("");
}

void expect_only_faults(const Diagnosis& d) {
  EXPECT_FALSE(d.findings.empty());
  for (const Finding& f : d.findings) EXPECT_EQ(f.effect, "encoder_data_fault") << f.sentence;
}

// Counters go on while nobody reads them: nothing froze and nothing stepped back.
TEST(FaultyData, SaysWhereTheEncodersWereNotReadAndMakesNothingOfIt) {
  for (double lasts_s : {0.5, 4.0}) {
    Case c = generated_case(short_case("", 0.0), 7503);
    const Diagnosis whole = diagnosed(c);
    lose_wheels(c.recordings[1], 12.01, 12.0 + lasts_s);
    const Diagnosis d = diagnosed(c);
    EXPECT_TRUE(d.findings.empty()) << said(d);
    EXPECT_EQ(d.verdict, Verdict::nothing_missing);
    const std::string said_of_it = lasts_s < 1.0 ? "run_1 from 12.0 to 12.5 s: no encoder readings"
                                                 : "run_1 from 12.0 to 16.0 s: no encoder readings";
    EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), [&](const std::string& w) {
      return w.find(said_of_it) != std::string::npos;
    })) << said_of_it;
    // The rest is as good as it was: a thirtieth of the drive is missing at most.
    EXPECT_LT(d.train.calibrated->position_rms_m, 1.15 * whole.train.calibrated->position_rms_m);
    EXPECT_LT(d.calibration.parameters[2].stderr_value, 1.3 * whole.calibration.parameters[2].stderr_value);
  }
}

TEST(FaultyData, LeavesOutACounterThatStartsAgain) {
  Case c = generated_case(short_case("", 0.0), 7504);
  const Diagnosis whole = diagnosed(c);
  Recording& r = c.recordings[1];
  // At the first moment after 15 s at which both wheels have turned far enough for the step to be none of theirs.
  double left_rad = 0.0, right_rad = 0.0;
  bool again = false;
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    double &l = r.channels[0].values[i], &right = r.channels[1].values[i];
    if (!std::isfinite(l)) continue;
    if (!again && r.time_s[i] > 15.0 && std::abs(l) > 5.0 && std::abs(right) > 5.0)
      again = true, left_rad = l, right_rad = right;
    if (again) l -= left_rad, right -= right_rad;
  }
  ASSERT_TRUE(again);
  const Diagnosis d = diagnosed(c);
  expect_only_faults(d);
  EXPECT_LT(d.train.calibrated->position_rms_m, 1.15 * whole.train.calibrated->position_rms_m);
  EXPECT_LT(d.calibration.parameters[2].stderr_value, 1.3 * whole.calibration.parameters[2].stderr_value);
}

TEST(FaultyData, NamesNothingWhereTheTruthReachesBeyondTheWheelsAndItsClockIsLate) {
  CaseSettings settings = short_case("", 0.0);
  settings.truth_late_s = 0.08;
  Case c = generated_case(settings, 7505);
  for (Recording& r : c.recordings) {  // the wheels' log is cut while it drives
    lose_wheels(r, -1.0, 3.0);
    lose_wheels(r, 37.0, 50.0);
  }
  const Diagnosis d = diagnosed(c);
  for (const Finding& f : d.findings) EXPECT_EQ(f.effect, "truth_time_offset") << f.sentence;
  ASSERT_EQ(d.truth_clock_s.size(), 3u);
  for (const auto& [recording, late_s] : d.truth_clock_s) EXPECT_NEAR(late_s, 0.08, 0.002) << recording;
}

// The truth drives on for more than a second after the wheels came to rest, which is known once it is calibrated.
TEST(FaultyData, AreNotWhatAClockDoesThatIsLateByMoreThanASecond) {
  CaseSettings settings;
  settings.truth_late_s = 1.3;
  settings.runs = 3;
  settings.duration_s = 40.0;
  const Case c = generated_case(settings, 2);
  const Diagnosis d = diagnose(c.recordings, {}, c.nominal).value();
  for (const Finding& f : d.findings) EXPECT_NE(f.effect, "encoder_data_fault") << f.sentence;
  EXPECT_TRUE(std::any_of(d.findings.begin(), d.findings.end(),
                          [](const Finding& f) { return f.effect == "truth_time_offset"; }));
}

// Stands for three quarters of a second now and again, and then turns about its right wheel: by a clock that is a
// quarter of a second early the truth does so while both stand.
TEST(FaultyData, AreNotWhatAClockDoesThatIsEarlyByLessThanAWheelRests) {
  GeneratorSettings g = under_motion_capture({0.073, 0.073, 0.47}, 0.0005, 0.25, 0.004, 0.006);
  g.truth.time_offset_s = -0.24;
  g.duration_s = 60.0;
  const auto goes = [](int run) -> SpeedProfile {
    return [run](double t) {
      const double in = std::fmod(t, 5.0), turning = 4.0 + run;
      WheelSpeedsAt w;
      if (in < 2.2)
        w.left_radps = w.right_radps = 5.0;
      else if (in < 2.75)
        w.left_radps = w.right_radps = 1.0;
      else if (in > 3.5) {
        w.left_radps = turning;
        w.right_radps = in > 3.7 ? 0.2 * turning : 0.0;
      }
      return w;
    };
  };
  Random random(12);
  const auto recordings = three_runs(g, random, goes, [](int) { return nullptr; });
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  for (const Finding& f : d.findings) EXPECT_NE(f.effect, "encoder_data_fault") << f.sentence;
}

TEST(FaultyData, RefusesAnUnusableRecordingByName) {
  Case c = generated_case(short_case("", 0.0), 7601);
  c.recordings[1].time_s[5] = -100.0;
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_FALSE(d);
  EXPECT_EQ(d.error().where, "run_1");
}

}  // namespace
}  // namespace odolab::test
