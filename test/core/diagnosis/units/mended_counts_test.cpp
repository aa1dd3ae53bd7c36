#include "core/diagnosis/units/mended_counts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/calibration/evened_recording.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/outside_truth.h"
#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

TEST(MendedCounts, GoEvenlyWhereACountHeldAndCaughtUp) {
  const MultiCastor platform = three_castor_vehicle();
  Recording run = castor_run(platform, {}, 341);
  const std::vector<UnitSample> true_samples = unit_samples(run, vehicle_of(platform));
  for (Channel& c : run.channels)
    if (c.name == "castor2_left_wheel_rad") std::fill(c.values.begin() + 400, c.values.begin() + 410, c.values[400]);
  const std::vector<UnitSample> mended =
      with_mended_counts(unit_samples(run, vehicle_of(platform)), vehicle_of(platform)).samples;
  // 0.4 s at an even pace but for what it gains or loses meanwhile: a tenth of the way, where the count stood.
  const double way = std::abs(true_samples[410].wheels[1].left_rad - true_samples[400].wheels[1].left_rad);
  ASSERT_GT(way, 0.5);
  for (std::size_t i = 395; i < 415; ++i)
    EXPECT_NEAR(mended[i].wheels[1].left_rad, true_samples[i].wheels[1].left_rad, 0.1 * way) << i;
  EXPECT_EQ(mended[405].wheels[1].right_rad, true_samples[405].wheels[1].right_rad);
}

TEST(MendedCounts, GoOnFromThereWhereACountMovedAloneAtRest) {
  const MultiCastor platform = three_castor_vehicle();
  Recording run = castor_run(platform, {}, 341);
  // Then all stand for a second, in which one count steps back.
  constexpr std::size_t kRest = 25, kStep = 12;
  constexpr double kBack_rad = 0.5;
  const std::size_t end = run.time_s.size();
  const double period_s = run.time_s[end - 1] - run.time_s[end - 2];
  for (std::size_t i = 1; i <= kRest; ++i)
    run.time_s.push_back(run.time_s[end - 1] + period_s * static_cast<double>(i));
  for (Channel& c : run.channels) c.values.resize(end + kRest, c.values[end - 1]);
  const double stood_rad = run.channel("castor2_left_wheel_rad")->values.back();
  for (Channel& c : run.channels)
    if (c.name == "castor2_left_wheel_rad")
      for (std::size_t i = end + kStep; i < end + kRest; ++i) c.values[i] -= kBack_rad;
  const std::vector<UnitSample> mended =
      with_mended_counts(unit_samples(run, vehicle_of(platform)), vehicle_of(platform)).samples;
  EXPECT_NEAR(mended.back().wheels[1].left_rad, stood_rad, 1e-12);
}

// Read 20 times a second: a castor that swings round by 2.4 rad in 0.4 s, as where its vehicle reverses, and one that
// turns evenly by 0.3 rad from reading to reading.
TEST(MendedCounts, AreAGuessWhereACastorSwingsRoundFasterAndFaster) {
  constexpr double kStep_s = 0.05, kSwings_s = 2.5, kSwing_rad = 2.4, kLasts_s = 0.15, kEvenly_rad = 0.3;
  const Vehicle platform = vehicle_of(three_castor_vehicle());
  std::vector<UnitSample> samples;
  for (int i = 0; i < 100; ++i) {
    UnitSample s;
    s.time_s = i * kStep_s;
    s.joints.assign(3, 0.0);
    const double turned_rad[3] = {0.5 * kSwing_rad * (1.0 + std::tanh((s.time_s - kSwings_s) / kLasts_s)),
                                  kEvenly_rad * i, 0.0};
    for (std::size_t u = 0; u < 3; ++u) {
      const DifferentialDrive drive = units_of(platform)[u].drive;
      const double way_m = 0.2 * s.time_s, by_m = 0.5 * drive.wheelbase_m * turned_rad[u];
      s.wheels.push_back({(way_m - by_m) / drive.wheel_radius_left_m, (way_m + by_m) / drive.wheel_radius_right_m});
    }
    samples.push_back(std::move(s));
  }
  const MendedCounts mended = with_mended_counts(samples, platform);
  ASSERT_EQ(mended.guessed[0].size(), 1U);
  EXPECT_NEAR(mended.guessed[0][0].first, kSwings_s - kLasts_s, 2.0 * kStep_s);
  EXPECT_NEAR(mended.guessed[0][0].second, kSwings_s + kLasts_s, 2.0 * kStep_s);
  EXPECT_TRUE(mended.guessed[1].empty());
  EXPECT_TRUE(mended.guessed[2].empty());
}

