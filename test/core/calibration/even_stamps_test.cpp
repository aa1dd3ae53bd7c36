#include "core/calibration/even_stamps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/calibration/evened_recording.h"
#include "core/calibration/innovations.h"
#include "core/calibration/least_squares.h"
#include "test/support/drive_generator.h"

namespace odolab {
namespace {

using Series = std::vector<double>;

constexpr double kStampPeriod_s = 0.02;
constexpr int kRows = 1500;

double late_s(Random& random, double mean_s) { return -mean_s * std::log(1.0 - random.uniform()); }

// A wheel that speeds up, slows down and turns back: up to 5 rad/s.
double turned_to_and_fro_rad(double t) { return 10.0 * std::sin(0.5 * t) + 0.7 * t; }

double counted_rad(double rad) { return 0.003 * std::floor(rad / 0.003); }

Series evenly() {
  Series taken_s;
  for (int i = 0; i < kRows; ++i) taken_s.push_back(1e6 + kStampPeriod_s * i);  // as a long-running clock counts
  return taken_s;
}

Series read_at(const Series& taken_s) {
  Series rad;
  for (double t : taken_s) rad.push_back(counted_rad(turned_to_and_fro_rad(t - 1e6)));
  return rad;
}

// In order of sending, as a link delivers: none overtakes another.
Series arrived(const Series& taken_s, double mean_s, Random& random) {
  Series stamps;
  for (double t : taken_s) {
    const double s = t + late_s(random, mean_s);
    stamps.push_back(stamps.empty() ? s : std::max(stamps.back() + 1e-4, s));
  }
  return stamps;
}

// Root mean square about the mean of what the stamps are late by.
double unevenness_s(const Series& stamps, const Series& taken_s) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const double late = stamps[i] - taken_s[i];
    sum += late;
    squares += late * late;
  }
  const auto n = static_cast<double>(stamps.size());
  return std::sqrt(squares / n - sum / n * sum / n);
}

// A reading that lies between two marks is rounded up for a while and down later, as it is where sums of decimal
// fractions are rounded.
TEST(EvenStamps, OfAnEvenPeriodThatAreRoundedToHundredthsLieOnOneStraightLine) {
  Series taken_s, stamps;
  for (int i = 0; i < kRows; ++i) {
    taken_s.push_back(0.025 * i);
    const double hundredths = 2.5 * i;
    stamps.push_back(0.01 * (i < kRows / 2 ? std::floor(hundredths + 0.5) : std::ceil(hundredths - 0.5)));
  }
  Series rad;
  for (double t : taken_s) rad.push_back(counted_rad(turned_to_and_fro_rad(t)));
  const std::optional<EvenStamps> even = even_stamps(stamps, {rad});
  ASSERT_TRUE(even);
  EXPECT_LT(unevenness_s(even->time_s, taken_s), 1e-5);
}

// Of twenty rows at 150 Hz none lasts as long as they do, but 0.13 or 0.14 s.
TEST(EvenStamps, OfAPeriodShorterThanWhatTheyAreRoundedToLieOnOneStraightLine) {
  for (const double rate_hz : {120.0, 150.0, 240.0}) {
    Series taken_s, stamps, rad;
    for (int i = 0; i < 60.0 * rate_hz; ++i) {
      taken_s.push_back(1e6 + i / rate_hz);
      stamps.push_back(1e6 + 0.01 * std::round(100.0 * (taken_s.back() - 1e6)));
      rad.push_back(turned_to_and_fro_rad(i / rate_hz));
    }
    const auto even = even_stamps(stamps, {rad, rad}, true);
    ASSERT_TRUE(even) << rate_hz;
    EXPECT_NEAR(even->period_s * rate_hz, 1.0, 1e-4);
    EXPECT_LT(unevenness_s(even->time_s, taken_s), 0.0003) << rate_hz;  // of the 3 ms that rounding leaves
  }
}

TEST(EvenStamps, ReadingsThatArriveLateAreGivenTheirEvenTimesBack) {
  Random random(1);
  const Series taken = evenly(), rad = read_at(taken), stamps = arrived(taken, 0.004, random);
  const auto even = even_stamps(stamps, {rad, rad});
  ASSERT_TRUE(even);
  // The lateness of 4 ms is averaged over five seconds, 250 rows, twice as badly at a line's ends: 0.25 to 0.5 ms.
  EXPECT_LT(unevenness_s(even->time_s, taken), 0.0005);
  EXPECT_NEAR(even->trembling_s, unevenness_s(stamps, taken), 0.0003);  // less what the line followed
  EXPECT_NEAR(even->period_s, kStampPeriod_s, 1e-4);  // lateness over the root of 1500 rows and 20 rows apart
}

