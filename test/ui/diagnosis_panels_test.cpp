#include <gtest/gtest.h>

#include <cmath>

#include "test/ui/headless_screen.h"
#include "ui/panels/diagnosis_findings_panel.h"
#include "ui/panels/diagnosis_runs_panel.h"
#include "ui/panels/diagnosis_time_panel.h"
#include "ui/panels/floor_view.h"

namespace odolab::ui {
namespace {

// Round a circle of 1 m at 1000 points, large at one place alone.
Trail circle() {
  std::vector<double> t, x, y, size;
  for (int i = 0; i < 1000; ++i) {
    const double a = 2.0 * kPi * i / 1000.0;
    t.push_back(0.1 * i);
    x.push_back(std::cos(a));
    y.push_back(std::sin(a));
    size.push_back(i == 333 ? 9.0 : 1.0);
  }
  return Trail(t, x, y, size);
}

TEST(Trail, ThinnedForAZoomKeepsItsEndsAndItsLargestSize) {
  const Trail trail = circle();
  for (const double apart_m : {0.0, 0.004, 0.03, 0.2}) {
    const auto& points = trail.points(apart_m);
    EXPECT_EQ(points.front().time_s, 0.0);
    EXPECT_NEAR(points.back().time_s, 99.9, 1e-9);
    float largest = 0.0f;
    for (const Trail::Point& p : points) largest = std::max(largest, p.size);
    EXPECT_EQ(largest, 9.0f) << apart_m;
  }
  EXPECT_EQ(trail.points(0.0).size(), 1000u);
  EXPECT_LT(trail.points(0.2).size(), 400u);
}

TEST(Trail, IsInsideARectangleInStretches) {
  const Trail trail = circle();
  // the right half of the circle: the first and the last quarter
  const std::vector<Stretch> right = trail.inside({2.0, 2.0}, {0.0, -2.0});
  ASSERT_EQ(right.size(), 2u);
  EXPECT_NEAR(right[0].second, 25.0, 0.15);  // a quarter of 100 s, to a sample of 0.1 s
  EXPECT_NEAR(right[1].first, 75.0, 0.15);
  EXPECT_TRUE(trail.inside({5.0, 5.0}, {6.0, 6.0}).empty());
}

TEST(Trail, OfNothingIsEmpty) {
  EXPECT_TRUE(Trail().empty());
  EXPECT_TRUE(Trail().inside({0, 0}, {1, 1}).empty());
  EXPECT_TRUE(Trail().points(1.0).empty());
}

class DiagnosisPanels : public ::testing::Test {
 protected:
  DiagnosisPanels() {
    for (int i = 0; i <= 600; ++i) {
      mismatch.time_s.push_back(0.1 * i);
      mismatch.x_m.push_back(0.01 * i);
      mismatch.y_m.push_back(0.0);
      mismatch.before.push_back(i > 200 && i < 300 ? 6.0 : 1.0);
      mismatch.after.push_back(1.0);
    }
    trail = Trail(mismatch.time_s, mismatch.x_m, mismatch.y_m, mismatch.before);
    DiagnosedRun run;
    run.name = "run.csv";
    run.duration_s = 60.0;
    run.way = run.mismatch_trail = &trail;
    run.mismatch = &mismatch;
    run.located = {{0, 20.0, 30.0}};
    view.runs = {run, run};
    view.runs[1].name = "other.csv";
    view.runs[1].located.clear();
    view.vehicle_name = "robot";
    view.diagnosis = &diagnosis;
    FindingCard card;
    card.title = "Slip zone of the floor";
    card.can_be_switched = true;
    view.findings = {card};
  }
  // Clicks over a pane until what is asked for holds; the place, or nothing.
  bool click_until(const std::function<void()>& draw, const std::function<bool()>& done, ImVec2 size) {
    for (float y = 6.0f; y < size.y; y += 8.0f)
      for (float x = 10.0f; x < size.x; x += 14.0f) {
        screen.click({x, y}, draw, {0, 0}, size);
        if (done()) return true;
      }
    return false;
  }
  template <typename A>
  int asked_for() const {
    int n = 0;
    for (const Action& a : asked)
      if (const auto* in = std::get_if<InDiagnosis>(&a)) n += std::holds_alternative<A>(in->what);
    return n;
  }

