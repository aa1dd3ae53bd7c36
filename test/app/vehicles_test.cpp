// Every kind of vehicle in the session behind the window, as a person uses it.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "app/gui/session.h"
#include "app/gui/views.h"
#include "source_dir.h"
#include "test/app/always.h"

namespace odolab {
namespace {

const char* const kVehicleFiles[] = {"andros",  "andros_with_trailer",        "clapper",  "k2a",
                                     "labmate", "labmate_with_smart_trailer", "omnimate", "three_castors"};

std::string asset(const std::string& path) { return std::string(ODOLAB_SOURCE_DIR) + "/assets/" + path; }

void play(Session& session, double seconds) {
  session.execute(ui::Play{});
  for (double t = 0.0; t < seconds; t += 0.1) session.advance(0.1, kAlways);
}

TEST(EveryVehicle, OpensRunsScrubsRestartsAndComesBackByUndo) {
  for (const char* file : kVehicleFiles) {
    Session session(false);
    const std::string before = session.run().scenario().vehicle.name;
    ASSERT_TRUE(session.open(asset("vehicles/") + file + ".toml")) << file;
    ASSERT_TRUE(session.messages().empty()) << file << ": " << session.messages().front().text;
    play(session, 4.0);
    EXPECT_GT(session.run().shown().true_pose.x_m, 0.3) << file;  // 0.2 m/s, gaining speed for one second
    session.execute(ui::ScrubTo{1.0});
    const double there = session.run().shown().true_pose.x_m;
    EXPECT_NEAR(session.run().shown_posture().reference.x_m, there, 1e-12) << file;
    session.execute(ui::Restart{});
    session.advance(1.0, kAlways);
    session.execute(ui::ScrubTo{1.0});
    EXPECT_EQ(session.run().shown().true_pose.x_m, there) << file;  // the same bits
    session.execute(ui::Undo{});
    EXPECT_EQ(session.run().scenario().vehicle.name, before) << file;
  }
}

TEST(EveryVehicle, IsDrivenByHandAndGoesSidewaysWhereItCan) {
  for (const char* file : kVehicleFiles) {
    Session session(false);
    ASSERT_TRUE(session.open(asset("vehicles/") + file + ".toml")) << file;
    session.execute(ui::DriveByHandInstead{true});
    session.execute(ui::DriveByHand{0.2, 0.0, 0.0});
    play(session, 4.0);
    EXPECT_GT(session.run().shown().true_pose.x_m, 0.3) << file;
    if (!moves_sideways(session.run().scenario().vehicle.kind)) continue;
    session.execute(ui::DriveByHand{0.0, 0.0, 0.2});
    play(session, 8.0);  // linked trucks turn across the link first
    EXPECT_GT(session.run().shown().true_pose.y_m, 0.3) << file;
  }
}

TEST(EveryVehicle, IsPushedAsideByAPush) {
  for (const char* file : kVehicleFiles) {
    Session session(false);
    ASSERT_TRUE(session.open(asset("vehicles/") + file + ".toml")) << file;
    session.execute(ui::DriveByHandInstead{true});
    play(session, 0.5);
    const ui::FloorScene scene = drive_scene(session, session.run().shown(), ui::make_theme(false, 1.0f));
    const Vec2 before = session.run().shown().true_pose.position();
    session.execute(ui::Push{{0.0, scene.push_ns}});
    play(session, 0.5);
    EXPECT_GT(session.run().shown().true_pose.y_m - before.y_m, 0.0005) << file;
  }
}

TEST(EveryVehicle, IsDrawnAsItStandsAndItsGhostIsTheSameShape) {
  for (const char* file : kVehicleFiles) {
    Session session(false);
    ASSERT_TRUE(session.open(asset("vehicles/") + file + ".toml")) << file;
    play(session, 2.0);
    const SimulationState shown = session.run().shown();
    const ui::FloorScene scene = drive_scene(session, shown, ui::make_theme(false, 1.0f));
    ASSERT_EQ(scene.vehicles.size(), 2u) << file;
    EXPECT_EQ(scene.vehicles[0].shape, scene.vehicles[1].shape) << file;
    EXPECT_EQ(scene.vehicles[0].pose.x_m, shown.true_pose.x_m) << file;
    EXPECT_EQ(scene.vehicles[1].pose.x_m, shown.estimated_pose.x_m) << file;
    EXPECT_FALSE(scene.vehicles[0].posture.bodies.empty()) << file;
  }
}

TEST(EveryVehicle, HasAGapThatIsTheOdometrysAndNotThatOfOldReadings) {
  Session session(false);
  ASSERT_TRUE(session.open(asset("scenarios/three_castors.toml")));
  play(session, 4.0);
  // At 0.3 m/s the pose is up to 15 mm older than the picture: encoders are read every 50 ms. What odometry itself has
  // wrong after a metre on a plain floor is its encoders' rounding, some tenths of a millimetre.
  for (const double gap_m : session.run().gap_m()) EXPECT_LT(gap_m, 0.002);
}

TEST(EveryVehicle, SteersByTheEstimatorThatTheListSays) {
  for (const char* file : kVehicleFiles) {
    Session session(false);
    ASSERT_TRUE(session.open(asset("vehicles/") + file + ".toml")) << file;
    for (const bool internal : {true, false}) {
      Scenario scenario = session.run().scenario();
      scenario.driving.internal_correction = internal;
      session.execute(ui::EditScenario{scenario});
      play(session, 5.0);
      const RunEstimates& estimates = session.run().estimates();
      const Track& own = estimates.all()[estimates.steering()].track;
      Simulation beside(scenario, scenario.seed);
      while (beside.state().time_s < session.run().latest_s() - 1e-9) beside.step();
      const Track& robots = beside.estimated_track();
      ASSERT_EQ(own.size(), robots.size()) << file;
      for (std::size_t i = 0; i < own.size(); ++i)  // the trailer's hitch angle is unwrapped in another order
        ASSERT_LT(length(own[i].pose.position() - robots[i].pose.position()), 1e-12) << file << " " << i;
    }
  }
}

TEST(EveryVehicle, ShowsChosenEstimatorsAsTracksAndCurvesAndTheirReturnErrorsInTheEnd) {
  Session session(false);
  ASSERT_TRUE(session.open(asset("scenarios/smart_encoder_trailer.toml")));
  Scenario scenario = session.run().scenario();
  scenario.path = SquarePath{1.0};
  session.execute(ui::EditScenario{scenario});
  session.execute(ui::Play{});
  for (int i = 0; i < 2000 && !session.run().finished(); ++i) session.advance(0.1, kAlways);
  ASSERT_TRUE(session.run().finished());
  session.advance(0.1, kAlways);  // what is shown follows what was reckoned by a frame
  const ui::Theme theme = ui::make_theme(false, 1.0f);
  const SimulationState shown = session.run().shown();
  EXPECT_EQ(drive_scene(session, shown, theme).tracks.size(), 2u);
  const std::set<std::string> chosen{"towing wheels", "trailer alone"};
  const ui::FloorScene scene = drive_scene(session, shown, theme, chosen);
  ASSERT_EQ(scene.tracks.size(), 4u);
  EXPECT_EQ(scene.tracks[2].label, "towing wheels");
  EXPECT_NE(scene.tracks[2].colour, scene.tracks[3].colour);
  const ui::Transport bar = drive_transport(session, theme, chosen);
  ASSERT_EQ(bar.position_curves.size(), 3u);
  EXPECT_EQ(bar.position_curves[1].value->size(), bar.position_curves[0].value->size());

  const ui::Estimators table = estimators_of(session, shown, theme);
  EXPECT_TRUE(table.finished);
  // Two cables lie on the first metre: each turns the towing wheels' estimate by 0.6 degrees, which the trailer undoes.
  EXPECT_TRUE(table.rows[0].steers);
  EXPECT_GT(length(table.rows[1].gap.position()), 2.0 * length(table.rows[0].gap.position()));
  EXPECT_NEAR(length(table.rows[1].error_m), length(table.rows[1].gap.position()), 1e-12);
  EXPECT_EQ(bar.position_curves[1].value->back(), length(table.rows[1].gap.position()));
}

TEST(EveryVehicle, IsComparedWithTheReplayOfWhatItRecorded) {
  for (const char* file : kVehicleFiles) {
    Session session(false);
    ASSERT_TRUE(session.open(asset("vehicles/") + file + ".toml")) << file;
    Scenario scenario = session.run().scenario();
    scenario.path = WaypointPath{{{0.8, 0.0}, {0.8, 0.5}}};
    scenario.step_s = 0.002;
    scenario.floor.bumps.clear();
    session.execute(ui::EditScenario{scenario});
    session.execute(ui::RecordSimulatedRun{});
    session.advance(0.0, kAlways);
    EXPECT_EQ(session.mode(), ui::Mode::compare) << file;
    ASSERT_TRUE(session.comparison().nominal()) << file << ": " << session.messages().back().text;
    const ui::Theme theme = ui::make_theme(false, 1.0f);
    const ui::FloorScene scene = compare_scene(session, theme);
    ASSERT_EQ(scene.vehicles.size(), 2u) << file;
    EXPECT_EQ(scene.vehicles[0].posture.bodies.size(), scene.vehicles[0].shape->bodies.size()) << file;
    EXPECT_EQ(scene.tracks[2].label, session.run().estimates().all().front().name) << file;
    // Its weight is that of a drawing and not the scenario's; the castors' rounded wheels push against each other.
    EXPECT_LT(session.comparison().nominal()->replay.simulated_error->end_position_m, 0.015) << file;
    EXPECT_EQ(session.comparison().can_be_calibrated(), file == std::string("labmate")) << file;
  }
}

TEST(EveryVehicle, SaysInOneLineWhyARecordingIsNotItsOwn) {
  Session session(false);
  ASSERT_TRUE(session.open(asset("vehicles/clapper.toml")));
  session.open(asset("recordings/simulated_eight.csv"));
  session.advance(0.0, kAlways);
  EXPECT_FALSE(session.comparison().nominal());
  ASSERT_EQ(session.messages().size(), 1u);
  EXPECT_NE(session.messages()[0].text.find("a_left_wheel_rad and 6 other columns"), std::string::npos)
      << session.messages()[0].text;
  // The LabMate that drives has such encoders: it replays the recording though a CLAPPER's file was opened before.
  ASSERT_TRUE(session.open(asset("scenarios/square_with_cable.toml")));
  session.open(asset("recordings/simulated_eight.csv"));
  session.advance(0.0, kAlways);
  EXPECT_TRUE(session.comparison().nominal());
}

TEST(EveryVehicle, ButADifferentialDriveIsTurnedAwayFromTheSquaresOfUmbmarkInOneLine) {
  Session session(false);
  ASSERT_TRUE(session.open(asset("vehicles/clapper.toml")));
  const ui::Bench bench = bench_of(session);
  EXPECT_FALSE(bench.can_run);
  EXPECT_NE(bench.why_not.find("differential drive"), std::string::npos);
}

}  // namespace
}  // namespace odolab