// Over a link that holds readings up for more than one of them: each has the time that its number says, though its
// stamp tells of none.
TEST(EvenStamps, ThatTrembleByMoreThanAPeriodAreGivenTheirEvenTimesBack) {
  Random random(11);
  const Series taken = evenly(), rad = read_at(taken);
  Series stamps;
  for (double t : taken) {
    const double s = t + 1.2 * kStampPeriod_s * random.normal();
    stamps.push_back(stamps.empty() ? s : std::max(stamps.back(), s));
  }
  const auto even = even_stamps(stamps, {rad, rad});
  ASSERT_TRUE(even);
  // 24 ms averaged over five seconds, as above: 1.5 to 3 ms.
  EXPECT_LT(unevenness_s(even->time_s, taken), 0.003);
}

TEST(EvenStamps, TrueStampsOfUnevenSamplingAreBelieved) {
  Random random(2);
  Series taken;
  for (double t : evenly()) taken.push_back(t + 0.004 * random.normal());
  std::sort(taken.begin(), taken.end());
  EXPECT_FALSE(even_stamps(taken, {read_at(taken), read_at(taken)}));

  // A loop that waits a period and then needs its time.
  Series waited{1e6};
  while (waited.size() < kRows) waited.push_back(waited.back() + kStampPeriod_s + late_s(random, 0.003));
  EXPECT_FALSE(even_stamps(waited, {read_at(waited), read_at(waited)}));

  // An encoder that speaks at each of its counts: its rows are even in angle, not in time.
  Series spoken, counts;
  for (double t = 0.0, last = 0.0; t < 10.0; t += 1e-4)
    if (const double now = std::floor(turned_to_and_fro_rad(t) / 0.1); now != last) {
      last = now;
      spoken.push_back(t);
      counts.push_back(0.1 * now);
    }
  ASSERT_GT(spoken.size(), 200u);
  EXPECT_FALSE(even_stamps(spoken, {counts, counts}));
}

TEST(EvenStamps, EvenOnesAndThoseOfAWheelAtRestStayAsTheyAre) {
  Random random(3);
  const Series taken = evenly();
  EXPECT_FALSE(even_stamps(taken, {read_at(taken), read_at(taken)}));
  const Series rest(taken.size(), 0.3);
  EXPECT_FALSE(even_stamps(arrived(taken, 0.004, random), {rest, rest}));  // nothing tells
}

TEST(EvenStamps, OneWheelAgainstTheOtherDecidesNothing) {
  Random random(4);
  const Series taken = evenly(), stamps = arrived(taken, 0.004, random);
  EXPECT_FALSE(even_stamps(stamps, {read_at(taken), read_at(stamps)}));
}

TEST(EvenStamps, PacketsOfFiveAreSpreadOut) {
  const Series taken = evenly(), rad = read_at(taken);
  Series stamps;
  for (std::size_t i = 0; i < taken.size(); ++i) stamps.push_back(taken[i / 5 * 5 + 4]);
  const auto even = even_stamps(stamps, {rad, rad});
  ASSERT_TRUE(even);
  // Packets are whole: a line through them errs at its ends by a part of a packet's length.
  EXPECT_LT(unevenness_s(even->time_s, taken), 0.002);
}

// Stamps of a clock that ticks every 0.129 s, six or seven rows each, and trembles a little.
TEST(EvenStamps, OfAClockThatTicksMoreSlowlyThanRowsAreTakenAreSpreadOut) {
  constexpr double kTick_s = 0.129;
  Random random(6);
  const Series taken = evenly(), rad = read_at(taken);
  Series stamps;
  for (const double t : taken) {
    const double s = kTick_s * std::floor(t / kTick_s) + 3e-5 * random.uniform();
    stamps.push_back(stamps.empty() ? s : std::max(stamps.back(), s));
  }
  const auto even = even_stamps(stamps, {rad, rad});
  ASSERT_TRUE(even);
  // A tick's 37 ms are averaged over five seconds, 39 ticks, twice as badly at a line's ends: 6 to 12 ms at most.
  EXPECT_LT(unevenness_s(even->time_s, taken), 0.006);
  EXPECT_NEAR(even->trembling_s, kTick_s / std::sqrt(12.0), 0.004);
}

