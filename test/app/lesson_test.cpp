// Each lesson as a student goes through it, from the list to its end.
#include <gtest/gtest.h>

#include <filesystem>

#include "app/gui/session.h"
#include "source_dir.h"
#include "test/app/always.h"

namespace odolab {
namespace {

std::vector<std::string> lessons() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(ODOLAB_SOURCE_DIR "/assets/lessons"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

class EachLesson : public ::testing::TestWithParam<std::string> {};

TEST_P(EachLesson, PlaysFromItsFirstStepToItsLastAndGivesTheOldScenarioBack) {
  Session session(false);
  const std::string before = session.run().scenario().name;
  session.execute(ui::OpenLesson{GetParam()});
  ASSERT_TRUE(session.messages().empty()) << session.messages().front().text;
  EXPECT_EQ(session.mode(), ui::Mode::learn);
  for (std::size_t i = 0; i < session.lesson().lesson().steps.size(); ++i) {
    session.execute(ui::LessonStepTo{int(i)});
    const LessonStep& step = session.lesson().step();
    if (step.scenario && !step.scenario->benchmark) {
      EXPECT_TRUE(session.playing()) << step.title;
      EXPECT_EQ(session.run().scenario().name, step.scenario->name);
      for (int k = 0; k < 20; ++k) session.advance(0.05, kAlways);
      EXPECT_GT(session.run().shown_s(), 0.5) << step.title;
    }
    if (step.question) {
      session.execute(ui::AnswerLesson{0, 10});
      EXPECT_NE(given_answer(session.lesson().progress(), session.lesson().lesson()), nullptr);
    }
  }
  session.execute(ui::LeaveLesson{});
  EXPECT_FALSE(session.lesson().is_open());
  EXPECT_EQ(session.run().scenario().name, before);
}

INSTANTIATE_TEST_SUITE_P(Lessons, EachLesson, ::testing::ValuesIn(lessons()), [](const auto& info) {
  std::string name = std::filesystem::path(info.param).stem().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return "of_" + name;
});

TEST(LessonWindow, DrivesTheSquaresOfABenchmarkStepAndCalibrates) {
  Session session(false);
  session.execute(ui::OpenLesson{ODOLAB_SOURCE_DIR "/assets/lessons/3_umbmark.toml"});
  EXPECT_FALSE(session.playing());
  Scenario quick = session.run().scenario();
  quick.path = SquarePath{1.0, false};
  quick.benchmark->runs_each_way = 2;
  session.execute(ui::EditScenario{quick});
  session.execute(ui::StartBenchmark{0, true});
  ASSERT_EQ(session.bench().experiments().size(), 1u);
  EXPECT_EQ(session.bench().experiments().front().runs.clockwise.size(), 2u);
  session.execute(ui::ApplyCalibration{});
  EXPECT_EQ(session.bench().experiments().size(), 2u);
}

TEST(LessonWindow, ABrokenLessonIsAMessageAndTheOldOneGoesOn) {
  Session session(false);
  session.execute(ui::OpenLesson{ODOLAB_SOURCE_DIR "/assets/lessons/1_dead_reckoning.toml"});
  session.execute(ui::OpenLesson{"/no/such/lesson.toml"});
  ASSERT_EQ(session.messages().size(), 1u);
  EXPECT_TRUE(session.lesson().is_open());
}

}  // namespace
}  // namespace odolab
