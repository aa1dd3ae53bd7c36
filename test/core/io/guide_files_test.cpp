#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "core/base/random.h"
#include "core/io/guide_report.h"
#include "core/io/guide_toml.h"
#include "core/io/ros2_yaml.h"
#include "core/io/whole_file.h"

namespace odolab {
namespace {

std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("odolab_" + std::to_string(::getpid()) + "_" + name)).string();
}

GuideSession some_session() {
  GuideSession s;
  s.vehicle.name = "Our \"robot\"";
  s.vehicle.kind = DifferentialDrive{0.07512345678901234, 0.075, 0.34, 512.0, 30.0, 16};
  s.page = 3;
  s.reached = 4;
  s.runs_each_way = 4;
  s.tape = TapeReading{4.0, 3.987, 0.0015};
  s.draft.measured.x_m = 0.0123;
  for (int i = 0; i < 6; ++i) {
    GuideRun run;
    run.clockwise = i % 2 == 0;
    run.measured = {0.1 / 3.0 * i, -0.05 * i, 0.01};
    run.odometry = {0.001, 0.002, 0.0};
    run.left_out = i == 4;
    run.source = i ? "typed" : "run \\ 1.csv";
    enter_run(s, PageTask::runs, run);
  }
  return s;
}

TEST(GuideFile, ComesBackAsItWasWritten) {
  const std::string path = temporary("guide.toml");
  const GuideSession written = some_session();
  ASSERT_TRUE(write_guide_session(path, written).ok());
  const Result<GuideSession> read = read_guide_session(path);
  ASSERT_TRUE(read.ok()) << read.error().message();
  EXPECT_EQ(read->kind, written.kind);
  EXPECT_EQ(read->page, 3);
  EXPECT_EQ(read->vehicle.name, written.vehicle.name);
  EXPECT_EQ(std::get<DifferentialDrive>(read->vehicle.kind).wheel_radius_left_m, 0.07512345678901234);
  EXPECT_EQ(read->tape->actual_m, 3.987);
  EXPECT_EQ(read->draft.measured.x_m, 0.0123);
  ASSERT_EQ(read->rounds.size(), 1u);
  EXPECT_EQ(read->rounds[0].nominal.wheel_radius_left_m, written.rounds[0].nominal.wheel_radius_left_m);
  EXPECT_EQ(read->rounds[0].nominal.gear_ratio, 30.0);
  ASSERT_EQ(read->rounds[0].runs.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(read->rounds[0].runs[i].measured.x_m, written.rounds[0].runs[i].measured.x_m);
    EXPECT_EQ(read->rounds[0].runs[i].source, written.rounds[0].runs[i].source);
    EXPECT_EQ(read->rounds[0].runs[i].left_out, i == 4);
  }
  std::filesystem::remove(path);
}

TEST(GuideFile, NamesTheLineThatIsWrong) {
  const std::string path = temporary("bad_guide.toml");
  ASSERT_TRUE(write_guide_session(path, some_session()).ok());
  const std::string good = *read_whole_file(path);
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"schema = \"odolab.guide/1\"", "schema = \"odolab.guide/9\""},
        {"guide = \"umbmark\"", "guide = \"waltz\""},
        {"page = 3", "page = 44"},
        {"page = 3", "pgae = 3"}}) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    std::ofstream(path) << text;
    const Result<GuideSession> read = read_guide_session(path);
    ASSERT_FALSE(read.ok()) << to;
    EXPECT_NE(read.error().message().find(path), std::string::npos) << read.error().message();
  }
  std::filesystem::remove(path);
}

// A process that enters one number after the other and saves each, killed in the middle: what it said was saved is
// there.
TEST(GuideFile, SurvivesAKillAtAnyMomentWhole) {
  const std::string path = temporary("killed_guide.toml");
  Random random(3);
  for (int trial = 0; trial < 8; ++trial) {
    std::filesystem::remove(path);
    int said[2];
    ASSERT_EQ(::pipe(said), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      GuideSession s = some_session();
      for (int k = 1;; ++k) {
        s.runs_each_way = k;
        if (!write_guide_session(path, s).ok()) ::_exit(1);
        if (::write(said[1], &k, sizeof k) != sizeof k) ::_exit(1);
      }
    }
    ::close(said[1]);
    std::this_thread::sleep_for(std::chrono::microseconds(20000 + int(40000 * random.uniform())));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    int last = 0, k = 0;
    while (::read(said[0], &k, sizeof k) == sizeof k) last = k;
    ::close(said[0]);
    if (last == 0) continue;  // a disk so slow that nothing was said to be saved
    const Result<GuideSession> read = read_guide_session(path);
    ASSERT_TRUE(read.ok()) << read.error().message();
    EXPECT_GE(read->runs_each_way, last);
    EXPECT_LE(read->runs_each_way, last + 1);  // one more may have been written, but not said
  }
  for (const auto& left : std::filesystem::directory_iterator(std::filesystem::temp_directory_path()))
    if (left.path().string().rfind(path, 0) == 0) std::filesystem::remove(left.path());
}

TEST(Ros2Yaml, MultipliesBackToTheCalibratedDrive) {
  const DifferentialDrive nominal;
  DifferentialDrive calibrated = nominal;
  calibrated.wheel_radius_left_m = 0.0749;
  calibrated.wheel_radius_right_m = 0.0752;
  calibrated.wheelbase_m = 0.337;
  const std::string text = ros2_diff_drive_yaml(nominal, calibrated);
  const auto value = [&](const std::string& key) {
    const std::size_t at = text.find("    " + key + ": ");
    EXPECT_NE(at, std::string::npos) << key;
    return std::stod(text.substr(at + key.size() + 6));
  };
  EXPECT_NEAR(value("wheel_radius") * value("left_wheel_radius_multiplier"), 0.0749, 1e-15);
  EXPECT_NEAR(value("wheel_radius") * value("right_wheel_radius_multiplier"), 0.0752, 1e-15);
  EXPECT_NEAR(value("wheel_separation") * value("wheel_separation_multiplier"), 0.337, 1e-15);
  EXPECT_NE(ros2_diff_drive_yaml(nominal, nominal).find("wheel_separation_multiplier: 1.0\n"), std::string::npos);
}

TEST(GuideReport, HoldsEveryRunAndEscapesWhatPeopleTyped) {
  GuideSession session = some_session();
  session.vehicle.name = "<b>Robot</b>";
  const std::string page = guide_report(session, outcome_of(session)).text();
  EXPECT_EQ(page.find("<b>Robot"), std::string::npos);
  for (const char* run : {"cw 1", "cw 2", "cw 3", "ccw 1", "ccw 2", "ccw 3", "left out", "<svg"})
    EXPECT_NE(page.find(run), std::string::npos) << run;
  EXPECT_EQ(page.find("http://www.w3.org/1999/xhtml\" src"), std::string::npos);
}

}  // namespace
}  // namespace odolab