TEST(EvenStamps, MissingRowsAndPausesLeaveTheirGap) {
  Random random(5);
  Series taken;
  const Series all = evenly();
  for (int i = 0; i < kRows; ++i)
    if (i != 400 && i != 401 && !(i > 800 && i < 900)) taken.push_back(all[i]);
  const Series stamps = arrived(taken, 0.004, random);
  const auto even = even_stamps(stamps, {read_at(taken), read_at(taken)});
  ASSERT_TRUE(even);
  EXPECT_LT(unevenness_s(even->time_s, taken), 0.0008);  // as above, with more ends
}

// One row in thirty, so that a second one is often missing within those by which the first is seen: the readings behind
// it were a period too early.
TEST(EvenStamps, RowsThatAreOftenMissingLeaveTheirGapWhereStampsTrembleLittle) {
  for (const double trembles_s : {0.001, 0.003}) {  // of the latter one gap in fifty is half a period too long
    Random random(8);
    Series taken;
    for (double t : evenly())
      if (taken.empty() || random.uniform() > 1.0 / 30.0) taken.push_back(t);
    Series stamps;
    for (double t : taken) stamps.push_back(t + trembles_s * random.normal());
    const auto even = even_stamps(stamps, {read_at(taken), read_at(taken)});
    ASSERT_TRUE(even);
    EXPECT_LT(unevenness_s(even->time_s, taken), 0.25 * trembles_s);
    for (std::size_t i = 0; i < taken.size(); ++i) EXPECT_NEAR(even->time_s[i], taken[i], 0.1 * kStampPeriod_s) << i;
  }
}

// Each row arrives on its own, the later the rarer (Erlang's distribution of four): now and then some come late one
// behind another, the latest by half a period, and none is missing. One had been counted in ten thousand rows, and ten
// seconds of readings lay up to half a period beside where they were taken: a push of four millimetres.
TEST(EvenStamps, RowsThatComeLateOneBehindAnotherLeaveNoGap) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    Random random(seed);
    Series taken, stamps;
    for (int i = 0; i < 20000; ++i) {
      taken.push_back(1e6 + kStampPeriod_s * i);
      double late = 0.0;
      for (int k = 0; k < 4; ++k) late += late_s(random, 0.07 * kStampPeriod_s);
      stamps.push_back(std::max(stamps.empty() ? 0.0 : stamps.back() + 1e-4, taken.back() + late));
    }
    const auto even = even_stamps(stamps, {read_at(taken), read_at(taken)});
    ASSERT_TRUE(even);
    // 2.8 ms of lateness over 250 rows from knot to knot: 0.2 ms, and at an end twice that.
    for (std::size_t i = 0; i < taken.size(); ++i)
      ASSERT_NEAR(even->time_s[i], taken[i] + 0.28 * kStampPeriod_s, 0.05 * kStampPeriod_s) << i << " of " << seed;
  }
}

// Each stamp may be its own row's or the next, but a row that is missing is a step of all behind it. Unseen, one in
// eighty had made a period 0.8 % too long, and wheels 12 % too large.
TEST(EvenStamps, MissingRowsLeaveTheirGapWhereStampsTrembleByAThirdOfAPeriod) {
  Random random(12);
  Series taken, stamps;
  for (const double t : evenly()) {
    if (random.uniform() < 0.0125) continue;
    taken.push_back(t);
    const double s = t + 0.36 * kStampPeriod_s * random.normal();
    stamps.push_back(stamps.empty() ? s : std::max(stamps.back(), s));
  }
  const Series rad = read_at(taken);
  const auto even = even_stamps(stamps, {rad, rad});
  ASSERT_TRUE(even);
  EXPECT_NEAR(even->period_s, kStampPeriod_s, 1e-5);
  // 7 ms averaged over five seconds, and where a row is missing a few stamps on the wrong side of it.
  EXPECT_LT(unevenness_s(even->time_s, taken), 0.1 * kStampPeriod_s);
}

