#include "core/calibration/left_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/calibration/least_squares.h"
#include "core/calibration/restamped.h"
#include "test/support/drive_generator.h"

namespace odolab {
namespace {

// Even readings of wheels at 2 and 3 rad/s.
std::vector<WheelSample> even_readings(int count, double period_s) {
  std::vector<WheelSample> readings;
  for (int i = 0; i < count; ++i) readings.push_back({i * period_s, 2.0 * i * period_s, 3.0 * i * period_s});
  return readings;
}

void drop(std::vector<WheelSample>& readings, double from_s, double to_s) {
  readings.erase(std::remove_if(readings.begin(), readings.end(),
                                [&](const WheelSample& w) { return w.time_s > from_s && w.time_s < to_s; }),
                 readings.end());
}

test::GeneratorSettings settings() {
  test::GeneratorSettings g;
  g.drive.wheel_radius_right_m = 0.0755;
  g.duration_s = 40.0;
  g.wheel_noise = 0.001;
  g.truth_position_noise_m = 0.001;
  g.truth_heading_noise_rad = 0.002;
  return g;
}

void forget_wheels(Recording& r, double from_s, double to_s) {
  for (std::size_t i = 0; i < r.time_s.size(); ++i)
    if (r.time_s[i] > from_s && r.time_s[i] < to_s) r.channels[0].values[i] = r.channels[1].values[i] = std::nan("");
}

TEST(EncoderGaps, AreLongIntervalsInWhichTheWheelsTurned) {
  std::vector<WheelSample> readings = even_readings(500, 0.02);
  EXPECT_TRUE(encoder_gaps(readings).empty());
  drop(readings, 3.99, 4.51);
  drop(readings, 6.0, 6.1);  // shorter than a fifth of a second
  const TimeStretches gaps = encoder_gaps(readings);
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_NEAR(gaps[0].first, 3.98, 1e-9);
  EXPECT_NEAR(gaps[0].second, 4.52, 1e-9);
}

// What a wheel does in three tenths of a second no cubic knows: it had been a push of a millimetre.
TEST(EncoderGaps, AreTwoReadingsThatAreMissingWhereTheyComeTenTimesASecond) {
  std::vector<WheelSample> readings = even_readings(100, 0.1);
  drop(readings, 3.05, 3.15);  // one: as a reading that comes late
  drop(readings, 5.05, 5.25);
  const TimeStretches gaps = encoder_gaps(readings);
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_NEAR(gaps[0].first, 5.0, 1e-9);
  EXPECT_NEAR(gaps[0].second, 5.3, 1e-9);
}

TEST(EncoderGaps, AreNotWhereALogOnlyHasWhatChanges) {
  std::vector<WheelSample> readings = even_readings(500, 0.02);
  for (WheelSample& w : readings)
    if (w.time_s > 5.0) w.time_s += 3.0;  // it rests for three seconds, and the next row is the first that moved
  EXPECT_TRUE(encoder_gaps(readings).empty());
}

TEST(Bridged, ReadingsGoOnAcrossACounterThatStartsAgain) {
  const std::vector<WheelSample> whole = even_readings(500, 0.02);
  std::vector<WheelSample> readings = whole;
  for (WheelSample& w : readings)
    if (w.time_s > 5.0) w.right_rad -= 15.0;
  const double count_rad = 0.001;
  const std::vector<WheelSample> mended = bridged(readings, {{readings[250].time_s, readings[251].time_s}}, count_rad);
  ASSERT_EQ(mended.size(), whole.size());
  // To the count that a jump is rounded to.
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_NEAR(mended[i].right_rad, whole[i].right_rad, count_rad);
}

TEST(Bridged, ReadingsWithinAreGoneAndCountsThatGoOnAreKept) {
  std::vector<WheelSample> readings = even_readings(500, 0.02);
  for (WheelSample& w : readings)
    if (w.time_s > 5.01 && w.time_s < 6.99) w.left_rad = 10.0;  // holds for two seconds and catches up
  const std::vector<WheelSample> mended = bridged(readings, {{readings[250].time_s, readings[350].time_s}}, 0.001);
  EXPECT_EQ(mended.size(), readings.size() - 99);
  EXPECT_EQ(mended.back().left_rad, readings.back().left_rad);
}

TEST(LeftOut, NoInnovationKnowsOfWhatTheWheelsDidWithin) {
  Random random(11);
  Recording r = generated(settings(), test::rich_driving, random);
  forget_wheels(r, 12.9, 13.5);
  const TimeStretches gaps = encoder_gaps(wheel_samples(r, DifferentialDrive{}));
  ASSERT_EQ(gaps.size(), 1u);
  const InnovationRun run = innovation_run(r, Vehicle{}, gaps).value();
  InnovationModel m;
  m.drive = settings().drive;
  m.noise = {0.001, 0.001, 0.002};
  // Another way across the gap, and nothing else is another.
  InnovationRun other = run;
  for (WheelSample& w : other.wheels)
    if (w.time_s > 13.2) w.left_rad += 1.0;
  const InnovationSums a = filtered(run, summed_up(run, m), m), b = filtered(other, summed_up(other, m), m);
  EXPECT_LT(a.scalars, static_cast<int>(3 * (run.truth.size() - 1)));
  EXPECT_EQ(a.scalars, b.scalars);
  EXPECT_NEAR(a.chi2, b.chi2, 1e-6 * a.chi2);  // rounding of other angles
  // Normal innovations of so many numbers scatter by 1.9 %; three times that.
  EXPECT_NEAR(a.chi2 / a.scalars, 1.0, 3.0 * std::sqrt(2.0 / a.scalars));
}

TEST(LeftOut, CalibrationIsAsGoodAsWithoutAGap) {
  std::vector<Recording> whole, with_gap;
  for (int k = 0; k < 2; ++k) {
    Random random(20 + static_cast<std::uint64_t>(k));
    whole.push_back(generated(settings(), test::rich_driving, random));
    with_gap.push_back(whole.back());
  }
  forget_wheels(with_gap[1], 9.0, 11.5);  // an arc, a rest and a turn on the spot
  const auto a = calibrate_least_squares(whole, Vehicle{}), b = calibrate_least_squares(with_gap, Vehicle{});
  ASSERT_TRUE(a && b);
  for (int k = 0; k < 3; ++k) {
    const ParameterEstimate &p = a->parameters[static_cast<std::size_t>(k)],
                            &q = b->parameters[static_cast<std::size_t>(k)];
    EXPECT_NEAR(q.value, p.value, 3.0 * p.stderr_value) << p.name;
    // A thirtieth of the drive is missing, of the turning a sixth perhaps.
    EXPECT_LT(q.stderr_value, 1.3 * p.stderr_value) << p.name;
  }
  // The gap was no noise: where it was a straight chord the wheels' noise came out many times larger.
  EXPECT_NEAR(b->noise.wheel_m_per_sqrt_m, a->noise.wheel_m_per_sqrt_m, 0.2 * a->noise.wheel_m_per_sqrt_m);
  EXPECT_EQ(b->outliers, a->outliers);
}

TEST(LeftOut, TruthBeyondTheWheelsIsNotUsedOnceItsClockIsKnown) {
  test::GeneratorSettings g = settings();
  g.truth.time_offset_s = 0.08;
  Random random(31);
  Recording r = generated(g, test::rich_driving, random);
  forget_wheels(r, -1.0, 1.0);  // the log of the wheels begins while it speeds up, and ends while it turns
  forget_wheels(r, 38.9, 50.0);
  InnovationRun run = innovation_run(r, Vehicle{}).value();
  const auto used_from_to = [&] {
    std::pair<double, double> times{1e9, -1e9};
    for (std::size_t k = 1; k < run.truth.size(); ++k) {
      if (is_cut(run, k)) continue;
      times.first = std::min(times.first, run.truth[k - 1].time_s);
      times.second = std::max(times.second, run.truth[k].time_s);
    }
    return times;
  };
  EXPECT_LT(used_from_to().first, 1.08);
  cut_where_left_out(run, 0.08);
  const double tenth_s = 0.1 * g.wheel_period_s + 1e-9;
  EXPECT_GE(used_from_to().first - 0.08, run.wheels.front().time_s - tenth_s);
  EXPECT_LE(used_from_to().second - 0.08, run.wheels.back().time_s + tenth_s);
}

// Ten minutes at a clock that is fast by 0.3 %: what is left out at 500 s of it is past for the truth after 498.5 s.
TEST(LeftOut, IsCutByTheWheelsOwnClock) {
  InnovationRun run;
  run.wheels = even_readings(30000, 0.02);
  run.left_out = {{500.0, 502.0}};
  for (int k = 0; k <= 1180; ++k) run.truth.push_back({0.5 * k, {}, 0.0});
  cut_where_left_out(run, 0.0, 0.003);
  std::pair<double, double> cut{1e9, -1e9};  // the truth's stamps on either side
  for (std::size_t k = 1; k < run.truth.size(); ++k)
    if (run.cut[k]) cut = {std::min(cut.first, run.truth[k - 1].time_s), std::max(cut.second, run.truth[k].time_s)};
  EXPECT_EQ(cut.first, 498.5);   // the last before 500 / 1.003 = 498.50 s
  EXPECT_EQ(cut.second, 500.5);  // the first behind 502 / 1.003 = 500.50 s
  const TwoClocks clocks{7.0, 0.2, 0.003};
  EXPECT_NEAR(clocks.truth_stamp_s(clocks.wheels_stamp_s(321.0)), 321.0, 1e-9);
}

TEST(LeftOut, WheelsAtRestGoOnRestingForOneInterval) {
  InnovationRun run;
  run.wheels = even_readings(100, 0.02);
  for (WheelSample& w : run.wheels) w.left_rad = std::min(w.left_rad, 3.0), w.right_rad = std::min(w.right_rad, 4.5);
  for (double t : {0.0, 1.0, 1.98, 1.995, 2.005}) run.truth.push_back({t, {}, 0.0});
  cut_where_left_out(run, 0.0);
  EXPECT_EQ(run.cut, (std::vector<char>{0, 0, 0, 0, 1}));
}

}  // namespace
}  // namespace odolab
