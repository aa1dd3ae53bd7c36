#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "source_dir.h"
#include "test/end_to_end/program.h"

namespace odolab {
namespace {

namespace fs = std::filesystem;

const std::string kVehicle = "--vehicle assets/vehicles/labmate.toml ";

// Two figure-eights of a LabMate whose left wheel is out of round and whose wheelbase is 3 mm wider than drawn, driven
// once for all tests.
const fs::path& eights() {
  static const fs::path folder = [] {
    const fs::path made = fresh_folder("diagnose_eights_" + std::to_string(::getpid()));
    std::ofstream(made / "eight.toml") << "name = \"eight\"\nvehicle = \"" ODOLAB_SOURCE_DIR
                                          "/assets/vehicles/labmate.toml\"\n"
                                          "[actual]\nwheelbase_m = 0.343\n"
                                          "[[effect]]\neffect = \"wheel_eccentricity\"\ncomponent = \"left_wheel\"\n"
                                          "amplitude = 0.01\nphase_rad = 1.2\n"
                                          "[path]\nkind = \"figure_eight\"\nradius_m = 0.8\nloops = 1\n"
                                          "[sensors]\ntruth_period_s = 0.02\ntruth_position_noise_m = 0.001\n"
                                          "truth_heading_noise_rad = 0.002\n";
    for (const char* run : {"1", "2"}) {
      odolab("run " + (made / "eight.toml").string() + " --seed " + run + " --out " + (made / run).string());
      fs::copy_file(made / run / "recording.csv", made / (std::string("run_") + run + ".csv"));
    }
    return made;
  }();
  return folder;
}

std::string eight(const char* name) { return (eights() / name).string() + " "; }

// And no file is written into `folder`.
void expect_refused_without_files(const std::string& arguments, const std::vector<std::string>& words,
                                  const fs::path& folder) {
  odolab::expect_refused(arguments, words);
  EXPECT_TRUE(fs::is_empty(folder)) << "half-written output";
}

// Root mean square distance from the truth, as predict prints it: "against the recorded truth: 2.11 mm and ...".
double predicted_mm(const std::string& arguments, const fs::path& track) {
  const Outcome outcome = odolab("predict " + arguments + "--out " + track.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::size_t at = outcome.output.find("recorded truth: ");
  return at == std::string::npos ? -1.0 : std::stod(outcome.output.substr(at + 16));
}

TEST(DiagnoseCommand, WritesJsonModelAndReport) {
  const fs::path folder = fresh_folder("diagnose_writes");
  const std::string json_file = (folder / "d.json").string(), model = (folder / "m.toml").string(),
                    html = (folder / "d.html").string();
  const Outcome outcome = odolab("diagnose " + kVehicle + eight("run_1.csv") + "--hold-out " + eight("run_2.csv") +
                                 "--json " + json_file + " --model " + model + " --html " + html);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_LE(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 25) << outcome.output;
  EXPECT_EQ(outcome.errors.find('\r'), std::string::npos) << "progress in a pipe";

  const nlohmann::json json = nlohmann::json::parse(text_of_file(json_file));
  EXPECT_EQ(json["schema"], "odolab.diagnosis/1");
  EXPECT_EQ(json["verdict"], "found");
  EXPECT_EQ(json["recordings"], (nlohmann::json{{"fitted_on", {"run_1.csv"}}, {"held_out", {"run_2.csv"}}}));
  ASSERT_FALSE(json["findings"].empty());
  EXPECT_EQ(json["findings"][0]["effect"], "wheel_eccentricity");
  EXPECT_EQ(json["findings"][0]["component"], "left_wheel");
  const nlohmann::json& amplitude = json["findings"][0]["parameters"]["amplitude"];
  EXPECT_NEAR(amplitude["value"].get<double>(), 0.01, 5.0 * amplitude["stderr"].get<double>());
  for (const char* part : {"train", "held_out"})
    for (const char* step : {"nominal", "calibrated", "with_findings", "noise_floor"})
      EXPECT_TRUE(json["fit"][part][step]["position_rms_m"].is_number()) << part << " " << step;
  // once-per-turn errors are of the heading first: the wheel's way errs by 0.75 mm to both sides, over 0.34 m of
  // wheelbase
  EXPECT_LT(json["fit"]["held_out"]["with_findings"]["heading_rms_rad"],
            json["fit"]["held_out"]["calibrated"]["heading_rms_rad"]);
  EXPECT_LT(json["simulation"]["after"]["heading_rms_rad"], json["simulation"]["before"]["heading_rms_rad"]);
  EXPECT_NE(text_of_file(html).find("<h1>What the model lacks: wheel eccentricity of the left wheel"),
            std::string::npos);

  // the model predicts the run it was not fitted on as well as the diagnosis says
  const double held_out_mm = 1e3 * json["fit"]["held_out"]["with_findings"]["position_rms_m"].get<double>();
  const double with_model_mm =
      predicted_mm(kVehicle + "--model " + model + " " + eight("run_2.csv"), folder / "with.csv");
  const double nominal_mm = predicted_mm(kVehicle + eight("run_2.csv"), folder / "without.csv");
  EXPECT_NEAR(with_model_mm, held_out_mm, 0.02);  // printed to a hundredth
  EXPECT_LT(with_model_mm, nominal_mm);
}

TEST(DiagnoseCommand, SaysTheSameTwice) {
  const fs::path folder = fresh_folder("diagnose_twice");
  for (const char* name : {"a.json", "b.json"})
    ASSERT_EQ(odolab("diagnose " + kVehicle + eight("run_1.csv") + "--json " + (folder / name).string()).exit_code, 0);
  EXPECT_EQ(text_of_file(folder / "a.json"), text_of_file(folder / "b.json"));
}

TEST(DiagnoseCommand, NamesABrokenRecordingAndGoesOnOnlyIfTold) {
  const fs::path folder = fresh_folder("diagnose_broken"), out = fresh_folder("diagnose_broken_out");
  std::ofstream(folder / "broken.csv")
      << "time_s,left_wheel_rad,right_wheel_rad,truth_x_m,truth_y_m\n0,0,0,0,0\n1,zero,0,0,0\n";
  std::ofstream(folder / "no_truth.csv") << "time_s,left_wheel_rad,right_wheel_rad\n0,0,0\n1,1,1\n2,2,2\n";
  const std::string broken = (folder / "broken.csv").string() + " ",
                    no_truth = (folder / "no_truth.csv").string() + " ";
  const std::string json = "--json " + (out / "d.json").string();
  expect_refused_without_files("diagnose " + kVehicle + eight("run_1.csv") + broken + json, {"broken.csv:3"}, out);
  expect_refused_without_files("diagnose " + kVehicle + eight("run_1.csv") + no_truth + json, {"no_truth.csv", "truth"},
                               out);
  expect_refused_without_files(
      "diagnose " + kVehicle + eight("run_1.csv") + (folder / "absent.csv").string() + " " + json, {"absent.csv"}, out);
  // wheels exchanged in one of two runs
  std::string text = text_of_file(eights() / "run_2.csv");
  const std::size_t left = text.find("left_wheel_rad"), right = text.find("right_wheel_rad");
  ASSERT_LT(left, right);
  text.replace(right, 15, "left_wheel_rad").replace(left, 14, "right_wheel_rad");
  std::ofstream(folder / "exchanged.csv") << text;
  const std::string exchanged = (folder / "exchanged.csv").string() + " ";
  expect_refused_without_files("diagnose " + kVehicle + eight("run_1.csv") + exchanged + json,
                               {"exchanged.csv", "left and right"}, out);
  const Outcome without = odolab("diagnose --skip-broken " + kVehicle + eight("run_1.csv") + exchanged);
  EXPECT_EQ(without.exit_code, 0) << without.errors;
  EXPECT_NE(without.errors.find("skipped: " + (folder / "exchanged.csv").string()), std::string::npos)
      << without.errors;
  const Outcome outcome = odolab("diagnose --skip-broken " + kVehicle + eight("run_1.csv") + broken + no_truth + json);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("broken.csv:3"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("no_truth.csv"), std::string::npos) << outcome.errors;
  EXPECT_TRUE(fs::exists(out / "d.json"));
}

TEST(DiagnoseCommand, RefusesWhatProvesNothing) {
  const fs::path out = fresh_folder("diagnose_refuses");
  const std::string json = "--json " + (out / "d.json").string();
  expect_refused_without_files("diagnose " + kVehicle + eight("run_1.csv") + "--hold-out " + eight("run_1.csv") + json,
                               {"run_1.csv", "hold out"}, out);
  expect_refused_without_files("diagnose " + kVehicle + json, {"RECORDING"}, out);
  const Outcome nothing_left = odolab("diagnose --skip-broken " + kVehicle + "/absent.csv " + json);
  EXPECT_EQ(nothing_left.exit_code, 2);
  EXPECT_NE(nothing_left.errors.find("no recording that can be used"), std::string::npos) << nothing_left.errors;
  EXPECT_TRUE(fs::is_empty(out));
}

TEST(DiagnoseCommand, RefusesABrokenModel) {
  const fs::path folder = fresh_folder("diagnose_model"), out = fresh_folder("diagnose_model_out");
  std::ofstream(folder / "m.toml")
      << "schema = \"odolab.model/1\"\n[vehicle]\nkind = \"differential_drive\"\nwheels = 2\n"
         "[vehicle.differential_drive]\nwheel_radius_left_m = 0.075\nwheel_radius_right_m = 0.075\n"
         "wheelbase_m = 0.34\n";
  expect_refused_without_files("predict " + kVehicle + "--model " + (folder / "m.toml").string() + " " +
                                   eight("run_1.csv") + "--out " + (out / "t.csv").string(),
                               {"m.toml:4", "wheels"}, out);
}

TEST(DiagnoseCommand, WritesOverNothingThatItReads) {
  const fs::path folder = fresh_folder("diagnose_overwrites");
  const fs::path copy = folder / "run.csv";
  fs::copy_file(eights() / "run_1.csv", copy);
  const std::string before = text_of_file(copy);
  for (const char* option : {"--json ", "--model ", "--html "})
    odolab::expect_refused("diagnose " + kVehicle + copy.string() + " " + option + copy.string(), {copy.string()});
  odolab::expect_refused("predict " + kVehicle + copy.string() + " --out " + copy.string(), {copy.string()});
  odolab::expect_refused("calibrate " + kVehicle + copy.string() + " --out " + copy.string(), {copy.string()});
  odolab::expect_refused("export " + copy.string() + " --to tum --out " + copy.string(), {copy.string()});
  odolab::expect_refused("diagnose " + kVehicle + copy.string() + " --json " + (folder / "a").string() + " --html " +
                             (folder / "a").string(),
                         {"two outputs"});
  EXPECT_EQ(text_of_file(copy), before);
}

TEST(DiagnoseCommand, TakesEachRunOnce) {
  const fs::path folder = fresh_folder("diagnose_twice");
  fs::copy_file(eights() / "run_1.csv", folder / "copy.csv");
  for (const char* as : {"", "--hold-out "})
    odolab::expect_refused("diagnose " + kVehicle + eight("run_1.csv") + as + (folder / "copy.csv").string(),
                           {"copy.csv", "the same run", "run_1.csv"});
}

}  // namespace
}  // namespace odolab