// As above, the rare late ones by more than a period, and one row in a hundred missing: what rows tremble by was taken
// from their middle half, no period explained the rest, and missing rows had made it 0.5 % too long. Or one in three
// hundred: the period was right at once, and so nothing spoke for them.
TEST(EvenStamps, MissingRowsLeaveTheirGapWhereStampsComeLateNowAndThen) {
  for (const double missing : {0.01, 0.003}) {
    Random random(13);
    Series taken, stamps;
    for (int i = 0; i < 4000; ++i) {
      if (random.uniform() < missing) continue;
      taken.push_back(1e6 + kStampPeriod_s * i);
      double late = 0.0;
      for (int k = 0; k < 4; ++k) late += late_s(random, 0.14 * kStampPeriod_s);
      stamps.push_back(std::max(stamps.empty() ? 0.0 : stamps.back(), taken.back() + late));
    }
    const auto even = even_stamps(stamps, {read_at(taken), read_at(taken)});
    ASSERT_TRUE(even);
    EXPECT_NEAR(even->period_s, kStampPeriod_s, 1e-5) << missing;
    EXPECT_LT(unevenness_s(even->time_s, taken), 0.1 * kStampPeriod_s) << missing;
  }
}

TEST(EvenStamps, ATruthIsJudgedByItsOwnPath) {
  Random random(6);
  const Series taken = evenly(), stamps = arrived(taken, 0.006, random);
  Series x, y;
  for (double t : taken) {  // a circle of a metre at 0.5 m/s, seen to a millimetre
    x.push_back(std::cos(0.5 * (t - 1e6)) + 0.001 * random.normal());
    y.push_back(std::sin(0.5 * (t - 1e6)) + 0.001 * random.normal());
  }
  const auto even = even_stamps(stamps, {x, y}, true);
  ASSERT_TRUE(even);
  EXPECT_LT(unevenness_s(even->time_s, taken), 0.0008);  // 6 ms where 4 gave 0.5
  x.clear();
  y.clear();
  for (double t : stamps) {
    x.push_back(std::cos(0.5 * (t - 1e6)) + 0.001 * random.normal());
    y.push_back(std::sin(0.5 * (t - 1e6)) + 0.001 * random.normal());
  }
  EXPECT_FALSE(even_stamps(stamps, {x, y}, true));
}

// A drive with turns both ways, whose encoder rows are stamped where they arrive.
Recording stamped_at_arrival(const test::GeneratorSettings& g, bool encoders, double mean_s, Random& random) {
  const Recording made = test::generated(
      g,
      [](double t) {
        return test::WheelSpeedsAt{6.0 + 3.0 * std::sin(t), 6.0 - 3.0 * std::sin(0.7 * t)};
      },
      random);
  const Channel* wheel = made.channel("left_ticks") ? made.channel("left_ticks") : made.channel("left_wheel_rad");
  std::vector<std::pair<double, std::size_t>> rows;
  double last = -1e9;
  for (std::size_t i = 0; i < made.time_s.size(); ++i) {
    double t = made.time_s[i];
    if (std::isnan(wheel->values[i]) != encoders) last = t = std::max(last + 1e-4, t + late_s(random, mean_s));
    rows.emplace_back(t, i);
  }
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Recording out{"run_2", "simulated", {}, {}};
  for (const auto& row : rows) out.time_s.push_back(row.first);
  for (const Channel& c : made.channels) {
    Channel& to = out.add_channel(c.name);
    for (std::size_t k = 0; k < rows.size(); ++k) to.values[k] = c.values[rows[k].second];
  }
  return out;
}

test::GeneratorSettings seen_at_100_hz() {
  test::GeneratorSettings g;
  g.drive.wheel_radius_left_m = 0.0755;
  g.truth_period_s = 0.01;
  g.truth_position_noise_m = 0.0005;
  g.truth_heading_noise_rad = 0.001;
  g.wheel_noise = 0.0002;
  g.duration_s = 25.0;
  return g;
}

