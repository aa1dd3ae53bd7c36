// The guides as a person goes through them: every action comes from a panel, through the session.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "app/gui/first_scenario.h"
#include "app/gui/session.h"
#include "core/calibration/umbmark.h"
#include "core/io/guide_toml.h"
#include "core/io/vehicle_toml.h"
#include "source_dir.h"

namespace odolab {
namespace {

const auto kNever = [] { return false; };

class GuideTest : public ::testing::Test {
 protected:
  GuideTest() {
    folder = (std::filesystem::temp_directory_path() / ("odolab_guides_" + std::to_string(::getpid()))).string();
    std::filesystem::remove_all(folder);
  }
  ~GuideTest() override { std::filesystem::remove_all(folder); }

  const GuideSession& now(const Session& session) { return session.guide().session(); }
  PageTask task(const Session& session) {
    return guide_of(now(session).kind).pages[std::size_t(now(session).page)].task;
  }
  void next(Session& session) {
    ASSERT_EQ(still_to_do(now(session)), "");
    GuideSession s = now(session);
    turn_to(s, s.page + 1);
    session.execute(ui::ChangeGuide{s, ui::GuideEdit::page});
  }
  void type_runs(Session& session, const TypeErrors& errors, double wheelbase_m) {
    for (int i = 0; i < 5; ++i)
      for (const bool cw : {true, false}) {
        GuideSession s = now(session);
        GuideRun run;
        run.clockwise = cw;
        const ReturnError e = square_return_error(errors, s.side_m, cw, wheelbase_m);
        // 10 mm of chance, the same in every direction
        run.measured = {e.x_m + 0.010 * std::cos(2.1 * i), e.y_m + 0.010 * std::sin(2.1 * i), 0.0};
        run.source = "typed";
        enter_run(s, task(session), run);
        session.execute(ui::ChangeGuide{s});
      }
  }

