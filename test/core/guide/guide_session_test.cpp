#include "core/guide/guide_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/guide/misfit.h"
#include "core/guide/outcome.h"
#include "core/guide/recorded_run.h"

namespace odolab {
namespace {

// What a robot with these errors shows at the end of a square that its odometry takes for closed.
GuideRun run_of(const TypeErrors& errors, double side_m, bool clockwise, double wheelbase_m, Vec2 chance = {}) {
  GuideRun run;
  run.clockwise = clockwise;
  const ReturnError e = square_return_error(errors, side_m, clockwise, wheelbase_m);
  run.measured = {e.x_m + chance.x_m, e.y_m + chance.y_m, e.heading_rad};
  run.source = "typed";
  return run;
}

// A session of the UMBmark guide at its runs.
GuideSession at_runs() {
  GuideSession session;
  session.vehicle.kind = DifferentialDrive{};
  session.page = session.reached = 3;
  return session;
}

TEST(Guide, HasEachTaskOncePerGuideAndEndsWithWhatToTakeAway) {
  for (const Guide& guide : guides()) {
    EXPECT_EQ(&guide_of(guide.kind), &guide);
    ASSERT_FALSE(guide.pages.empty());
    EXPECT_EQ(guide.pages.front().task, PageTask::robot);
    EXPECT_EQ(guide.pages.back().task, PageTask::finish);
    for (const GuidePage& page : guide.pages) EXPECT_FALSE(page.title.empty() || page.words.empty()) << guide.key;
  }
}

TEST(Guide, RefusesAVehicleThatItCannotCalibrate) {
  Vehicle castors;
  castors.kind = three_castor_vehicle();
  EXPECT_NE(why_not(guide_of(GuideKind::umbmark), castors), "");
  EXPECT_EQ(why_not(guide_of(GuideKind::castors), castors), "");
  EXPECT_NE(why_not(guide_of(GuideKind::linked), castors), "");
}

TEST(GuideSession, FindsTheWheelbaseAndTheWheelsThatTheRunsWereMadeWith) {
  GuideSession session = at_runs();
  EXPECT_NE(still_to_do(session), "");
  const TypeErrors truth{radians(-0.8), radians(0.3)};
  const double true_wheelbase_m = 0.340 * (90.0 / 90.8);  // Eq. 6.28
  for (int i = 0; i < 3; ++i)
    for (const bool cw : {true, false}) {
      EXPECT_EQ(next_is_clockwise(*round_on(session, PageTask::runs)), cw);
      enter_run(session, PageTask::runs, run_of(truth, 4.0, cw, true_wheelbase_m));
    }
  EXPECT_EQ(still_to_do(session), "");
  const GuideOutcome out = outcome_of(session);
  ASSERT_EQ(out.settings.size(), 3u);
  EXPECT_NEAR(out.settings[2].value, true_wheelbase_m, 1e-9);  // the equations are solved, not approximated
  EXPECT_GT(out.settings[1].value, out.settings[0].value);     // it curves to the left: its right wheel is larger
  EXPECT_NEAR(out.settings[0].value + out.settings[1].value, 0.300, 1e-12);  // diameters, Eq. 6.30
  for (const Setting& s : out.settings) EXPECT_FALSE(s.ros2.empty());
}

TEST(GuideSession, NamesDiametersAndWhatTheRobotHadOnTheSquares) {
  GuideSession session = at_runs();
  session.tape = TapeReading{4.0, 4.04, 0.002};
  for (const bool cw : {true, false}) enter_run(session, PageTask::runs, run_of({0.01, 0.005}, 4.0, cw, 0.34));
  const GuideOutcome out = outcome_of(session);
  ASSERT_EQ(out.settings.size(), 3u);
  EXPECT_EQ(out.settings[0].words, "diameter of the left wheel");
  EXPECT_TRUE(out.settings[0].file_has_half);
  EXPECT_NEAR(out.settings[0].before, 2.0 * 0.075 * 1.01, 1e-12);  // scaled by the tape, Eq. B.2
  EXPECT_NEAR(out.settings[1].before, 2.0 * 0.075 * 1.01, 1e-12);
  EXPECT_FALSE(out.settings[2].file_has_half);
}

TEST(GuideSession, SaysOfATapeThatAgreesThatTheWheelsRollAsBelieved) {
  GuideSession session = at_runs();
  session.tape = TapeReading{4.0, 4.0, 0.002};
  EXPECT_EQ(outcome_of(session).sentences.front(),
            "The robot has gone as far as it believes: both wheels roll as believed.");
  session.tape = TapeReading{4.0, 4.04, 0.002};
  EXPECT_EQ(outcome_of(session).sentences.front(),
            "The robot believes to have gone 0.990 times as far as it has: "
            "both wheels roll 1.00 % more than believed.");
}

TEST(GuideSession, PutsTheTapesScaleIntoTheFirstRoundAndIntoEveryUncertainty) {
  GuideSession session = at_runs();
  session.tape = TapeReading{4.0, 4.04, 0.002};
  EXPECT_NEAR(first_nominal(session).wheel_radius_left_m, 0.075 * 1.01, 1e-12);  // Eq. B.2
  for (const bool cw : {true, false})
    for (const double off : {-0.01, 0.01})
      enter_run(session, PageTask::runs, run_of({0.01, 0.005}, 4.0, cw, 0.34, {off, -off}));
  const GuideOutcome with = outcome_of(session);
  session.tape->tape_accuracy_m = 1e-9;
  const GuideOutcome exact = outcome_of(session);
  const double relative = 0.002 / 4.04;
  for (std::size_t i = 0; i < 3; ++i) {
    const double expected = std::hypot(exact.settings[i].stderr_value, relative * with.settings[i].value);
    EXPECT_NEAR(with.settings[i].stderr_value, expected, 1e-4 * expected);  // Es is not quite 1 / actual
  }
}

TEST(GuideSession, MarksTheRunThatDoesNotFitAndCountsItAllTheSame) {
  GuideSession session = at_runs();
  Random random(4);
  for (int i = 0; i < 5; ++i)
    for (const bool cw : {true, false})
      enter_run(session, PageTask::runs,
                run_of({0.01, 0.005}, 4.0, cw, 0.34, {0.005 * random.normal(), 0.005 * random.normal()}));
  session.rounds[0].runs[4].measured.x_m += 0.15;  // thirty standard deviations
  const std::vector<bool> marked = misfits(session.rounds[0]);
  for (std::size_t i = 0; i < marked.size(); ++i) EXPECT_EQ(marked[i], i == 4) << i;
  EXPECT_EQ(umbmark_runs(session.rounds[0], 4.0).clockwise.size(), 5u);
  session.rounds[0].runs[4].left_out = true;
  EXPECT_EQ(umbmark_runs(session.rounds[0], 4.0).clockwise.size(), 4u);
  EXPECT_EQ(session.rounds[0].runs.size(), 10u);
  const GuideOutcome out = outcome_of(session);
  EXPECT_TRUE(std::any_of(out.warnings.begin(), out.warnings.end(),
                          [](const std::string& w) { return w == "cw 3 was left out."; }));
}

TEST(GuideSession, WarnsWronglyOfNormalRunsAsSeldomAsItsRuleSays) {
  Random random(11);
  int alarms = 0;
  constexpr int kExperiments = 4000;
  for (int k = 0; k < kExperiments; ++k) {
    GuideRound round;
    for (int i = 0; i < 10; ++i) {
      GuideRun run;
      run.clockwise = i % 2 == 0;
      run.measured = {0.02 * random.normal(), 0.02 * random.normal(), 0.0};
      round.runs.push_back(run);
    }
    const std::vector<bool> marked = misfits(round);
    alarms += std::any_of(marked.begin(), marked.end(), [](bool m) { return m; });
  }
  // 3.8 % is said; four standard errors of a share of 4000 are 1.2 %.
  EXPECT_NEAR(double(alarms) / kExperiments, 0.038, 0.012);
}

TEST(GuideSession, OffersASecondCompensationOnlyWhereTheRuleOfThreeStandardErrorsSaysSo) {
  for (const double rest : {0.0005, 0.01}) {
    GuideSession session = at_runs();
    const auto drive = [&](PageTask task, const TypeErrors& errors) {
      for (int i = 0; i < 5; ++i)
        for (const bool cw : {true, false})
          enter_run(session, task, run_of(errors, 4.0, cw, 0.34, {i % 2 ? 0.01 : -0.01, i % 3 ? 0.01 : -0.01}));
    };
    drive(PageTask::runs, {0.02, 0.01});
    ASSERT_TRUE(compensate(session));
    drive(PageTask::again, {rest, 0.0});
    // The centre is 2 L rest sqrt(2) off, 6 mm or 113 mm; the standard error 14 mm / sqrt(5) = 6 mm.
    EXPECT_EQ(outcome_of(session).compensate_again, rest > 0.005);
  }
}

TEST(GuideSession, BeginsTheSecondRoundOnceHoweverThePageIsReached) {
  GuideSession session = at_runs();
  for (const bool cw : {true, false}) enter_run(session, PageTask::runs, run_of({0.02, 0.01}, 4.0, cw, 0.34));
  turn_to(session, 5);
  ASSERT_EQ(session.rounds.size(), 2u);
  turn_to(session, 3);
  turn_to(session, 5);
  EXPECT_EQ(session.rounds.size(), 2u);
  EXPECT_EQ(session.reached, 5);
  turn_to(session, 99);
  EXPECT_EQ(session.page, 7);
}

TEST(GuideSession, TellsNothingOfAFirstRoundOfWhichOneDirectionIsLeftOutOnceTheSecondIsDriven) {
  GuideSession session = at_runs();
  for (const bool cw : {true, false}) enter_run(session, PageTask::runs, run_of({0.02, 0.01}, 4.0, cw, 0.34));
  ASSERT_TRUE(compensate(session));
  for (const bool cw : {true, false}) enter_run(session, PageTask::again, run_of({0.001, 0.0}, 4.0, cw, 0.34));
  session.rounds.front().runs.front().left_out = true;
  const GuideOutcome out = outcome_of(session);
  EXPECT_TRUE(out.settings.empty());
  EXPECT_TRUE(std::any_of(out.warnings.begin(), out.warnings.end(), [](const std::string& w) {
    return w.find("The first round has no run in one of both directions") != std::string::npos;
  }));
}

TEST(GuideSession, SaysWhereTheCalibrationDidNotHelp) {
  GuideSession session = at_runs();
  for (const PageTask task : {PageTask::runs, PageTask::again}) {
    for (const bool cw : {true, false}) {
      enter_run(session, task, run_of({0.02, 0.01}, 4.0, cw, 0.34));
      enter_run(session, task, run_of({0.02, 0.01}, 4.0, cw, 0.34, {0.001, 0.0}));
    }
    if (task == PageTask::runs) {
      ASSERT_TRUE(compensate(session));
    }
  }
  const GuideOutcome out = outcome_of(session);
  EXPECT_TRUE(std::any_of(out.warnings.begin(), out.warnings.end(),
                          [](const std::string& w) { return w.find("did not help") != std::string::npos; }));
}

TEST(GuideSession, TakesHeadingsAloneForTheBumps) {
  GuideSession session = at_runs();
  session.kind = GuideKind::extended_umbmark;
  for (const bool cw : {true, false}) {
    GuideRun run = run_of({0.0, 0.0}, 4.0, cw, 0.34);
    run.has_heading = true;
    run.measured.heading_rad = cw ? 0.01 : -0.02;
    enter_run(session, PageTask::runs, run);
    run.measured.heading_rad += cw ? -0.1 : 0.1;
    enter_run(session, PageTask::bumps, run);
  }
  const GuideOutcome out = outcome_of(session);
  ASSERT_TRUE(out.extended.has_value());
  EXPECT_NEAR(out.extended->mean_absolute_heading_error_rad, 0.1, 1e-12);
}

TEST(GuideSession, ReadsARunFromARecordingInTheFrameOfItsStart) {
  Recording recording;
  recording.name = "square.csv";
  Vehicle vehicle;
  const DifferentialDrive drive;
  vehicle.kind = drive;
  vehicle.truth.axle_T_tracked = {0.1, 0.05, 0.3};
  // Four sides of 1 m, each a straight and a turn of exactly 90 degrees to the right.
  std::vector<double> left{0.0}, right{0.0};
  const double straight = 1.0 / 0.075, turn = 0.25 * kPi * 0.340 / 0.075;
  for (int side = 0; side < 4; ++side) {
    left.push_back(left.back() + straight);
    right.push_back(right.back() + straight);
    left.push_back(left.back() + turn);
    right.push_back(right.back() - turn);
  }
  for (std::size_t i = 0; i < left.size(); ++i) recording.time_s.push_back(double(i));
  recording.add_channel("left_wheel_rad").values = left;
  recording.add_channel("right_wheel_rad").values = right;
  for (const char* name : {"truth_x_m", "truth_y_m", "truth_heading_rad"}) recording.add_channel(name);
  const Pose start{3.0, -2.0, 1.1}, ended = start * Pose{0.02, -0.03, 0.01};
  for (const auto& [row, pose] : {std::pair<std::size_t, Pose>{0, start}, {left.size() - 1, ended}}) {
    const Pose tracked = pose * vehicle.truth.axle_T_tracked;
    recording.channels[2].values[row] = tracked.x_m;
    recording.channels[3].values[row] = tracked.y_m;
    recording.channels[4].values[row] = tracked.heading_rad;
  }
  const Result<GuideRun> run = run_in(recording, vehicle);
  ASSERT_TRUE(run.ok()) << run.error().message();
  EXPECT_TRUE(run->clockwise);
  const ReturnError e = return_error(*run);
  EXPECT_NEAR(e.x_m, 0.02, 1e-12);
  EXPECT_NEAR(e.y_m, -0.03, 1e-12);
  EXPECT_NEAR(e.heading_rad, 0.01, 1e-12);
  // Driven away while the log goes on: that is no error of the square (it had been one of a metre).
  Recording goes_on = recording;
  goes_on.time_s.push_back(goes_on.time_s.back() + 1.0);
  for (std::size_t k = 0; k < goes_on.channels.size(); ++k)
    goes_on.channels[k].values.push_back(k < 2 ? goes_on.channels[k].values.back() + straight : std::nan(""));
  const Result<GuideRun> until_measured = run_in(goes_on, vehicle);
  ASSERT_TRUE(until_measured.ok());
  EXPECT_NEAR(return_error(*until_measured).x_m, 0.02, 1e-12);
  recording.channels[4].values.assign(left.size(), std::nan(""));
  EXPECT_FALSE(run_in(recording, vehicle).ok());
}

}  // namespace
}  // namespace odolab
