#include "app/gui/kept_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/gui/drive_run.h"
#include "app/gui/first_scenario.h"

namespace odolab {
namespace {

KeptRows after(std::int64_t pictures) {
  KeptRows kept;
  for (std::int64_t i = 0; i < pictures; ++i) {
    kept.add();
    kept.thin();
  }
  return kept;
}

TEST(KeptRows, OfTheFirstHalfMinuteAreAll) { EXPECT_EQ(after(KeptRows::kAllOf).size(), 1500u); }

TEST(KeptRows, AreTheFirstAndTheWholeLastHalfMinuteAndNeverFurtherApartThanTheirAgeAsks) {
  const std::int64_t hour = 180000;
  const KeptRows kept = after(hour);
  const std::vector<std::int64_t>& numbers = kept.numbers();
  EXPECT_EQ(numbers.front(), 0);
  for (std::int64_t i = 0; i < KeptRows::kAllOf; ++i)
    ASSERT_EQ(numbers[numbers.size() - 1 - std::size_t(i)], hour - 1 - i);
  // Half as many for twice the age: at an age of 1500 * 2^k pictures every 2^(k+1)th stays, so that two neighbours are
  // no further apart than the age of the later one over 750, or than the picture before.
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    const double age = double(hour - 1 - numbers[i - 1]);
    ASSERT_LE(double(numbers[i] - numbers[i - 1]), std::max(1.0, age / 750.0)) << "before picture " << numbers[i];
  }
}

TEST(KeptRows, GrowWithTheLogarithmOfTheTime) {
  // Half a minute whole and 750 for each doubling since, and as many as came since the last thinning (500).
  for (const std::int64_t pictures : {12000, 90000, 360000})
    EXPECT_LE(double(after(pictures).size()), 1500.0 + 750.0 * std::ceil(std::log2(double(pictures) / 1500.0)) + 500.0)
        << pictures;
}

TEST(KeptRows, AreNoFurtherApartThanTheWidestAsked) {
  KeptRows kept(8);
  for (int i = 0; i < 180000; ++i) {
    kept.add();
    kept.thin();
  }
  for (std::size_t i = 1; i < kept.size(); ++i) ASSERT_LE(kept.numbers()[i] - kept.numbers()[i - 1], 8);
  EXPECT_LT(double(kept.size()), 180000.0 / 8.0 + 3.0 * 1500.0 + 500.0);  // the last minutes are closer
}

TEST(KeptRows, NeverBecomeManyMoreThanTheMostAsked) {
  KeptRows kept(8, 16000);
  std::size_t most = 0;
  for (int i = 0; i < 2000000; ++i) {  // eleven hours
    kept.add();
    kept.thin();
    most = std::max(most, kept.size());
  }
  EXPECT_LE(most, 16000u + 500u);  // those that came since it was seen that they are too many
  EXPECT_GT(kept.size(), 7000u);   // and the way does not fall apart: half of them stay
}

TEST(KeptRows, DropTheSameRowsEverywhere) {
  KeptRows kept;
  std::vector<double> rows;
  for (int i = 0; i < 20000; ++i) {
    kept.add();
    rows.push_back(i);
    if (const std::vector<bool> stays = kept.thin(); !stays.empty()) keep_only(stays, rows);
  }
  ASSERT_EQ(rows.size(), kept.size());
  for (std::size_t i = 0; i < rows.size(); ++i) ASSERT_EQ(rows[i], double(kept.numbers()[i]));
}

TEST(DriveRun, LooksBackIntoALongRunAlongItsTracks) {
  Scenario scenario = first_scenario();
  scenario.path = FigureEightPath{1.0, 4};
  scenario.step_s = 0.005;
  DriveRun run(scenario);
  run.advance(200.0, [] { return true; });
  EXPECT_LT(run.time_s().size(), 1500u + 750u * 3u + 500u);
  EXPECT_EQ(run.time_s().size(), run.gap_m().size());
  for (const RunEstimate& e : run.estimates().all()) EXPECT_EQ(e.gap_m.size(), run.time_s().size());
  // Between two pictures that are kept of the first minute, the vehicle stands where its track was, wheels and all.
  run.show(10.03);
  const Pose truth = *pose_at(run.estimates().truth(), 10.03), shown = run.shown().true_pose;
  EXPECT_NEAR(shown.x_m, truth.x_m, 1e-12);
  EXPECT_NEAR(shown.y_m, truth.y_m, 1e-12);
  const VehiclePosture posture = run.shown_posture();
  EXPECT_NEAR(posture.bodies.front().x_m, truth.x_m, 1e-9);  // the LabMate's only body is where its truth is measured
  EXPECT_NEAR(posture.bodies.front().y_m, truth.y_m, 1e-9);
  // It is where the vehicle really was, to what the arc between two kept samples is high: those of three minutes ago are
  // 0.16 s apart, on a circle of 1 m at 0.2 m/s 32 mm, and 32^2 / 8000 = 0.13 mm high.
  Simulation again(scenario, scenario.seed);
  while (again.state().time_s < 10.03 - 1e-9) again.step();
  EXPECT_LT(length(again.state().true_pose.position() - truth.position()), 1.5e-4);
}

}  // namespace
}  // namespace odolab
