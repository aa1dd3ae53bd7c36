#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "source_dir.h"
#include "test/end_to_end/program.h"

namespace odolab {
namespace {

namespace fs = std::filesystem;

const std::string kLabMate = "assets/vehicles/labmate.toml";

using odolab::expect_refused;

// And nothing at all is written there.
void expect_refused(const std::string& arguments, const std::vector<std::string>& words, const fs::path& out) {
  odolab::expect_refused(arguments, words);
  EXPECT_FALSE(fs::exists(out)) << "half-written output";
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

TEST(CommandLine, EveryScenarioMeetsItsExpectations) {
  const fs::path folder = fresh_folder("scenarios");
  for (const auto& entry : fs::directory_iterator(ODOLAB_SOURCE_DIR "/assets/scenarios")) {
    const std::string text = text_of_file(entry.path());
    if (text.find("shared/recordings") != std::string::npos &&
        !fs::exists(ODOLAB_SOURCE_DIR "/../shared/recordings/optiodom")) {
      std::printf("  %s needs ../shared/recordings, which is not here\n", entry.path().filename().c_str());
      continue;
    }
    const fs::path out = folder / entry.path().stem();
    const Outcome outcome = odolab("run '" + entry.path().string() + "' --check --out '" + out.string() + "'");
    EXPECT_EQ(outcome.exit_code, 0) << entry.path() << "\n" << outcome.output << outcome.errors;
    EXPECT_TRUE(fs::exists(out / "summary.json"));
    EXPECT_TRUE(fs::exists(out / "report.html"));
  }
}

TEST(CommandLine, RefusesInOneLineWhatAKindOfVehicleCannotDo) {
  const std::string clapper = "assets/vehicles/clapper.toml", run = "assets/recordings/simulated_eight.csv";
  expect_refused("diagnose --vehicle " + clapper + " " + run, {"a_left_wheel_rad", "clapper"});
  expect_refused("calibrate --vehicle " + clapper + " " + run, {"clapper"});
  expect_refused("predict --vehicle " + clapper + " " + run + " --out /dev/null", {"a_left_wheel_rad", "clapper"});
}

// A body that turns about castor 1's pivot, the two others settled on their circle: by hand from Eqs. 4 to 7 with
// wheels of 51 mm where the file says 50.
std::string about_castor_1(bool clockwise) {
  const double pivots_apart_m = 0.25 * std::sqrt(3.0), gamma = std::asin(0.05 / pivots_apart_m);
  const double axle_m = pivots_apart_m * std::cos(gamma), pi = std::acos(-1.0);
  std::string text = "time_s";
  for (int i = 1; i <= 3; ++i)
    for (const char* what : {"_left_wheel_rad", "_right_wheel_rad", "_pivot_rad"})
      text += ",castor" + std::to_string(i) + what;
  for (int k = 0; k <= 40; ++k) {
    const double turn = 0.05 * k, inner = turn * (axle_m - 0.06) / 0.051, outer = turn * (axle_m + 0.06) / 0.051;
    const double sign = clockwise ? 1.0 : -1.0;
    text += "\n" + std::to_string(0.1 * k) + ",0,0," + std::to_string(sign * turn);
    for (const double bearing : {5.0 / 6.0 * pi, -5.0 / 6.0 * pi}) {
      const double pivot = bearing - sign * (0.5 * pi - gamma);
      text += "," + std::to_string(clockwise ? outer : inner) + "," + std::to_string(clockwise ? inner : outer) + "," +
              std::to_string(pivot);
    }
  }
  return text + "\n";
}

TEST(CommandLine, CalibratesCastorsFromTheirOwnEncoders) {
  const fs::path folder = fresh_folder("castors");
  write(folder / "cw.csv", about_castor_1(true));
  write(folder / "ccw.csv", about_castor_1(false));
  const Outcome outcome =
      odolab("calibrate --vehicle assets/vehicles/three_castors.toml " + (folder / "cw.csv").string() + " " +
             (folder / "ccw.csv").string() + " --out " + (folder / "calibrated.toml").string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::size_t row = outcome.output.find("castor[2].wheel_radius_left_m");
  ASSERT_NE(row, std::string::npos) << outcome.output;
  std::istringstream cells(outcome.output.substr(row, 80));
  std::string name, before;
  double radius_m = 0.0;
  cells >> name >> before >> radius_m;
  EXPECT_NEAR(radius_m, 0.051, 5e-5);  // 2 rad of turn by encoders of 1.2 and 5 mrad: a part in a thousand
  EXPECT_NE(outcome.output.find("cannot tell: castor 1"), std::string::npos);  // it was the still one
  EXPECT_EQ(odolab("predict --vehicle " + (folder / "calibrated.toml").string() + " " + (folder / "cw.csv").string() +
                   " --out " + (folder / "track.csv").string())
                .exit_code,
            0);
}

TEST(CommandLine, FailedExpectationExitsWithOne) {
  const fs::path folder = fresh_folder("expectation");
  std::string text = text_of_file(ODOLAB_SOURCE_DIR "/assets/scenarios/no_error.toml");
  text.replace(text.find("../vehicles"), 2, ODOLAB_SOURCE_DIR "/assets");
  text.replace(text.find("at_most = 0.006"), 15, "at_most = 1e-9");
  write(folder / "strict.toml", text);
  EXPECT_EQ(
      odolab("run " + (folder / "strict.toml").string() + " --check --out " + (folder / "out").string()).exit_code, 1);
  EXPECT_EQ(odolab("run " + (folder / "strict.toml").string() + " --out " + (folder / "out").string()).exit_code, 0);
}

TEST(CommandLine, CalibratesWhatItSimulated) {
  const fs::path folder = fresh_folder("calibrate");
  // A figure-eight of a robot whose wheelbase is 5 mm wider and whose left wheel is 0.2 mm larger than drawn.
  write(folder / "eight.toml",
        "name = \"eight\"\nvehicle = \"" ODOLAB_SOURCE_DIR
        "/assets/vehicles/labmate.toml\"\n"
        "[actual]\nwheelbase_m = 0.345\nwheel_radius_left_m = 0.0752\n"
        "[path]\nkind = \"figure_eight\"\nradius_m = 0.8\nloops = 1\n"
        "[sensors]\ntruth_period_s = 0.02\ntruth_position_noise_m = 0.001\ntruth_heading_noise_rad = 0.002\n");
  for (const char* seed : {"1", "2"})
    ASSERT_EQ(
        odolab("run " + (folder / "eight.toml").string() + " --seed " + seed + " --out " + (folder / seed).string())
            .exit_code,
        0);
  const std::string recordings = (folder / "1/recording.csv").string() + " " + (folder / "2/recording.csv").string();
  const Outcome fitted =
      odolab("calibrate --vehicle " + kLabMate + " " + recordings + " --out " + (folder / "fitted.toml").string());
  ASSERT_EQ(fitted.exit_code, 0) << fitted.errors;
  const auto value_of = [&](const std::string& key) {
    const std::string text = text_of_file(folder / "fitted.toml");
    return std::stod(text.substr(text.find(key + " = ") + key.size() + 3));
  };
  EXPECT_NEAR(value_of("wheelbase_m"), 0.345, 5e-4);  // ten times what 1 mm of truth noise leaves over 10 m
  EXPECT_NEAR(value_of("wheel_radius_left_m"), 0.0752, 3e-5);
  EXPECT_NEAR(value_of("wheel_radius_right_m"), 0.075, 3e-5);
  const Outcome predicted = odolab("predict --vehicle " + (folder / "fitted.toml").string() + " " +
                                   (folder / "2/recording.csv").string() + " --out " + (folder / "track.csv").string());
  EXPECT_EQ(predicted.exit_code, 0) << predicted.errors;
  EXPECT_EQ(text_of_file(folder / "track.csv").substr(0, 27), "time_s,x_m,y_m,heading_rad\n");
}

// A drive in figures of eight by a robot whose wheels are that many times as large as drawn; where it is recorded.
std::string recorded_eight(const fs::path& folder, const std::string& name, double wheels_times) {
  write(folder / (name + ".toml"),
        "name = \"eight\"\nvehicle = \"" ODOLAB_SOURCE_DIR
        "/assets/vehicles/labmate.toml\"\n[actual]\nwheel_radius_left_m = " +
            std::to_string(0.075 * wheels_times) + "\nwheel_radius_right_m = " + std::to_string(0.075 * wheels_times) +
            "\n[path]\nkind = \"figure_eight\"\nradius_m = 0.8\nloops = 1\n[sensors]\ntruth_period_s = 0.02\n"
            "truth_position_noise_m = 0.001\ntruth_heading_noise_rad = 0.002\n");
  EXPECT_EQ(odolab("run " + (folder / (name + ".toml")).string() + " --out " + (folder / name).string()).exit_code, 0);
  fs::rename(folder / name / "recording.csv", folder / (name + ".csv"));
  return " " + (folder / (name + ".csv")).string();
}

TEST(CommandLine, CalibrateNamesTheRecordingOfAnotherRobot) {
  const fs::path folder = fresh_folder("odd");
  const std::string calibrate = "calibrate --vehicle " + kLabMate, one = recorded_eight(folder, "one", 1.0),
                    two = recorded_eight(folder, "two", 1.001), other = recorded_eight(folder, "other", 0.9);
  const Outcome mixed = odolab(calibrate + one + other + two);
  EXPECT_EQ(mixed.exit_code, 0);
  EXPECT_NE(mixed.errors.find("warning: other.csv does not go with one.csv and two.csv"), std::string::npos)
      << mixed.errors;
  EXPECT_NE(mixed.errors.find("each recording predicted from the others errs by"), std::string::npos) << mixed.errors;
  const Outcome alike = odolab(calibrate + one + two);
  EXPECT_EQ(alike.exit_code, 0);
  EXPECT_EQ(alike.errors.find("does not go with"), std::string::npos) << alike.errors;
  EXPECT_EQ(alike.errors.find("errs by"), std::string::npos) << alike.errors;
}

TEST(CommandLine, CalibrateCountsNoTruthThatItSetAside) {
  const fs::path folder = fresh_folder("set_aside");
  std::istringstream whole(text_of_file(ODOLAB_SOURCE_DIR "/assets/recordings/simulated_eight.csv"));
  std::string text;
  int row = 0;
  for (std::string line; std::getline(whole, line); ++row) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    if (row > 0 && row % 50 == 0 && cells.size() == 6 && !cells[3].empty()) cells[3] = cells[4] = cells[5] = "9";
    for (const std::string& cell : cells) text += (&cell == &cells.front() ? "" : ",") + cell;
    text += "\n";
  }
  write(folder / "lost.csv", text);
  const Outcome found = odolab("calibrate --vehicle " + kLabMate + " " + (folder / "lost.csv").string());
  ASSERT_EQ(found.exit_code, 0) << found.errors;
  const std::size_t after = found.output.find("after ", found.output.find("error gathered"));
  ASSERT_NE(after, std::string::npos) << found.output;
  EXPECT_LT(std::stod(found.output.substr(after + 6)), 20.0) << found.output;  // mm; the truth errs by metres at times
}

// A script that goes on with the file would take what lay there before.
TEST(CommandLine, CalibrateFailsWhereItWasToWriteAVehicleAndDeterminedNothing) {
  const fs::path folder = fresh_folder("nothing_determined");
  std::string rests = "time_s,left_wheel_rad,right_wheel_rad,truth_x_m,truth_y_m,truth_heading_rad\n";
  for (int i = 0; i < 400; ++i)
    rests += std::to_string(0.02 * i) + ",0,0," + std::to_string(1e-3 * std::sin(7.0 * i)) + "," +
             std::to_string(1e-3 * std::cos(11.0 * i)) + "," + std::to_string(1e-3 * std::sin(13.0 * i)) + "\n";
  write(folder / "rests.csv", rests);
  const std::string calibrate = "calibrate --vehicle " + kLabMate + " " + (folder / "rests.csv").string();
  const Outcome asked = odolab(calibrate + " --out " + (folder / "v.toml").string());
  EXPECT_NE(asked.exit_code, 0) << asked.output;
  EXPECT_NE(asked.errors.find("v.toml"), std::string::npos) << asked.errors;
  EXPECT_FALSE(fs::exists(folder / "v.toml"));
}

TEST(CommandLine, RefusesBadInputWithOneLine) {
  const fs::path folder = fresh_folder("bad_input");
  const auto path = [&](const char* name) { return (folder / name).string(); };
  write(folder / "no_column.csv", "time_s,left_wheel_rad\n0,0\n1,1\n");
  write(folder / "no_number.csv",
        "time_s,left_wheel_rad,right_wheel_rad,truth_x_m,truth_y_m\n0,0,0,0,0\n1,abc,1,0,0\n");
  write(folder / "back.csv",
        "time_s,left_wheel_rad,right_wheel_rad,truth_x_m,truth_y_m\n0,0,0,0,0\n2,1,1,0,0\n1,1,1,0,0\n");
  write(folder / "cut.csv", "time_s,left_wheel_rad,right_wheel_rad,truth_x_m,truth_y_m\n0,0,0,0,0\n1,1,1");
  const std::string predict = "predict --vehicle " + kLabMate + " --out " + path("track.csv") + " ";
  expect_refused(predict + path("no_column.csv"), {"no_column.csv", "right_wheel_rad"}, folder / "track.csv");
  expect_refused(predict + path("no_number.csv"), {"no_number.csv:3", "abc", "number"}, folder / "track.csv");
  expect_refused(predict + path("back.csv"), {"back.csv:4", "time_s"}, folder / "track.csv");
  expect_refused(predict + path("cut.csv"), {"cut.csv:3"}, folder / "track.csv");
  expect_refused(predict + path("absent.csv"), {"absent.csv"}, folder / "track.csv");

  std::string vehicle = text_of_file(ODOLAB_SOURCE_DIR "/assets/vehicles/labmate.toml");
  std::string zero = vehicle, misspelt = vehicle;
  zero.replace(zero.find("right_m = 0.075"), 15, "right_m = 0");
  misspelt.replace(misspelt.find("wheelbase_m"), 11, "wheelbase_mm");
  write(folder / "zero.toml", zero);
  write(folder / "misspelt.toml", misspelt);
  write(folder / "cut.toml", vehicle.substr(0, vehicle.size() - 10) + " =");
  const std::string calibrate = "calibrate " + path("back.csv") + " --out " + path("v.toml") + " --vehicle ";
  expect_refused(calibrate + path("zero.toml"), {"zero.toml:7", "wheel_radius_right_m", "found 0", "above 0"},
                 folder / "v.toml");
  expect_refused(calibrate + path("misspelt.toml"), {"misspelt.toml:8", "wheelbase_mm", "nearest", "wheelbase_m"},
                 folder / "v.toml");
  expect_refused(calibrate + path("cut.toml"), {"cut.toml:"}, folder / "v.toml");
  write(folder / "whole.toml", vehicle);
  expect_refused("calibrate --vehicle " + path("whole.toml") + " --out " + path("whole.toml") + " " + path("back.csv"),
                 {"whole.toml", "lost"});
  EXPECT_EQ(text_of_file(folder / "whole.toml"), vehicle);
  write(folder / "own_names.csv", "time_s,enc_l,enc_r,truth_x_m,truth_y_m\n0,0,0,0,0\n1,1,1,0,0\n");
  expect_refused("diagnose --vehicle " + kLabMate + " " + path("own_names.csv"), {"enc_l", "left_wheel_rad", "--map"});

  write(folder / "key.toml",
        "name = \"x\"\nvehicle = \"" ODOLAB_SOURCE_DIR "/assets/vehicles/labmate.toml\"\n[flor]\nfriction = 0.5\n");
  expect_refused("run " + path("key.toml") + " --out " + path("run"), {"key.toml:3", "flor", "floor"}, folder / "run");
  expect_refused("run " + path("nothing.toml") + " --out " + path("run"), {"nothing.toml"}, folder / "run");
  expect_refused("run x.toml --no-such-option", {"--no-such-option"});
  expect_refused("reproduce umbmark --seed 7up", {"--seed", "found '7up'", "expected a whole number"});
  expect_refused("import x.csv --period 10ms", {"--period", "found '10ms'", "expected a number"});
  expect_refused("no_such_command", {"no_such_command"});
  expect_refused("diagnoze x.csv", {"diagnoze", "the nearest is diagnose"});
  expect_refused("import " + path("cut.toml") + " --out " + path("i.csv"), {"cut.toml"}, folder / "i.csv");
}

// Runs the program on a recording that is a pipe, and interrupts it while it reads.
Outcome interrupted_while_reading(std::vector<std::string> words, const fs::path& folder) {
  const std::string pipe = (folder / "pipe.csv").string(), said = (folder / "said").string();
  ::mkfifo(pipe.c_str(), 0600);
  words.insert(words.begin(), ODOLAB_PROGRAM);
  words.push_back(pipe);
  const pid_t program = ::fork();
  if (program == 0) {
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
      ::dup2(::open((said + std::to_string(stream)).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), stream);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    ::execv(ODOLAB_PROGRAM, arguments.data());
    ::_exit(127);
  }
  const int feed = ::open(pipe.c_str(), O_WRONLY);  // waits until the program reads
  ::kill(program, SIGINT);
  const std::string more = "time_s,left_wheel_rad,right_wheel_rad\n0,0,0\n";
  EXPECT_EQ(::write(feed, more.data(), more.size()), static_cast<ssize_t>(more.size()));
  int status = 0, tenths = 0;
  while (::waitpid(program, &status, WNOHANG) == 0 && ++tenths < 100) ::usleep(100000);
  ::close(feed);  // and not before: it must not wait for the end of the file
  if (tenths == 100) ::waitpid(program, &status, 0);
  ::unlink(pipe.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of_file(said + "1"), text_of_file(said + "2")};
}

TEST(CommandLine, StopsCleanlyWhenInterruptedWhileItReads) {
  const fs::path folder = fresh_folder("interrupted");
  const std::string out = (folder / "out").string(), vehicle = ODOLAB_SOURCE_DIR "/assets/vehicles/labmate.toml";
  for (const auto& [command, option] :
       {std::pair{"predict", "--out"}, {"calibrate", "--out"}, {"diagnose", "--json"}}) {
    const Outcome outcome = interrupted_while_reading({command, "--vehicle", vehicle, option, out}, folder);
    EXPECT_EQ(outcome.exit_code, 130) << command;
    EXPECT_EQ(outcome.errors, std::string(command) + ": stopped before its end; nothing was written\n");
    EXPECT_EQ(outcome.output, "") << command;
    EXPECT_FALSE(fs::exists(out)) << command;
  }
}

TEST(CommandLine, RefusesWhatCannotBeWrittenBeforeTheWork) {
  const fs::path folder = fresh_folder("unwritable");
  write(folder / "file", "");
  const std::string run = "assets/recordings/simulated_eight.csv", json = (folder / "out.json").string();
  const std::string below_a_file = (folder / "file/x").string();
  for (const std::string& command :
       {"diagnose --vehicle " + kLabMate + " " + run + " --json " + json + " --html " + below_a_file,
        "diagnose --vehicle absent.toml " + run + " --json " + json + " --model " + below_a_file,
        "calibrate --vehicle " + kLabMate + " " + run + " --out " + below_a_file,
        "predict --vehicle " + kLabMate + " " + run + " --out " + below_a_file,
        "run assets/scenarios/no_error.toml --out " + below_a_file, "import " + run + " --out " + below_a_file})
    expect_refused(command, {below_a_file, "found not a directory", "a file that can be written"}, folder / "out.json");
}

TEST(CommandLine, TakesADashForStandardOutputAndMixesNothingIntoIt) {
  const std::string run = "assets/recordings/simulated_eight.csv", given = " --vehicle " + kLabMate + " " + run;
  const Outcome track = odolab("predict" + given + " --out -");
  EXPECT_EQ(track.exit_code, 0) << track.errors;
  EXPECT_EQ(track.output.rfind("time_s,x_m,y_m,heading_rad\n", 0), 0u) << track.output.substr(0, 200);
  EXPECT_EQ(track.output.find("poses"), std::string::npos);
  EXPECT_NE(track.errors.find("standard output: "), std::string::npos) << track.errors;

  const Outcome vehicle = odolab("calibrate" + given + " --out -");
  EXPECT_EQ(vehicle.exit_code, 0) << vehicle.errors;
  EXPECT_NE(vehicle.output.find("kind = \"differential_drive\""), std::string::npos) << vehicle.output;
  EXPECT_EQ(vehicle.output.find("written:"), std::string::npos);
  EXPECT_NE(vehicle.errors.find("written: standard output"), std::string::npos) << vehicle.errors;

  expect_refused("diagnose" + given + " --json - --html -", {"standard output", "one file for two outputs"});
  expect_refused("run assets/scenarios/no_error.toml --out -", {"--out", "found '-'", "a folder"});
  EXPECT_FALSE(fs::exists(ODOLAB_SOURCE_DIR "/-"));
}

TEST(CommandLine, SaysThatACommandTakesOneRecording) {
  const Outcome several = odolab("predict --vehicle v.toml a.csv b.csv c.csv --out t.csv");
  EXPECT_EQ(several.exit_code, 2);
  EXPECT_EQ(several.errors,
            "odolab predict: found b.csv besides a.csv, expected one RECORDING; see odolab predict --help\n");
}

TEST(CommandLine, HelpSaysWhichWordsAreReadAsEmptyCells) {
  for (const char* command : {"calibrate", "diagnose", "predict"})
    EXPECT_NE(odolab(std::string(command) + " --help").output.find("(nan, NA"), std::string::npos) << command;
}

TEST(CommandLine, HelpOfDiagnoseSaysWhichFindingsAreOfPhysics) {
  const std::string help = odolab("diagnose --help").output;
  for (const char* word : {"verdict is found", "truth_", "clock_rate", "encoder_data_fault"})
    EXPECT_NE(help.find(word), std::string::npos) << help;
}

TEST(CommandLine, HelpShowsAnExampleOfEachCommand) {
  for (const char* command : {"gui", "run", "calibrate", "predict", "import"}) {
    const Outcome help = odolab(std::string(command) + " --help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.output.find("odolab " + std::string(command)), std::string::npos) << help.output;
    EXPECT_EQ(odolab("help " + std::string(command)).output, help.output);
  }
}

}  // namespace
}  // namespace odolab
