// The two stories of the README: what hides, and is found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "source_dir.h"
#include "test/end_to_end/program.h"

namespace odolab {
namespace {

namespace fs = std::filesystem;

const std::string kAssets = ODOLAB_SOURCE_DIR "/assets/";

// Drives two scenarios and diagnoses their recordings.
nlohmann::json diagnosed(const std::string& first, const std::string& second, const std::string& vehicle) {
  const fs::path folder = fresh_folder("story_" + first);
  std::string recordings;
  for (const std::string& name : {first, second}) {
    EXPECT_EQ(odolab("run " + kAssets + "scenarios/" + name + ".toml --out " + (folder / name).string()).exit_code, 0);
    recordings += (folder / name / "recording.csv").string() + " ";
  }
  const fs::path json = folder / "diagnosis.json";
  const Outcome outcome = odolab("diagnose --vehicle " + kAssets + "vehicles/" + vehicle + ".toml " + recordings +
                                 "--json " + json.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  return nlohmann::json::parse(text_of_file(json));
}

TEST(Stories, ScrubThatUmbmarkDoesNotSeeIsFound) {
  const nlohmann::json d = diagnosed("hidden_scrub_eight", "hidden_scrub_points", "labmate_after_umbmark");
  ASSERT_FALSE(d["findings"].empty());
  EXPECT_EQ(d["findings"][0]["effect"], "turn_scrub");
  // 3 % were put in; the report of the diagnosis is within a tenth of that.
  EXPECT_NEAR(d["findings"][0]["parameters"]["per_radps"]["value"].get<double>(), 0.03, 0.003);
}

TEST(Stories, APatchThatUndoesItselfAtTheReturnIsFoundWhereItLies) {
  const nlohmann::json d = diagnosed("hidden_patch_there_and_back", "hidden_patch_points", "labmate");
  ASSERT_FALSE(d["findings"].empty());
  EXPECT_EQ(d["findings"][0]["effect"], "slip_zone");
  const nlohmann::json& zone = d["findings"][0]["where"]["zone"];
  EXPECT_LT(std::hypot(zone["x_m"].get<double>() - 1.5, zone["y_m"].get<double>() - 0.3), 0.2);  // the bar of the proof
}

// The lessons keep telling the truth: each step as its lesson expects.
class LessonStories : public ::testing::TestWithParam<std::string> {};

TEST_P(LessonStories, HoldsWhatItSays) {
  const Outcome checked = odolab("run 'assets/lessons/" + GetParam() + ".toml' --check");
  EXPECT_EQ(checked.exit_code, 0) << checked.output << checked.errors;
  EXPECT_NE(checked.output.find("ok: "), std::string::npos);
}

std::vector<std::string> lessons() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(ODOLAB_SOURCE_DIR "/assets/lessons"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Lessons, LessonStories, ::testing::ValuesIn(lessons()),
                         [](const auto& info) { return "of_" + info.param; });

TEST(LessonsStories, ALessonThatNoLongerHoldsFailsAndABrokenOneIsBadInput) {
  const auto folder = fresh_folder("lessons");
  std::ofstream(folder / "wrong.toml")
      << "lesson = \"Wrong\"\n[[step]]\ntitle = \"One\"\ntext = \"Words\"\nscenario = \"" ODOLAB_SOURCE_DIR
         "/assets/scenarios/no_error.toml\"\n[[step.check]]\nfigure = \"end_position_error_m\"\nat_least = 1.0\n";
  std::ofstream(folder / "broken.toml") << "lesson = \"Broken\"\n[[step]]\ntitle = 3\n";
  EXPECT_EQ(odolab("run '" + (folder / "wrong.toml").string() + "' --check").exit_code, 1);
  const Outcome broken = odolab("run '" + (folder / "broken.toml").string() + "' --check");
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_NE(broken.errors.find("broken.toml:3"), std::string::npos) << broken.errors;
}

}  // namespace
}  // namespace odolab
