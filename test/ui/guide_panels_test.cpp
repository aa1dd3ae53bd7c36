// The pages of the guides and the lessons, with the mouse.
#include <gtest/gtest.h>

#include "core/guide/misfit.h"
#include "core/guide/outcome.h"
#include "test/ui/headless_screen.h"
#include "ui/panels/guide_notes_panel.h"
#include "ui/panels/guide_page.h"
#include "ui/panels/guide_panel.h"
#include "ui/panels/lesson_panel.h"

namespace odolab::ui {
namespace {

template <typename A>
const A* first(const Actions& actions) {
  for (const Action& a : actions)
    if (const A* found = std::get_if<A>(&a)) return found;
  return nullptr;
}

class GuidePagesTest : public ::testing::Test {
 protected:
  GuidePagesTest() {
    session.vehicle.kind = DifferentialDrive{};
    draw = [this] {
      outcome = outcome_of(session);
      view.session = &session;
      view.outcome = &outcome;
      view.experiments = &experiments;
      append(asked, guide_page(view, state, screen.theme));
    };
  }
  void at(PageTask task) {
    const auto& pages = guide_of(session.kind).pages;
    for (std::size_t i = 0; i < pages.size(); ++i)
      if (pages[i].task == task) session.page = session.reached = int(i);
  }
  void enter(bool clockwise, double x_m, double y_m) {
    GuideRun run;
    run.clockwise = clockwise;
    run.measured = {x_m, y_m, 0.0};
    run.has_heading = true;
    run.source = "typed";
    enter_run(session, guide_of(session.kind).pages[std::size_t(session.page)].task, run);
  }