  HeadlessScreen screen;
  MismatchOverTime mismatch;
  Trail trail;
  Diagnosis diagnosis;
  DiagnosisView view;
  DiagnosisState state;
  Actions asked;
};

TEST_F(DiagnosisPanels, AStretchDraggedInThePlotIsTheBrushAndAClickClearsIt) {
  const auto draw = [&] { diagnosis_time_panel(view, state, screen.theme); };
  screen.picture(draw);
  screen.drag({300, 300}, {600, 320}, draw);
  ASSERT_EQ(state.brush.size(), 1u);
  EXPECT_LT(state.brush[0].first, state.brush[0].second);
  EXPECT_GE(state.brush[0].first, 0.0);
  EXPECT_LE(state.brush[0].second, 60.0);
  EXPECT_TRUE(state.time_view.fitted);  // it did not zoom
  screen.pause(draw);
  screen.click({400, 300}, draw);
  EXPECT_TRUE(state.brush.empty());
}

TEST_F(DiagnosisPanels, ARectangleOnTheFloorIsHandedOver) {
  FloorViewState floor;
  floor.tool = FloorTool::brush;
  FloorScene scene;
  scene.brushable = true;
  scene.trails = {{&trail, true, 0, {}, false}};
  const auto draw = [&] { floor_view(scene, floor, screen.theme); };
  screen.picture(draw);
  const Vec2 centre = floor.camera.centre;
  screen.drag({300, 200}, {900, 600}, draw);
  ASSERT_TRUE(floor.brushed);
  EXPECT_FALSE(trail.inside(floor.brushed->first, floor.brushed->second).empty());
  EXPECT_EQ(floor.camera.centre.x_m, centre.x_m);  // the view stayed
}

TEST_F(DiagnosisPanels, TheTickOfARunAsksToHoldItOutAndTheSwitchOfAFindingToSwitchIt) {
  const auto left = [&] {
    bool ask = false;
    append(asked, diagnosis_runs_panel(view, state, "LabMate", ask, screen.theme));
  };
  EXPECT_TRUE(click_until(left, [&] { return asked_for<HoldOut>() > 0; }, {316, 500}));
  EXPECT_TRUE(click_until(left, [&] { return asked_for<RemoveRun>() > 0; }, {316, 500}));
  const auto right = [&] { append(asked, diagnosis_findings_panel(view, state, screen.theme)); };
  EXPECT_TRUE(click_until(right, [&] { return asked_for<SwitchFinding>() > 0; }, {316, 500}));
  EXPECT_TRUE(click_until(right, [&] { return state.lit == 0u; }, {316, 500}));
  EXPECT_EQ(state.brush, stretches_of(view.runs[0], 0));
}

TEST_F(DiagnosisPanels, EveryEffectThatWasAskedForIsListedOnceItIsUnfolded) {
  view.asked = {{"Slip zone of the floor", "named", "Gain 96.", true},
                {"Bump of the left wheel", "chance 0.4", "Gain 7.", false},
                {"Wheel toe", "no sign of it", "Gain 0.", false}};
  float height = 0.0f;
  const auto right = [&] {
    append(asked, diagnosis_findings_panel(view, state, screen.theme));
    height = ImGui::GetCursorPosY();
  };
  screen.picture(right);
  const float folded = height, lines = 3.0f * ImGui::GetTextLineHeight();
  EXPECT_TRUE(click_until(right, [&] { return height > folded + lines; }, {316, 500}));
}

TEST_F(DiagnosisPanels, AWrongRunAndAProblemAreSaidAndNothingCanBeAsked) {
  view.runs[0].problem = "run.csv: no truth";
  view.problem = "bad.csv: found no time_s";
  view.can_diagnose = false;
  view.diagnosis = nullptr;
  const auto left = [&] {
    bool ask = false;
    append(asked, diagnosis_runs_panel(view, state, "LabMate", ask, screen.theme));
  };
  EXPECT_FALSE(click_until(left, [&] { return asked_for<FindMissing>() > 0; }, {316, 500}));
}

TEST_F(DiagnosisPanels, WithoutRunsTheWelcomeOffersAMystery) {
  view = DiagnosisView{};
  bool ask = false;
  const auto middle = [&] { append(asked, diagnosis_welcome(view, state, ask, screen.theme)); };
  EXPECT_TRUE(click_until(middle, [&] { return asked_for<DrawMystery>() > 0; }, {700, 500}));
}

}  // namespace
}  // namespace odolab::ui