// Both counters of truck B stand for 0.6 s, in which the truck goes on, and truck A with it; what they would have
// counted is lost.
Recording with_lost_counts(Recording run, std::size_t from, std::size_t to) {
  for (Channel& c : run.channels)
    if (c.name == "b_left_wheel_rad" || c.name == "b_right_wheel_rad") {
      const double lost = c.values[to] - c.values[from];
      std::fill(c.values.begin() + static_cast<std::ptrdiff_t>(from),
                c.values.begin() + static_cast<std::ptrdiff_t>(to), c.values[from]);
      for (std::size_t i = to; i < c.values.size(); ++i) c.values[i] -= lost;
    }
  return run;
}

TEST(MendedCounts, GoOnWhereATruckStandsWithinOneReadingAndTheOtherGoesOn) {
  const Clapper trucks = fine_clapper();
  const Vehicle vehicle = vehicle_of(trucks);
  constexpr std::size_t kFrom = 500, kTo = 515;
  const Recording sound = linked_run(trucks, {}, 551), faulty = with_lost_counts(sound, kFrom, kTo);
  const std::vector<UnitSample> actual = unit_samples(sound, vehicle);
  const MendedCounts mended = with_mended_counts(unit_samples(faulty, vehicle), vehicle);
  const double way = std::abs(actual[kTo].wheels[1].left_rad - actual[kFrom].wheels[1].left_rad);
  ASSERT_GT(way, 0.5);
  for (std::size_t i : {kFrom + 7, kTo, kTo + 100})  // but for what it gained or lost meanwhile
    EXPECT_NEAR(mended.samples[i].wheels[1].left_rad, actual[i].wheels[1].left_rad, 0.1 * way) << i;
  ASSERT_EQ(mended.guessed[1].size(), 1u);
  EXPECT_NEAR(mended.guessed[1][0].first, sound.time_s[kFrom], 0.05);
  EXPECT_TRUE(mended.guessed[0].empty());
}

// It stood, and the truck set off while its counter held: what comes at once is what truck B went.
TEST(MendedCounts, CatchUpThoughTheWheelStoodBeforeItsCounterHeld) {
  const Clapper trucks = fine_clapper();
  const Vehicle vehicle = vehicle_of(trucks);
  constexpr std::size_t kStands = 10, kHolds = 30;  // readings
  std::vector<UnitSample> samples;
  for (std::size_t i = 0; i < 100; ++i) {
    const double rad = i < kStands ? 0.0 : 0.1 * static_cast<double>(i - kStands);
    const double held_rad = i < kHolds ? 0.0 : rad;
    samples.push_back({0.04 * static_cast<double>(i), {{held_rad, held_rad}, {rad, rad}}, {0.0, 0.0, 1.0}});
  }
  const MendedCounts mended = with_mended_counts(samples, vehicle);
  EXPECT_NEAR(mended.samples.back().wheels[0].left_rad, samples.back().wheels[1].left_rad, 1e-9);
  ASSERT_EQ(mended.guessed[0].size(), 1u);
  EXPECT_LE(mended.guessed[0][0].first, samples[kStands].time_s);
}

