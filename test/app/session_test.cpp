#include "app/gui/session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/gui/first_scenario.h"
#include "app/gui/folder_listing.h"
#include "app/gui/planned_path.h"
#include "app/gui/views.h"
#include "core/calibration/external.h"
#include "core/diagnosis/quality/sound_recordings.h"
#include "core/io/import/imported_recording.h"
#include "core/io/recording_csv.h"
#include "physics/benchmark.h"
#include "physics/driven_recording.h"
#include "source_dir.h"
#include "test/app/always.h"
#include "test/support/same_bits.h"

namespace odolab {
namespace {

Scenario small_square() {
  Scenario s = first_scenario();
  s.path = SquarePath{0.6, false};
  s.floor.bumps[0].centre = {0.3, 0.45};
  return s;
}

// Plays to the end with pictures of uneven length, as a window on a busy machine would.
void play_to_end(Session& session, double first_frame_s) {
  session.execute(ui::Play{});
  double frame_s = first_frame_s;
  for (int i = 0; i < 100000 && session.playing(); ++i) {
    session.advance(frame_s, kAlways);
    frame_s = 0.004 + std::fmod(frame_s * 1.618 + 0.013, 0.09);
  }
  ASSERT_TRUE(session.run().finished());
}

TEST(Session, PlayedAtAnyFrameRateRecordsWhatAHeadlessRunRecordsToTheBit) {
  const Scenario scenario = small_square();
  Simulation headless(scenario, scenario.seed);
  run_to_end(headless);
  for (const double frame_s : {0.016, 0.07}) {
    Session session(false);
    session.execute(ui::EditScenario{scenario});
    play_to_end(session, frame_s);
    expect_same_bits(session.run().recording().value(), headless.recording());
  }
}

TEST(Session, ScrubbingAndSteppingBackChangeNothingOfTheRun) {
  const Scenario scenario = small_square();
  Session plain(false), scrubbed(false);
  plain.execute(ui::EditScenario{scenario});
  scrubbed.execute(ui::EditScenario{scenario});
  play_to_end(plain, 0.02);
  scrubbed.execute(ui::Play{});
  for (int i = 0; i < 100; ++i) scrubbed.advance(0.033, kAlways);
  const double latest = scrubbed.run().latest_s();
  scrubbed.execute(ui::ScrubTo{0.5 * latest});
  EXPECT_FALSE(scrubbed.playing());
  EXPECT_NEAR(scrubbed.run().shown().time_s, 0.5 * latest, 1e-12);
  EXPECT_DOUBLE_EQ(scrubbed.run().latest_s(), latest);
  scrubbed.execute(ui::StepBack{});
  EXPECT_LT(scrubbed.run().shown_s(), 0.5 * latest);
  scrubbed.execute(ui::ToStart{});
  EXPECT_DOUBLE_EQ(scrubbed.run().shown_s(), 0.0);
  play_to_end(scrubbed, 0.05);
  expect_same_bits(scrubbed.run().recording().value(), plain.run().recording().value());
}

TEST(Session, AStepIsOnePictureAndPauses) {
  Session session(false);
  session.execute(ui::EditScenario{small_square()});
  session.execute(ui::Play{});
  session.execute(ui::StepForward{});
  EXPECT_FALSE(session.playing());
  EXPECT_NEAR(session.run().shown_s(), 0.020, 1e-9);
  session.execute(ui::StepForward{});
  EXPECT_NEAR(session.run().shown_s(), 0.040, 1e-9);
  session.execute(ui::StepBack{});
  EXPECT_NEAR(session.run().shown_s(), 0.020, 1e-9);
}

TEST(Session, ACableTakenAwayBeforeTheRobotReachesItNeverTurnsIt) {
  Scenario with = small_square();
  with.floor.roughness = {};
  Scenario without = with;
  without.floor.bumps.clear();
  Session session(false), clear(false);
  session.execute(ui::EditScenario{with});
  clear.execute(ui::EditScenario{without});
  session.execute(ui::Play{});
  session.advance(0.2, kAlways);  // still far from the cable at 0.3 m
  session.execute(ui::SetFloor{without.floor});
  play_to_end(session, 0.02);
  play_to_end(clear, 0.02);
  expect_same_bits(session.run().recording().value(), clear.run().recording().value());
  ASSERT_EQ(session.run().events().size(), 1u);
  EXPECT_EQ(session.run().events()[0].kind, RunEvent::Kind::floor_changed);
}

TEST(Session, MarksTheCableOnTheTimelineWhenAWheelMeetsIt) {
  Session session(false);
  session.execute(ui::EditScenario{small_square()});
  play_to_end(session, 0.02);
  ASSERT_FALSE(session.run().events().empty());
  EXPECT_EQ(session.run().events()[0].kind, RunEvent::Kind::bump);
  EXPECT_NE(session.run().events()[0].words.find("left wheel"), std::string::npos);
}

TEST(Session, UndoTakesBackAFloorEditWithoutARestartAndRedoRepeatsIt) {
  Session session(false);
  session.execute(ui::EditScenario{small_square()});
  session.execute(ui::Play{});
  session.advance(0.5, kAlways);
  Floor floor = session.run().scenario().floor;
  floor.bumps.clear();
  session.execute(ui::SetFloor{floor, true});
  session.execute(ui::Undo{});
  EXPECT_EQ(session.run().scenario().floor.bumps.size(), 1u);
  EXPECT_GT(session.run().latest_s(), 0.4);
  session.execute(ui::Redo{});
  EXPECT_TRUE(session.run().scenario().floor.bumps.empty());
}

TEST(Session, RefusesAScenarioWithProblemsInWordsAndKeepsTheOldOne) {
  Session session(false);
  Scenario bad = small_square();
  bad.actual.wheelbase_m = 0.0;
  session.execute(ui::EditScenario{bad});
  ASSERT_EQ(session.messages().size(), 1u);
  EXPECT_NE(session.messages()[0].text.find("actual.wheelbase_m"), std::string::npos);
  EXPECT_GT(session.run().scenario().actual.wheelbase_m, 0.1);
  session.execute(ui::DismissMessage{0});
  EXPECT_TRUE(session.messages().empty());
}

TEST(Session, ABadFileLeavesAMessageAndEverythingElseAsItWas) {
  const std::string path = (std::filesystem::temp_directory_path() / "odolab_session_test_bad.toml").string();
  std::ofstream(path) << "[floor]\nfrictoin = 0.5\n";
  Session session(false);
  const std::string title = session.title();
  EXPECT_FALSE(session.open(path));
  EXPECT_FALSE(session.open("/no/such/file.csv"));
  ASSERT_EQ(session.messages().size(), 2u);
  EXPECT_NE(session.messages()[0].text.find("frictoin"), std::string::npos);
  EXPECT_NE(session.messages()[1].text.find("/no/such/file.csv"), std::string::npos);
  EXPECT_EQ(session.title(), title);
  std::filesystem::remove(path);
}

TEST(Session, HandDrivingGoesWhereItIsToldAndBackToThePath) {
  Session session(false);
  Scenario scenario = small_square();
  scenario.floor = Floor{};
  session.execute(ui::EditScenario{scenario});
  session.execute(ui::DriveByHandInstead{true});
  session.execute(ui::DriveByHand{0.2, 0.0});
  for (int i = 0; i < 100; ++i) session.advance(0.03, kAlways);
  EXPECT_GT(session.run().shown().true_pose.x_m, 0.2);  // 3 s at 0.2 m/s, less the acceleration
  session.execute(ui::DriveByHandInstead{false});
  EXPECT_TRUE(std::holds_alternative<SquarePath>(session.run().scenario().path));
}

TEST(Session, UmbmarkInTheWindowFindsTheErrorsAndDrivesAtLeastTenTimesBetterAfterwards) {
  Session session(false);
  Scenario scenario = first_scenario();
  scenario.path = SquarePath{2.0, false};
  session.execute(ui::EditScenario{scenario});
  session.execute(ui::StartBenchmark{4, false});
  ASSERT_EQ(session.bench().experiments().size(), 1u);
  const ui::BenchExperiment& before = session.bench().experiments().front();
  EXPECT_EQ(before.runs.clockwise.size(), 4u);
  ASSERT_TRUE(before.calibration.has_value());
  session.execute(ui::ApplyCalibration{});
  ASSERT_EQ(session.bench().experiments().size(), 2u);
  const ui::BenchExperiment& after = session.bench().experiments().back();
  ASSERT_TRUE(after.measure.has_value());
  // The bar of the report's own results; the rest is the rough floor's chance.
  EXPECT_LT(after.measure->largest_systematic_error_m,
            0.1 * session.bench().experiments().front().measure->largest_systematic_error_m);
  session.execute(ui::AdoptCalibration{});
  EXPECT_EQ(session.mode(), ui::Mode::drive);
  EXPECT_NE(std::get<DifferentialDrive>(session.run().scenario().vehicle.kind).wheelbase_m, 0.340);
}

TEST(Session, UmbmarkInTheWindowGivesTheNumbersOfTheCommandLineToTheBit) {
  Scenario scenario = small_square();
  scenario.benchmark = Benchmark{2, false};
  scenario.seed = 7;
  const std::vector<UmbmarkStage> stages = run_umbmark_calibration(scenario, scenario.seed);
  ASSERT_GE(stages.size(), 2u);
  Session session(false);
  session.execute(ui::EditScenario{scenario});
  session.execute(ui::StartBenchmark{2, true});
  for (std::size_t k = 1; k < stages.size(); ++k) session.execute(ui::ApplyCalibration{});
  const std::vector<ui::BenchExperiment>& experiments = session.bench().experiments();
  ASSERT_EQ(experiments.size(), stages.size());
  const auto expect_same = [](const std::vector<ReturnError>& a, const std::vector<ReturnError>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(bits(a[i].x_m), bits(b[i].x_m));
      EXPECT_EQ(bits(a[i].y_m), bits(b[i].y_m));
      EXPECT_EQ(bits(a[i].heading_rad), bits(b[i].heading_rad));
    }
  };
  for (std::size_t k = 0; k < stages.size(); ++k) {
    expect_same(experiments[k].runs.clockwise, stages[k].runs.clockwise);
    expect_same(experiments[k].runs.counter_clockwise, stages[k].runs.counter_clockwise);
    EXPECT_EQ(bits(experiments[k].measure->largest_systematic_error_m),
              bits(stages[k].measure.largest_systematic_error_m));
  }
}

TEST(Session, UmbmarkNamesARunThatNeverArrivedAndCalibratesNothingFromTheRest) {
  Session session(false);
  Scenario scenario = small_square();
  scenario.floor.bumps.clear();
  scenario.motor.torque_limit_nm = 1e-4;  // too weak to gain the speed asked for within a side
  session.execute(ui::EditScenario{scenario});
  session.execute(ui::StartBenchmark{1, false});
  ASSERT_EQ(session.bench().experiments().size(), 1u);
  const ui::BenchExperiment& e = session.bench().experiments().back();
  ASSERT_FALSE(e.lost.empty());
  EXPECT_EQ(e.runs.clockwise.size() + e.runs.counter_clockwise.size() + e.lost.size(), 2u);
  EXPECT_FALSE(e.calibration.has_value());
}

TEST(Session, SaysHowADeletedCableComesBackUntilItIsBack) {
  Session session(false);
  session.execute(ui::EditScenario{small_square()});
  Floor floor = session.run().scenario().floor;
  floor.bumps.clear();
  session.execute(ui::SetFloor{floor, true});
  ASSERT_EQ(session.messages().size(), 1u);
  EXPECT_NE(session.messages()[0].text.find("Ctrl+Z"), std::string::npos);
  EXPECT_FALSE(session.messages()[0].is_error);
  session.execute(ui::Undo{});
  EXPECT_TRUE(session.messages().empty());
  session.execute(ui::SetFloor{floor, true});
  for (int i = 0; i < 700; ++i) session.advance(1.0 / 60.0, kAlways);  // it goes by itself after 10 s
  EXPECT_TRUE(session.messages().empty());
}

TEST(Session, TheTimeAxisIsThePlanUntilTheRunOutlastsItAndNeverShrinks) {
  Session session(false);
  session.execute(ui::EditScenario{small_square()});
  const ui::Theme theme = ui::make_theme(false, 1.0f);
  const double planned_s = session.run().simulation().expected_duration_s();
  EXPECT_DOUBLE_EQ(drive_transport(session, theme).total_s, planned_s);
  EXPECT_TRUE(drive_transport(session, theme).total_is_planned);
  play_to_end(session, 0.05);
  const ui::Transport over = drive_transport(session, theme);
  EXPECT_FALSE(over.total_is_planned);
  EXPECT_DOUBLE_EQ(over.total_s, std::max(planned_s, over.latest_s));
}

TEST(Session, AMessageSaidAgainIsTheNewestAndThereOnce) {
  Session session(false);
  for (const char* words : {"one", "two", "one"}) session.say(words, true);
  ASSERT_EQ(session.messages().size(), 2u);
  EXPECT_EQ(session.messages().back().text, "one");
}

TEST(Compare, TheGapAtTheLastInstantIsTheErrorAtTheEnd) {
  Session session(false);
  Scenario scenario = small_square();
  scenario.sensors.truth_period_s = 0.07;  // out of step with the encoders
  session.execute(ui::EditScenario{scenario});
  session.execute(ui::RecordSimulatedRun{});
  session.advance(0.0, kAlways);
  session.advance(0.0, kAlways);
  ASSERT_NE(session.comparison().nominal(), nullptr);
  session.execute(ui::ToEnd{});
  const ui::ErrorNow now = error_now(session);
  const TrackError& error = *session.comparison().nominal()->replay.simulated_error;
  EXPECT_NEAR(now.simulated_gap_m, error.end_position_m, 1e-12);  // the same sum in another order
  EXPECT_NEAR(now.simulated_gap_heading_rad, error.end_heading_rad, 1e-12);
}

TEST(FolderListing, ListsFoldersAndWhatCanBeOpened) {
  FolderListing listing;
  const std::string assets = std::string(ODOLAB_SOURCE_DIR) + "/assets/";
  const auto holds = [&](const std::string& typed, const std::string& name) {
    for (const ui::PathEntry& e : listing.of(typed))
      if (e.name == name) return true;
    return false;
  };
  EXPECT_TRUE(holds(assets, "scenarios/"));
  EXPECT_TRUE(holds(assets, "../"));
  EXPECT_TRUE(holds(assets + "sc", "scenarios/"));
  EXPECT_FALSE(holds(assets + "sc", "vehicles/"));
  EXPECT_TRUE(holds(assets + "scenarios/", "umbmark.toml"));
  EXPECT_TRUE(holds(assets + "scenarios/umbmark.toml", "no_error.toml"));
  EXPECT_TRUE(holds(assets + "recordings/", "simulated_eight.csv"));
  EXPECT_FALSE(holds(assets + "pictures/", "drive.png"));
  EXPECT_TRUE(listing.of("/no/such/folder/x").empty());
}

TEST(Session, ARecordedRunIsReplayedAndCalibratedAgainstItsTruth) {
  Session session(false);
  session.execute(ui::EditScenario{small_square()});
  session.execute(ui::RecordSimulatedRun{});
  session.advance(0.0, kAlways);  // the replay follows the recording as a job of its own
  session.advance(0.0, kAlways);
  EXPECT_EQ(session.mode(), ui::Mode::compare);
  ASSERT_NE(session.comparison().nominal(), nullptr);
  ASSERT_TRUE(session.comparison().nominal()->replay.simulated_error.has_value());
  session.execute(ui::CalibrateFromRecording{});
  session.advance(0.0, kAlways);
  ASSERT_NE(session.comparison().calibrated(), nullptr);
  const double before = session.comparison().nominal()->replay.dead_reckoned_error->position_rms_m;
  const double after = session.comparison().calibrated()->replay.dead_reckoned_error->position_rms_m;
  EXPECT_LT(after, before);
}

// Counts of the left wheel that were lost in one reading, a few times: where that was is not asked what the wheels did.
TEST(Session, ARecordingWithFaultsIsCalibratedAsTheCommandLineDoes) {
  Scenario scenario = first_scenario();
  scenario.path = FigureEightPath{0.8, 1};
  scenario.floor = {};
  Recording recording = driven_recording(scenario, 3).value();
  for (Channel& c : recording.channels)
    if (c.name.rfind("left_", 0) == 0)
      for (std::size_t i = 0, n = c.values.size(); i < n; ++i)
        c.values[i] -= (c.name == "left_ticks" ? 60.0 : 0.19) * std::floor(5.0 * double(i) / double(n));
  Session session(false);
  session.execute(ui::EditScenario{scenario});
  const std::string path = (std::filesystem::temp_directory_path() / "odolab_lost_counts.csv").string();
  ASSERT_TRUE(write_recording_csv(path, recording));
  session.execute(ui::OpenFile{path});
  session.advance(0.0, kAlways);
  session.execute(ui::CalibrateFromRecording{});
  session.advance(0.0, kAlways);
  ASSERT_TRUE(session.comparison().calibration()) << session.messages().back().text;
  const Vehicle& vehicle = session.comparison().vehicle();
  const SoundRecordings sound = sound_recordings({load_recording(path)->recording}, vehicle);
  EXPECT_FALSE(sound.said.empty());
  const ExternalCalibration by_command_line = calibrate_externally(sound.recordings, vehicle, {}, sound.how).value();
  const std::vector<ParameterEstimate>& here = session.comparison().calibration()->parameters;
  const std::vector<ParameterEstimate>& there = by_command_line.parts.front().calibration.parameters;
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t k = 0; k < here.size(); ++k) EXPECT_EQ(here[k].value, there[k].value) << here[k].name;
}

TEST(PlannedPath, OfASquareClosesAndTurnsTheWayItIsDriven) {
  Scenario s;
  s.start = {1.0, 1.0, 0.0};
  s.path = SquarePath{4.0, true};
  const std::vector<Vec2> line = planned_path(s, s.start);
  ASSERT_EQ(line.size(), 5u);
  EXPECT_NEAR(length(line.front() - line.back()), 0.0, 1e-12);
  EXPECT_NEAR(line[2].y_m, -3.0, 1e-12);  // clockwise: to the right of the start
}

}  // namespace
}  // namespace odolab
