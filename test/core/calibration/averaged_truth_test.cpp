#include "core/calibration/averaged_truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/calibration/smoothed_readings.h"

namespace odolab {
namespace {

constexpr double kSpeed_mps = 0.5, kYawRate_radps = 1.0, kRadius_m = 0.1, kBase_m = 0.4, kPeriod_s = 0.01;

Pose on_the_circle(double time_s) {
  const double heading = kYawRate_radps * time_s, r = kSpeed_mps / kYawRate_radps;
  return {r * std::sin(heading), r * (1.0 - std::cos(heading)), heading};
}

InnovationModel model_of_the_circle() {
  InnovationModel model;
  model.drive = {kRadius_m, kRadius_m, kBase_m};
  model.truth.axle_T_tracked = {0.1, 0.05, 0.2};
  model.noise = {0.001, 0.001, 0.002};
  return model;
}

// Round and round for 20 s, wheels and truth each 0.01 s, the truth of a point beside the axle's middle.
InnovationRun round_and_round() {
  InnovationRun run;
  const double left = (kSpeed_mps - 0.5 * kBase_m * kYawRate_radps) / kRadius_m,
               right = (kSpeed_mps + 0.5 * kBase_m * kYawRate_radps) / kRadius_m;
  for (int i = 0; i <= 2000; ++i) {
    const double t = kPeriod_s * i;
    run.wheels.push_back({t, left * t, right * t});
    const Pose tracked = on_the_circle(t) * model_of_the_circle().truth.axle_T_tracked;
    run.truth.push_back({t, tracked.position(), tracked.heading_rad});
  }
  run.truth_has_heading = true;
  run.set_aside.assign(run.truth.size(), 0);
  return run;
}

double furthest_off_m(const InnovationRun& run) {
  double furthest = 0.0;
  for (const TruthSample& t : run.truth) {
    const Pose tracked = on_the_circle(t.time_s) * model_of_the_circle().truth.axle_T_tracked;
    furthest = std::max(furthest, length(t.position - tracked.position()));
  }
  return furthest;
}

TEST(AveragedTruth, LiesOnTheVehiclesWayAsTheSamplesDid) {
  const InnovationRun averaged = with_averaged_truth(round_and_round(), model_of_the_circle(), 0.05);
  EXPECT_EQ(averaged.truth.size(), 401u);  // five in one, and the last by itself
  EXPECT_LT(furthest_off_m(averaged), 1e-9);
}

// What a model is wrong by carries samples before the middle one as far as those behind it, and the other way.
TEST(AveragedTruth, LiesThereThoughRadiiAreAHundredthTooLarge) {
  InnovationModel wrong = model_of_the_circle();
  wrong.drive.wheel_radius_left_m *= 1.01;
  wrong.drive.wheel_radius_right_m *= 1.01;
  const double of_one_sample_m = 0.01 * kSpeed_mps * kPeriod_s;
  EXPECT_LT(furthest_off_m(with_averaged_truth(round_and_round(), wrong, 0.05)), 0.05 * of_one_sample_m);
}

// Of two no one is in the middle. A base that lags is slower than it is told by a tenth and more.
TEST(AveragedTruth, LiesThereOfAnEvenNumberThoughTheBaseDoesAnotherThingThanItIsTold) {
  InnovationModel wrong = model_of_the_circle();
  wrong.drive.wheel_radius_left_m *= 1.1;
  wrong.drive.wheel_radius_right_m *= 1.1;
  InnovationRun told = round_and_round();
  told.speeds_are_held = true;
  const InnovationRun averaged = with_averaged_truth(told, wrong, 0.02);
  EXPECT_EQ(averaged.truth.size(), 1001u);  // two in one, and the last by itself
  const double of_one_sample_m = 0.1 * kSpeed_mps * kPeriod_s;
  EXPECT_LT(furthest_off_m(averaged), 0.05 * of_one_sample_m);
}

// Told another speed each tenth of a second, of which one in twelve samples of the truth has a half before and a half
// behind: a straight line between two of them lies 0.6 mm beside the way.
TEST(AveragedTruth, LiesOnTheWayThoughTheSpeedJumpsBetweenTwoSamples) {
  constexpr double kTold_s = 0.1, kTruth_s = 1.0 / 119.88;
  const InnovationModel model = model_of_the_circle();
  InnovationRun told;
  told.speeds_are_held = true;
  told.truth_has_heading = true;
  const auto speed_mps = [](int i) { return i % 2 ? 0.5 : 0.2; };
  for (int i = 0; i <= 100; ++i) {
    const double rad = i == 0 ? 0.0 : told.wheels.back().left_rad + kTold_s * speed_mps(i - 1) / kRadius_m;
    told.wheels.push_back({kTold_s * i, rad, rad});
  }
  const auto way_m = [&](double t) {
    const auto i = static_cast<std::size_t>(t / kTold_s);
    return kRadius_m * told.wheels[i].left_rad + (t - told.wheels[i].time_s) * speed_mps(static_cast<int>(i));
  };
  for (double t = 0.05; t < 9.9; t += kTruth_s) {
    const Pose tracked = Pose{way_m(t), 0.0, 0.0} * model.truth.axle_T_tracked;
    told.truth.push_back({t, tracked.position(), tracked.heading_rad});
  }
  told.set_aside.assign(told.truth.size(), 0);
  const InnovationRun averaged = with_averaged_truth(told, model, 0.02);
  EXPECT_LT(averaged.truth.size(), told.truth.size() / 2 + 2);
  for (const TruthSample& t : averaged.truth) {
    const Pose tracked = Pose{way_m(t.time_s), 0.0, 0.0} * model.truth.axle_T_tracked;
    // The mean of what a sample before a jump and one behind it have beyond the model, which is nothing.
    EXPECT_NEAR(t.position.x_m, tracked.x_m, 1e-9) << t.time_s;
  }
}

TEST(AveragedTruth, HasWhiteNoiseThatIsSmallerByTheRootOfItsSamples) {
  InnovationRun noisy = round_and_round();
  Random random(7);
  constexpr double kNoise_m = 0.003;
  for (TruthSample& t : noisy.truth)
    t.position = t.position + Vec2{kNoise_m * random.normal(), kNoise_m * random.normal()};
  const InnovationRun averaged = with_averaged_truth(noisy, model_of_the_circle(), 0.05);
  double squares_m2 = 0.0;
  for (const TruthSample& t : averaged.truth) {
    const Pose tracked = on_the_circle(t.time_s) * model_of_the_circle().truth.axle_T_tracked;
    squares_m2 += dot(t.position - tracked.position(), t.position - tracked.position());
  }
  const double n = 2.0 * static_cast<double>(averaged.truth.size()), found_m = std::sqrt(squares_m2 / n);
  EXPECT_NEAR(found_m, kNoise_m / std::sqrt(5.0), 4.0 * found_m / std::sqrt(2.0 * n));
}

TEST(AveragedTruth, KnowsNothingOfSamplesThatAreSetAside) {
  InnovationRun run = round_and_round();
  for (std::size_t k = 3; k < run.truth.size(); k += 10) {
    run.truth[k].position.x_m += 1.0;
    run.set_aside[k] = 1;
  }
  const InnovationRun averaged = with_averaged_truth(run, model_of_the_circle(), 0.05);
  EXPECT_LT(furthest_off_m(averaged), 1e-9);
}

// Of four samples two are in the middle, and of stamps in milliseconds some lie at the very end of a mean: which is
// taken must not hang on the last digit that a stamp has by when the log began.
TEST(AveragedTruth, IsTheSameWheneverTheLogBegan) {
  const auto averaged_of_log = [](double begins_s) {
    InnovationRun run = round_and_round();
    for (std::size_t k = 0; k < run.truth.size(); ++k)  // 120 a second, as they are written
      run.truth[k].time_s = std::round(1e3 * (begins_s + static_cast<double>(k) / 120.0)) / 1e3;
    for (std::size_t k = 50; k < run.truth.size(); k += 97) run.truth.erase(run.truth.begin() + static_cast<long>(k));
    run.set_aside.assign(run.truth.size(), 0);
    for (WheelSample& w : run.wheels) w.time_s += begins_s;
    return with_averaged_truth(run, model_of_the_circle(), 0.034).truth;
  };
  const std::vector<TruthSample> at_once = averaged_of_log(0.0);
  for (const double begins_s : {2.0, 50.0, 1000.0, 1.7e9}) {
    const std::vector<TruthSample> later = averaged_of_log(begins_s);
    ASSERT_EQ(later.size(), at_once.size()) << begins_s;
    for (std::size_t k = 0; k < later.size(); ++k)
      ASSERT_NEAR(later[k].time_s - begins_s, at_once[k].time_s, 1e-5) << begins_s;
  }
}

// Whole counts, of 5 mm: carried by these, samples would lie where the counts do.
TEST(AveragedTruth, DoesNotTakeOnTheRoundingOfCoarseCounts) {
  constexpr double kCounts = 125.0, kCount_rad = 2.0 * kPi / kCounts;
  InnovationModel model = model_of_the_circle();
  model.drive.encoder_counts_per_revolution = kCounts;
  InnovationRun run = round_and_round();
  run.counts_show = true;
  for (WheelSample& w : run.wheels) {
    w.left_rad = kCount_rad * std::floor(w.left_rad / kCount_rad);
    w.right_rad = kCount_rad * std::floor(w.right_rad / kCount_rad);
  }
  run.smooth = smoothed(run.wheels);
  const double rounding_m = kRadius_m * kCount_rad / std::sqrt(12.0);
  EXPECT_LT(furthest_off_m(with_averaged_truth(run, model, 0.05)), 0.5 * rounding_m);
}

// A push carries the truth away for good: the samples behind it all contradict what was there before, and are no
// glitches for it.
TEST(AveragedTruth, TakesSamplesThatAreAllSetAsideForOneThatOthersJudge) {
  InnovationRun run = round_and_round();
  for (std::size_t k = 100; k < 105; ++k) {  // one whole mean
    run.truth[k].position.x_m += 0.2;
    run.set_aside[k] = 1;
  }
  const InnovationRun averaged = with_averaged_truth(run, model_of_the_circle(), 0.05);
  EXPECT_NEAR(furthest_off_m(averaged), 0.2, 1e-9);
  EXPECT_EQ(std::count(averaged.set_aside.begin(), averaged.set_aside.end(), 1), 0);
}

// Four of five in a mean, and one alone at the end.
TEST(AveragedTruth, IsTheLessCertainTheFewerItIsTakenOver) {
  InnovationRun run = round_and_round();
  run.set_aside[7] = 1;
  const InnovationRun averaged = with_averaged_truth(run, model_of_the_circle(), 0.05);
  EXPECT_DOUBLE_EQ(averaged.truth_variance[0], 1.0);
  EXPECT_DOUBLE_EQ(averaged.truth_variance[1], 1.25);
  EXPECT_DOUBLE_EQ(averaged.truth_variance.back(), 5.0);
}

// The likelihood of a run of single samples, each of which is known to be twice as uncertain in variance, is that of
// noise larger by the root of two.
TEST(AveragedTruth, CountsByItsVariance) {
  InnovationRun run = round_and_round();
  InnovationModel model = model_of_the_circle();
  FilterOptions options;
  options.derivatives = false;
  InnovationModel louder = model;
  louder.noise.truth_position_m *= std::sqrt(2.0);
  louder.noise.truth_heading_rad *= std::sqrt(2.0);
  const double expected = filtered(run, summed_up(run, louder), louder, options).log_determinant;
  run.truth_variance.assign(run.truth.size(), 2.0);
  EXPECT_NEAR(filtered(run, summed_up(run, model), model, options).log_determinant, expected,
              1e-9 * std::abs(expected));
}

TEST(AveragedTruth, IsNotTakenAcrossWhereTheWayIsUnknown) {
  InnovationRun run = round_and_round();
  run.cut.assign(run.truth.size(), 0);
  run.cut[103] = 1;
  for (std::size_t k = 103; k < run.truth.size(); ++k) run.truth[k].position.x_m += 1.0;
  const InnovationRun averaged = with_averaged_truth(run, model_of_the_circle(), 0.05);
  for (const TruthSample& t : averaged.truth) {
    const Pose tracked = on_the_circle(t.time_s) * model_of_the_circle().truth.axle_T_tracked;
    EXPECT_NEAR(t.position.x_m - tracked.x_m, t.time_s < 1.025 ? 0.0 : 1.0, 1e-9) << t.time_s;
  }
  const auto cut = std::find(averaged.cut.begin(), averaged.cut.end(), 1) - averaged.cut.begin();
  EXPECT_NEAR(averaged.truth[static_cast<std::size_t>(cut)].time_s, 1.05, 1e-9);
}

TEST(AveragedTruth, IsTheTruthItselfWhereThatComesSeldom) {
  InnovationRun run = round_and_round();
  std::vector<TruthSample> few;
  for (std::size_t k = 0; k < run.truth.size(); k += 4) few.push_back(run.truth[k]);
  run.truth = few;
  run.set_aside.assign(few.size(), 0);
  EXPECT_EQ(with_averaged_truth(run, model_of_the_circle(), 0.05).truth.size(), few.size());
}

TEST(AveragedTruth, IsTakenOverNoMoreThanATenthOfAWheelsTurn) {
  InnovationRun run = round_and_round();
  EXPECT_DOUBLE_EQ(averaging_s(run), 0.05);  // 7 rad/s: a tenth of a turn takes 0.09 s
  for (WheelSample& w : run.wheels) w.right_rad *= 3.0;
  EXPECT_NEAR(averaging_s(run), 0.1 * 2.0 * kPi / 21.0, 1e-9);
}

}  // namespace
}  // namespace odolab