  HeadlessScreen screen{672, 680};
  GuideSession session;
  GuideOutcome outcome;
  std::vector<BenchExperiment> experiments;
  GuideView view;
  GuidePageState state;
  Actions asked;
  std::function<void()> draw;
};

// "Next" stands at the lower right.
const ImVec2 kNext{672 - 80, 680 - 22};

TEST_F(GuidePagesTest, NextIsRefusedUntilThereIsARunEachWay) {
  at(PageTask::runs);
  screen.picture(draw);
  screen.click(kNext, draw);
  EXPECT_EQ(first<ChangeGuide>(asked), nullptr);
  enter(true, 0.1, 0.1);
  enter(false, 0.1, -0.1);
  asked.clear();
  screen.click(kNext, draw);
  const ChangeGuide* next = first<ChangeGuide>(asked);
  ASSERT_NE(next, nullptr);
  EXPECT_EQ(next->session.page, session.page + 1);
}

TEST_F(GuidePagesTest, GoingOnToTheSecondSquaresBeginsARoundWithTheCorrectedSettings) {
  at(PageTask::runs);
  enter(true, -0.3, -0.3);
  enter(false, -0.1, 0.1);
  at(PageTask::result);
  screen.picture(draw);
  asked.clear();
  screen.click(kNext, draw);
  const ChangeGuide* next = first<ChangeGuide>(asked);
  ASSERT_NE(next, nullptr);
  ASSERT_EQ(next->session.rounds.size(), 2u);
  EXPECT_NE(next->session.rounds[1].nominal.wheelbase_m, session.rounds[0].nominal.wheelbase_m);
}

TEST_F(GuidePagesTest, AVehicleFileIsOpenedByAButtonOfTheFirstPage) {
  at(PageTask::robot);
  session.real_robot = true;
  screen.picture(draw);
  for (float y = 100; y < 600 && !state.ask_for_file; y += 6) screen.click({60, y}, draw);
  EXPECT_TRUE(state.ask_for_file);
}

TEST_F(GuidePagesTest, EveryPageOfEveryGuideDrawsEmptyLoadedAndInTrouble) {
  for (const Guide& guide : guides())
    for (const bool real : {true, false})
      for (const bool loaded : {false, true})
        for (std::size_t page = 0; page < guide.pages.size(); ++page) {
          session = GuideSession{};
          session.kind = guide.kind;
          session.real_robot = real;
          if (guide.kind == GuideKind::castors) session.vehicle.kind = three_castor_vehicle();
          if (guide.kind == GuideKind::linked) session.vehicle.kind = Clapper{};
          if (loaded)
            for (const PageTask task : {PageTask::runs, PageTask::bumps}) {
              at(task);
              for (int i = 0; i < 5; ++i) {
                enter(true, -0.3 + 0.001 * i, -0.3);
                enter(false, i == 4 ? 2.0 : -0.1, 0.1 + 0.001 * i);
              }
            }
          if (loaded) session.recordings = {"/a/long/path/to/a/recording/that/does/not/fit/anywhere/at/all/1.csv"};
          session.page = session.reached = int(page);
          view.problem = loaded ? "" : "something.csv: found no square, expected one";
          view.misfits.assign(10, loaded);
          screen.picture([&] {
            draw();
            append(asked, guide_panel(view, screen.theme));
            append(asked, guide_notes_panel(view, screen.theme));
          });
          EXPECT_EQ(ImGui::GetDrawData()->CmdListsCount > 0, true);
        }
}

TEST_F(GuidePagesTest, ChoosingAGuideSaysWhichAndForWhichRobot) {
  view.session = nullptr;
  const auto choose = [&] { append(asked, guide_page(view, state, screen.theme)); };
  screen.picture(choose);
  bool real = false, simulated = false;
  for (float y = 60; y < 600 && !(real && simulated); y += 6)
    for (const float x : {80.0f, 240.0f}) {
      asked.clear();
      screen.click({x, y}, choose);
      if (const BeginGuide* begin = first<BeginGuide>(asked)) (begin->real_robot ? real : simulated) = true;
    }
  EXPECT_TRUE(real);
  EXPECT_TRUE(simulated);
}

class LessonPanelTest : public ::testing::Test {
 protected:
  LessonPanelTest() {
    lesson.title = "A lesson";
    LessonStep one, two;
    one.title = "One";
    one.text = "Words.\n\nMore words.";
    one.look_at = "this.";
    one.question =
        LessonQuestion{"Which?", {{"That one, which is wrong", false, "No reply"}, {"This", true, "Yes"}}, true};
    two.title = "Two";
    two.text = "The end.";
    lesson.steps = {one, two};
    progress = begun(lesson);
    view.lesson = &lesson;
    view.progress = &progress;
    draw = [this] { append(asked, lesson_panel(view, state, screen.theme)); };
    screen.picture(draw);
  }
  // Clicks down the panel until one asks for an A.
  template <typename A>
  const A* click_until(float x) {
    for (float y = 20; y < 660; y += 6) {
      asked.clear();
      screen.click({x, y}, draw);
      if (const A* found = first<A>(asked)) return found;
    }
    return nullptr;
  }

  HeadlessScreen screen{316, 680};
  Lesson lesson;
  LessonProgress progress;
  LessonView view;
  LessonPanelState state;
  Actions asked;
  std::function<void()> draw;
};

TEST_F(LessonPanelTest, AnAnswerIsGivenOnceWithItsBet) {
  const AnswerLesson* given = click_until<AnswerLesson>(100);
  ASSERT_NE(given, nullptr);
  EXPECT_EQ(given->choice, 0);
  EXPECT_EQ(given->stake, 10);
  answer(progress, lesson, given->choice, given->stake);
  EXPECT_EQ(click_until<AnswerLesson>(100), nullptr);
}

TEST_F(LessonPanelTest, NextGoesOnAndFinishLeaves) {
  const LessonStepTo* next = click_until<LessonStepTo>(230);
  ASSERT_NE(next, nullptr);
  EXPECT_EQ(next->step, 1);
  progress.step = 1;
  EXPECT_NE(click_until<LeaveLesson>(230), nullptr);
}

TEST_F(LessonPanelTest, TheListOpensALesson) {
  view.lesson = nullptr;
  view.lessons = {{"/x/1.toml", "A title that is much too long for one line of a narrow panel", "About", 5}};
  const OpenLesson* open = click_until<OpenLesson>(100);
  ASSERT_NE(open, nullptr);
  EXPECT_EQ(open->path, "/x/1.toml");
}

}  // namespace
}  // namespace odolab::ui