TEST(EvenedRecording, CalibrationOfReadingsThatArriveLateHoldsTheTrueValues) {
  for (const bool encoders : {true, false}) {
    Random random(7);
    const test::GeneratorSettings g = seen_at_100_hz();
    const Recording late = stamped_at_arrival(g, encoders, 0.005, random);
    const auto found = calibrate_least_squares({late}, Vehicle{"LabMate", DifferentialDrive{}, {}});
    ASSERT_TRUE(found);
    const DifferentialDrive drive = std::get<DifferentialDrive>(found->vehicle.kind);
    // Half a millimetre of truth over some ten metres knows a radius to 1e-4 of it; without evening the encoders'
    // lateness made the radii 7.6 % too large.
    EXPECT_NEAR(drive.wheel_radius_left_m, g.drive.wheel_radius_left_m, 3e-4 * g.drive.wheel_radius_left_m);
    EXPECT_NEAR(drive.wheel_radius_right_m, g.drive.wheel_radius_right_m, 3e-4 * g.drive.wheel_radius_right_m);
    EXPECT_NEAR(drive.wheelbase_m, g.drive.wheelbase_m, 2e-3 * g.drive.wheelbase_m);
    ASSERT_FALSE(found->warnings.empty());
    EXPECT_EQ(found->warnings.front().rfind(
                  encoders ? "run_2: its encoder stamps tremble by" : "run_2: its truth stamps tremble by", 0),
              0u)
        << found->warnings.front();
  }
}

// A reading that is missing, and the next row written twice: put between its neighbours the second of both would say
// that the wheels jumped.
TEST(EvenedRecording, ReadsARowThatStandsThereTwiceOnce) {
  const test::GeneratorSettings g = seen_at_100_hz();
  Random random(9);
  const Recording once = test::generated(
      g,
      [](double t) {
        return test::WheelSpeedsAt{6.0 + 3.0 * std::sin(t), 6.0 - 3.0 * std::sin(0.7 * t)};
      },
      random);
  Recording twice = once;
  const std::size_t missing = once.time_s.size() / 2, doubled = missing + 1;
  const auto lose_and_double = [&](std::vector<double>& v) {
    v.insert(v.begin() + static_cast<std::ptrdiff_t>(doubled), v[doubled]);
    v.erase(v.begin() + static_cast<std::ptrdiff_t>(missing));
  };
  lose_and_double(twice.time_s);
  for (Channel& c : twice.channels) lose_and_double(c.values);
  const auto even = evened(twice, g.drive);
  ASSERT_TRUE(even);
  EXPECT_NE(even->said.front().find("1 of its rows are written twice"), std::string::npos) << even->said.front();
  EXPECT_EQ(even->recording.time_s.size(), once.time_s.size() - 1);
  for (std::size_t i = 1; i < even->recording.time_s.size(); ++i)
    EXPECT_GT(even->recording.time_s[i], even->recording.time_s[i - 1]);
}

// 200 readings a second, stamped to a hundredth of one: each stamp stands there twice, and while the wheels are slow or
// rest so does what was read.
TEST(EvenedRecording, KeepsReadingsOfSlowWheelsWhoseStampsAreRounded) {
  const double counts = 2500.0, count_rad = 2.0 * kPi / counts;
  Recording r;
  r.channels = {{"left_wheel_rad", {}}, {"right_wheel_rad", {}}};
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.005 * i, turned = t < 10.0 ? 0.0 : 0.25 * (t - 10.0) * (t - 10.0);
    r.time_s.push_back(0.01 * std::floor(0.5 * i));
    r.channels[0].values.push_back(count_rad * std::floor(turned / count_rad));
    r.channels[1].values.push_back(count_rad * std::floor(1.1 * turned / count_rad));
  }
  const auto even = evened(r, DifferentialDrive{});
  ASSERT_TRUE(even);
  ASSERT_EQ(even->recording.time_s.size(), r.time_s.size());
  for (std::size_t i = 1; i < r.time_s.size(); ++i)
    EXPECT_NEAR(even->recording.time_s[i] - even->recording.time_s[i - 1], 0.005, 0.001) << i;
}

TEST(EvenedRecording, IsNotEvenedAgainAndKeepsEveryReading) {
  Random random(8);
  const test::GeneratorSettings g = seen_at_100_hz();
  const Recording late = stamped_at_arrival(g, true, 0.004, random);
  const auto even = evened(late, g.drive);
  ASSERT_TRUE(even);
  EXPECT_TRUE(problems_in(even->recording).empty());
  EXPECT_FALSE(evened(even->recording, g.drive));
  EXPECT_EQ(wheel_samples(even->recording, g.drive).size(), wheel_samples(late, g.drive).size());
  EXPECT_EQ(truth_samples(even->recording).size(), truth_samples(late).size());
}

}  // namespace
}  // namespace odolab