// A board that restarts counts from zero again.
TEST(MendedCounts, GoOnWhereACounterBeginsAnew) {
  const Clapper trucks = fine_clapper();
  const Vehicle vehicle = vehicle_of(trucks);
  constexpr std::size_t kAt = 400;
  const Recording sound = linked_run(trucks, {}, 552);
  Recording faulty = sound;
  for (Channel& c : faulty.channels)
    if (c.name == "a_left_wheel_rad") {
      const double before = c.values[kAt];
      for (std::size_t i = kAt; i < c.values.size(); ++i) c.values[i] -= before;
    }
  const double actual = unit_samples(sound, vehicle).back().wheels[0].left_rad;
  EXPECT_NEAR(with_mended_counts(unit_samples(faulty, vehicle), vehicle).samples.back().wheels[0].left_rad, actual,
              0.05);  // a reading's way is 0.2 rad
}

// Only what really is missing is said, and no push by which truck B would have come after.
TEST(DiagnoseUnits, TakeCountersThatStandForNoPush) {
  const Clapper trucks = fine_clapper();
  std::vector<Recording> runs;
  for (std::uint64_t seed = 553; seed < 556; ++seed) runs.push_back(linked_run(trucks, {}, seed));
  runs[1] = with_lost_counts(runs[1], 500, 515);
  for (Recording& r : runs) r.channels.resize(r.channels.size() - 3);  // without a truth
  const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(trucks));
  ASSERT_TRUE(d);
  ASSERT_FALSE(d->findings.empty());
  for (const Finding& f : d->findings) {
    EXPECT_EQ(f.effect, "encoder_data_fault");
    EXPECT_EQ(f.component.rfind("truck_b", 0), 0u) << f.component;
    EXPECT_EQ(f.where.recording, runs[1].name);
  }
}

// Three readings each in one message: the stamps are those of its arrival.
TEST(EvenedRecording, HasAllEncodersOfALinkedVehicleOnTheirPeriod) {
  const Clapper trucks = fine_clapper();
  const Recording sound = linked_run(trucks, {}, 556);
  Recording late = sound;
  for (std::size_t i = 0; i < late.time_s.size(); ++i) {
    const std::size_t last = std::min(i / 3 * 3 + 2, late.time_s.size() - 1);
    late.time_s[i] = sound.time_s[last] + 1e-4 * static_cast<double>(i % 3);
  }
  for (Channel& c : late.channels)
    if (c.name.rfind("truth_", 0) == 0) std::fill(c.values.begin(), c.values.end(), std::nan(""));
  const std::optional<EvenedRecording> even = evened(late, encoder_columns(vehicle_of(trucks)));
  ASSERT_TRUE(even);
  const std::vector<UnitSample> samples = unit_samples(even->recording, vehicle_of(trucks));
  ASSERT_EQ(samples.size(), sound.time_s.size());
  const double period_s = sound.time_s[1] - sound.time_s[0];
  for (std::size_t i = 1; i < samples.size(); ++i)
    EXPECT_NEAR(samples[i].time_s - samples[i - 1].time_s, period_s, 0.02 * period_s);
}

// Four seconds in which a tracker saw nothing and somebody drew a line.
TEST(TrackedPoses, AreWithoutWhatWasDrawnIntoAGap) {
  Recording run = linked_run(fine_clapper(), {}, 557);
  constexpr std::size_t kFrom = 200, kTo = 300;
  for (Channel& c : run.channels)
    if (c.name.rfind("truth_", 0) == 0)
      for (std::size_t i = kFrom + 1; i < kTo; ++i)
        c.values[i] = c.values[kFrom] + (c.values[kTo] - c.values[kFrom]) * static_cast<double>(i - kFrom) /
                                            static_cast<double>(kTo - kFrom);
  for (const TimedPose& t : tracked_poses(run))
    EXPECT_TRUE(t.time_s <= run.time_s[kFrom] || t.time_s >= run.time_s[kTo]) << t.time_s;
}

}  // namespace
}  // namespace odolab::test