  std::string folder;
};

TEST_F(GuideTest, TakesARealRobotFromTheTapeToItsSettings) {
  Session session(false, folder);
  session.execute(ui::BeginGuide{GuideKind::umbmark, true});
  next(session);
  GuideSession s = now(session);
  s.tape = TapeReading{4.0, 4.02, 0.002};
  session.execute(ui::ChangeGuide{s});
  next(session);
  next(session);
  ASSERT_EQ(task(session), PageTask::runs);
  EXPECT_NE(still_to_do(now(session)), "");
  type_runs(session, {0.02, -0.01}, 0.34);
  next(session);
  const ui::GuideView result = session.guide().view(session.jobs());
  ASSERT_EQ(result.outcome->settings.size(), 3u);
  for (const Setting& setting : result.outcome->settings) EXPECT_GT(setting.stderr_value, 0.0);
  next(session);
  ASSERT_EQ(task(session), PageTask::again);
  type_runs(session, {0.0, 0.0}, 0.34);
  next(session);
  EXPECT_FALSE(session.guide().view(session.jobs()).outcome->compensate_again);
  next(session);
  ASSERT_EQ(task(session), PageTask::finish);
  for (const auto& [what, name] : {std::pair<ui::GuideExport, const char*>{ui::GuideExport::vehicle, "v.toml"},
                                   {ui::GuideExport::ros2, "r.yaml"},
                                   {ui::GuideExport::report, "p.html"}}) {
    session.execute(ui::ExportGuide{what, folder + "/out/" + name});
    EXPECT_TRUE(std::filesystem::exists(folder + "/out/" + name)) << name;
    session.execute(ui::ExportGuide{what, folder + "/out/" + name});  // a second time: the first one stays
    std::string numbered = name;
    numbered.insert(numbered.find('.'), "-2");
    EXPECT_TRUE(std::filesystem::exists(folder + "/out/" + numbered)) << numbered;
  }
  const Result<Vehicle> vehicle = read_vehicle(folder + "/out/v.toml");
  ASSERT_TRUE(vehicle.ok());
  const auto& drive = std::get<DifferentialDrive>(vehicle->kind);
  // Both wheels 0.5 % larger by the tape, and the mean stays (Eq. 6.30).
  EXPECT_NEAR(0.5 * (drive.wheel_radius_left_m + drive.wheel_radius_right_m), 0.075 * 1.005, 1e-9);
  EXPECT_NEAR(drive.wheelbase_m, 0.34 * 0.5 * kPi / (0.5 * kPi - 0.02),
              2e-4);  // Eq. 6.28; the chance is not quite even
}

TEST_F(GuideTest, TakesBackWhatWasEnteredStepByStepAndOnlyThat) {
  Session session(false, folder);
  session.execute(ui::SetMode{ui::Mode::calibrate});
  session.execute(ui::BeginGuide{GuideKind::umbmark, true});
  EXPECT_FALSE(session.can_undo());
  next(session);
  EXPECT_FALSE(session.can_undo());  // to turn a page is nothing to take back
  GuideSession s = now(session);
  s.tape = TapeReading{4.0, 4.02, 0.002};
  session.execute(ui::ChangeGuide{s});
  for (const double tape_m : {4.03, 4.04, 4.05}) {  // one drag of a number
    s.tape->actual_m = tape_m;
    session.execute(ui::ChangeGuide{s, tape_m == 4.03 ? ui::GuideEdit::edit : ui::GuideEdit::goes_on});
  }
  next(session);
  next(session);
  type_runs(session, {0.02, -0.01}, 0.34);
  s = now(session);
  s.rounds[0].runs[3].left_out = true;
  session.execute(ui::ChangeGuide{s});
  session.execute(ui::Undo{});
  EXPECT_FALSE(now(session).rounds[0].runs[3].left_out);
  session.execute(ui::Undo{});
  EXPECT_EQ(now(session).rounds[0].runs.size(), 9u);
  session.execute(ui::Redo{});
  EXPECT_EQ(now(session).rounds[0].runs.size(), 10u);
  for (int i = 0; i < 10; ++i) session.execute(ui::Undo{});
  EXPECT_EQ(now(session).tape->actual_m, 4.05);
  session.execute(ui::Undo{});
  EXPECT_EQ(now(session).tape->actual_m, 4.02);
  EXPECT_EQ(task(session), PageTask::tape);  // where it was entered
  session.execute(ui::Undo{});
  EXPECT_FALSE(now(session).tape.has_value());
  EXPECT_FALSE(session.can_undo());
  while (session.can_redo()) session.execute(ui::Redo{});
  EXPECT_TRUE(now(session).rounds[0].runs[3].left_out);
  EXPECT_NE(session.guide().view(session.jobs()).outcome->rounds.size(), 0u);
}

TEST_F(GuideTest, TakesBackADriveOfTheSimulatedRobot) {
  Session session(false, folder);
  session.execute(ui::SetMode{ui::Mode::calibrate});
  session.execute(ui::BeginGuide{GuideKind::linked, false});
  next(session);
  next(session);
  ASSERT_EQ(task(session), PageTask::recordings);
  session.execute(ui::DriveGuide{});
  ASSERT_FALSE(now(session).recordings.empty());
  const std::size_t settings = session.guide().view(session.jobs()).outcome->settings.size();
  EXPECT_GT(settings, 0u);
  session.execute(ui::Undo{});
  EXPECT_TRUE(now(session).recordings.empty());
  EXPECT_TRUE(session.guide().view(session.jobs()).outcome->settings.empty());
  session.execute(ui::Redo{});
  EXPECT_EQ(session.guide().view(session.jobs()).outcome->settings.size(), settings);
  EXPECT_EQ(session.guide().view(session.jobs()).problem, "");
}

TEST_F(GuideTest, DrivesASimulatedRobotThroughAllPages) {
  Session session(false, folder);
  Scenario scenario = first_scenario();
  scenario.floor = {};
  session.execute(ui::EditScenario{scenario});
  session.execute(ui::BeginGuide{GuideKind::umbmark, false});
  next(session);
  session.execute(ui::DriveGuide{});
  ASSERT_TRUE(now(session).tape.has_value());
  GuideSession s = now(session);
  next(session);
  s = now(session);
  s.side_m = 2.0;
  s.runs_each_way = 2;
  session.execute(ui::ChangeGuide{s});
  next(session);
  session.execute(ui::DriveGuide{});
  ASSERT_EQ(counted(now(session).rounds.at(0), true), 2);
  next(session);
  next(session);
  session.execute(ui::DriveGuide{});
  ASSERT_EQ(counted(now(session).rounds.at(1), false), 2);
  next(session);
  const ui::GuideView view = session.guide().view(session.jobs());
  ASSERT_EQ(view.outcome->rounds.size(), 2u);
  EXPECT_LT(view.outcome->rounds[1].measure->largest_systematic_error_m,
            0.5 * view.outcome->rounds[0].measure->largest_systematic_error_m);
  next(session);
  EXPECT_EQ(task(session), PageTask::finish);
}

TEST_F(GuideTest, BeginsNoOtherWhileItsRobotDrives) {
  Session session(true, folder);
  session.execute(ui::BeginGuide{GuideKind::umbmark, false});
  next(session);
  session.execute(ui::DriveGuide{});
  ASSERT_TRUE(session.jobs().running());
  session.execute(ui::BeginGuide{GuideKind::linked, false});
  EXPECT_EQ(now(session).kind, GuideKind::umbmark);
  EXPECT_EQ(session.messages().size(), 1u);
}

TEST_F(GuideTest, MeasuresWhatTenBumpsDo) {
  Session session(false, folder);
  Scenario scenario = first_scenario();
  scenario.floor = {};
  session.execute(ui::EditScenario{scenario});
  session.execute(ui::BeginGuide{GuideKind::extended_umbmark, false});
  next(session);
  GuideSession s = now(session);
  s.runs_each_way = 2;
  session.execute(ui::ChangeGuide{s});
  next(session);
  session.execute(ui::DriveGuide{});
  next(session);
  session.execute(ui::DriveGuide{});
  next(session);
  const ui::GuideView view = session.guide().view(session.jobs());
  ASSERT_TRUE(view.outcome->extended.has_value());
  // Ten times 0.592 degrees (3.5 mm over 340 mm each); the mean of four readings of 0.4 sqrt(2) degrees is good to 0.3,
  // and so is the bias that is taken off.
  EXPECT_NEAR(degrees(view.outcome->extended->mean_absolute_heading_error_rad), 5.92, 1.3);
}

TEST_F(GuideTest, CalibratesCastorsFromTheInside) {
  Session session(false, folder);
  session.execute(ui::BeginGuide{GuideKind::castors, false});
  next(session);
  next(session);
  session.execute(ui::DriveGuide{});
  ASSERT_EQ(now(session).recordings.size(), 6u);
  next(session);
  const ui::GuideView view = session.guide().view(session.jobs());
  ASSERT_TRUE(view.outcome->calibrated.has_value());
  const auto& found = std::get<MultiCastor>(view.outcome->calibrated->kind);
  const auto& actual = std::get<MultiCastor>(view.actual->kind);
  for (std::size_t c = 0; c < 3; ++c)  // the drawing is up to 4.1 % off, the encoders resolve a radius to 0.1 %
    EXPECT_NEAR(found.castors[c].wheel_radius_left_m / actual.castors[c].wheel_radius_left_m, 1.0, 0.005);
  // On another way, in the planar world, the calibrated numbers end nearer to the truth.
  next(session);
  session.execute(ui::DriveGuide{});
  ASSERT_EQ(session.guide().view(session.jobs()).outcome->held_out.size(), 1u);
  const HeldOutError error = session.guide().view(session.jobs()).outcome->held_out[0];
  EXPECT_LT(error.after_m, 0.3 * error.before_m);
  // Left and gone on with: the recordings are read again.
  const std::string file = session.guide().file();
  session.execute(ui::LeaveGuide{});
  session.execute(ui::ResumeGuide{file});
  EXPECT_EQ(now(session).recordings.size(), 6u);
  EXPECT_TRUE(session.guide().view(session.jobs()).outcome->calibrated.has_value());
}

TEST_F(GuideTest, CalibratesTheClappersEncodersFromTheInside) {
  Session session(false, folder);
  session.execute(ui::BeginGuide{GuideKind::linked, false});
  next(session);
  next(session);
  session.execute(ui::DriveGuide{});
  ASSERT_EQ(now(session).recordings.size(), 2u);
  next(session);
  const ui::GuideView view = session.guide().view(session.jobs());
  ASSERT_TRUE(view.outcome->calibrated.has_value());
  const auto& found = std::get<Clapper>(view.outcome->calibrated->kind);
  const auto& actual = std::get<Clapper>(view.actual->kind);
  // Biases of up to 15 mrad, found to 0.7 mrad (core/calibration/README.md); four of these.
  EXPECT_NEAR(found.link_angle_a_offset_rad, actual.link_angle_a_offset_rad, 0.003);
  EXPECT_NEAR(found.link_angle_b_offset_rad, actual.link_angle_b_offset_rad, 0.003);
  next(session);
  session.execute(ui::DriveGuide{});
  ASSERT_EQ(session.guide().view(session.jobs()).outcome->held_out.size(), 1u);
  const HeldOutError error = session.guide().view(session.jobs()).outcome->held_out[0];
  EXPECT_LT(error.after_m, error.before_m);
}

TEST_F(GuideTest, TakesADroppedSquareAsARun) {
  Session session(false, folder);
  session.execute(ui::BeginGuide{GuideKind::umbmark, true});
  GuideSession s = now(session);
  s.page = s.reached = 3;
  session.execute(ui::ChangeGuide{s});
  session.execute(ui::SetMode{ui::Mode::calibrate});
  const std::string eight = std::string(ODOLAB_SOURCE_DIR) + "/assets/recordings/simulated_eight.csv";
  session.execute(ui::OpenFile{eight});
  ASSERT_EQ(session.messages().size(), 1u);  // an eight is no square, and that is said
  EXPECT_NE(session.messages()[0].text.find("square"), std::string::npos) << session.messages()[0].text;
}

// A window that is killed while a person types loses a second at most: what is older is in the file.
TEST_F(GuideTest, LosesAtMostASecondWhenKilled) {
  int said[2];
  ASSERT_EQ(::pipe(said), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    Session session(false, folder);
    session.execute(ui::BeginGuide{GuideKind::umbmark, true});
    const auto begin = std::chrono::steady_clock::now();
    double last = 0.0;
    for (int k = 1;; ++k) {  // a number typed in each picture
      const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      GuideSession g = session.guide().session();
      g.draft.measured.x_m = k;
      session.execute(ui::ChangeGuide{g});
      session.advance(s - last, kNever);
      last = s;
      const double entry[2] = {double(k), s};
      if (::write(said[1], entry, sizeof entry) != sizeof entry) ::_exit(1);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  ::close(said[1]);
  std::this_thread::sleep_for(std::chrono::milliseconds(1700));
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  std::vector<std::pair<double, double>> entries;
  double entry[2];
  while (::read(said[0], entry, sizeof entry) == sizeof entry) entries.emplace_back(entry[0], entry[1]);
  ::close(said[0]);
  ASSERT_GT(entries.size(), 5u);
  std::string file;
  for (const auto& e : std::filesystem::directory_iterator(folder))
    if (e.path().extension() == ".toml") file = e.path().string();
  const Result<GuideSession> kept = read_guide_session(file);
  ASSERT_TRUE(kept.ok()) << kept.error().message();
  for (const auto& [number, at_s] : entries)
    if (at_s < entries.back().second - 1.0) {
      EXPECT_GE(kept->draft.measured.x_m, number);
    }
  Session resumed(false, folder);
  resumed.execute(ui::ShowGuides{true});
  ASSERT_EQ(resumed.guide().view(resumed.jobs()).saved.size(), 1u);
  resumed.execute(ui::ResumeGuide{resumed.guide().view(resumed.jobs()).saved[0].path});
  EXPECT_EQ(now(resumed).draft.measured.x_m, kept->draft.measured.x_m);
}

TEST_F(GuideTest, SaysInTheWindowWhereASessionCannotBeRead) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/bad.toml") << "schema = \"odolab.guide/1\"\nguide = \"umbmark\"\npage = 99\n";
  Session session(false, folder);
  EXPECT_FALSE(session.open(folder + "/bad.toml"));
  ASSERT_EQ(session.messages().size(), 1u);
  EXPECT_FALSE(session.guide().is_open());
}

}  // namespace
}  // namespace odolab
