#include "core/io/lesson_toml.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/io/file_kind.h"
#include "core/io/scenario_toml.h"
#include "source_dir.h"

namespace odolab {
namespace {

class LessonFile : public ::testing::Test {
 protected:
  LessonFile() {
    folder = (std::filesystem::temp_directory_path() / ("odolab_lesson_" + std::to_string(::getpid()))).string();
    std::filesystem::create_directories(folder);
  }
  ~LessonFile() override { std::filesystem::remove_all(folder); }
  std::string file(const std::string& name, const std::string& text) {
    std::ofstream(folder + "/" + name) << text;
    return folder + "/" + name;
  }
  std::string error_of(const std::string& text) {
    const Result<Lesson> lesson = read_lesson(file("bad.toml", text));
    return lesson ? "" : lesson.error().message();
  }

  std::string folder;
};

TEST_F(LessonFile, HoldsAScenarioOnTopOfAnother) {
  file("base.toml",
       "seed = 7\n[actual]\nwheelbase_m = 0.35\nmass_kg = 33.0\n[path]\nkind = \"straight\"\nlength_m = 9.0\n"
       "[[floor.bump]]\nx_m = 1.0\n[[floor.bump]]\nx_m = 2.0\n[[expect]]\nfigure = \"finished\"\nat_least = 1\n");
  const std::string path = file("lesson.toml",
                                "lesson = \"Title\"\n[[step]]\ntitle = \"One\"\ntext = \"Words\"\n[step.scenario]\n"
                                "include = \"base.toml\"\n[step.scenario.actual]\nwheelbase_m = 0.36\n"
                                "[[step.scenario.floor.bump]]\nx_m = 5.0\n");
  EXPECT_EQ(file_kind(path), FileKind::lesson);
  const Result<Lesson> lesson = read_lesson(path);
  ASSERT_TRUE(lesson.ok()) << lesson.error().message();
  ASSERT_EQ(lesson->steps.size(), 1u);
  const Scenario& s = *lesson->steps[0].scenario;
  EXPECT_EQ(s.seed, 7u);
  EXPECT_EQ(s.actual.wheelbase_m, 0.36);
  EXPECT_EQ(s.actual.mass_kg, 33.0);  // stays as the included one has it
  EXPECT_EQ(std::get<StraightPath>(s.path).length_m, 9.0);
  ASSERT_EQ(s.floor.bumps.size(), 1u);  // lists replace lists
  EXPECT_EQ(s.floor.bumps[0].centre.x_m, 5.0);
  EXPECT_TRUE(s.expectations.empty());
}

TEST_F(LessonFile, OfScenariosThatIncludeEachOtherSaysSo) {
  const std::string self = file("self.toml", "include = \"self.toml\"\n");
  file("a.toml", "include = \"b.toml\"\n");
  file("b.toml", "include = \"a.toml\"\n");
  for (const std::string& path : {self, folder + "/a.toml"}) {
    const Result<Scenario> scenario = read_scenario(path);
    ASSERT_FALSE(scenario);
    EXPECT_NE(scenario.error().message().find("include: found"), std::string::npos) << scenario.error().message();
    EXPECT_NE(scenario.error().message().find("which includes itself"), std::string::npos);
  }
}

TEST_F(LessonFile, SaysWhatIsWrongAndWhere) {
  const std::string head = "lesson = \"T\"\n[[step]]\ntitle = \"One\"\ntext = \"Words\"\n";
  EXPECT_NE(error_of("lesson = \"T\"\n").find("step"), std::string::npos);
  EXPECT_NE(error_of(head + "lok_at = \"x\"\n").find("look_at"), std::string::npos);
  EXPECT_NE(error_of(head + "scenario = \"none.toml\"\n").find("none.toml"), std::string::npos);
  EXPECT_NE(error_of(head + "[step.scenario]\ninclude = \"none.toml\"\n").find("include"), std::string::npos);
  EXPECT_NE(error_of(head + "[step.scenario.actual]\nwheelbase_m = -1.0\n").find("wheelbase_m"), std::string::npos);
  EXPECT_NE(error_of(head + "[[step.check]]\nfigure = \"x\"\nat_least = 1\n").find("check"), std::string::npos);
  EXPECT_NE(error_of(head + "[step.question]\ntext = \"?\"\n[[step.question.answer]]\ntext = \"a\"\n").find("answer"),
            std::string::npos);
  EXPECT_NE(error_of(head + "[step.mystery]\neffect = \"gnomes\"\ncomponent = \"vehicle\"\n"
                            "[[step.mystery.drive]]\nscenario = \"none.toml\"\n")
                .find("none.toml"),
            std::string::npos);
}

TEST_F(LessonFile, IncludesAVehicleFromAnotherFolder) {
  const std::string path =
      file("here.toml", "include = \"" ODOLAB_SOURCE_DIR "/assets/scenarios/umbmark.toml\"\nname = \"Here\"\n");
  const Result<Scenario> scenario = read_scenario(path);
  ASSERT_TRUE(scenario.ok()) << scenario.error().message();
  EXPECT_EQ(scenario->name, "Here");
  EXPECT_EQ(scenario->vehicle.name, "LabMate");
  EXPECT_EQ(scenario->actual.wheelbase_m, 0.337);
  EXPECT_TRUE(scenario->benchmark.has_value());
}

TEST(Lessons, ThatComeWithOdoLabCanAllBeRead) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ODOLAB_SOURCE_DIR "/assets/lessons")) {
    if (entry.path().extension() != ".toml") continue;
    const Result<Lesson> lesson = read_lesson(entry.path().string());
    ASSERT_TRUE(lesson.ok()) << lesson.error().message();
    EXPECT_FALSE(lesson->about.empty()) << lesson->file;
    ++count;
  }
  EXPECT_GE(count, 8);
}

TEST(LessonProgress, WinsAndLosesABetOnceAndNeverMoreThanThereIs) {
  Lesson lesson;
  LessonStep step;
  step.text = "?";
  step.question = LessonQuestion{"?", {{"wrong", false, ""}, {"right", true, ""}}, true};
  lesson.steps = {step, step, step};
  LessonProgress progress = begun(lesson);
  answer(progress, lesson, 1, 30);
  EXPECT_EQ(progress.points, 130);
  answer(progress, lesson, 0, 30);  // it is answered already
  EXPECT_EQ(progress.points, 130);
  EXPECT_TRUE(given_answer(progress, lesson)->right);
  progress.step = 1;
  answer(progress, lesson, 0, 1000);
  EXPECT_EQ(progress.points, 0);
  progress.step = 2;
  answer(progress, lesson, 7, 10);  // there is no such answer
  EXPECT_EQ(given_answer(progress, lesson), nullptr);
}

}  // namespace
}  // namespace odolab
