#include <gtest/gtest.h>

#include "test/ui/headless_screen.h"
#include "ui/look/widgets.h"
#include "ui/panels/calibrate_panel.h"
#include "ui/panels/calibration_result_panel.h"
#include "ui/panels/cluster_panel.h"
#include "ui/panels/compare_panel.h"
#include "ui/panels/error_panel.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/path_dialog.h"
#include "ui/panels/path_panel.h"
#include "ui/panels/readout_panel.h"
#include "ui/panels/run_panel.h"
#include "ui/panels/top_bar.h"
#include "ui/panels/transport_bar.h"
#include "ui/panels/vehicle_panel.h"

namespace odolab::ui {
namespace {

template <typename A>
int count_of(const Actions& actions) {
  int n = 0;
  for (const Action& a : actions) n += std::holds_alternative<A>(a);
  return n;
}

// The transport bar in a pane of its own, and all that it asked for.
class TransportTest : public ::testing::Test {
 protected:
  TransportTest() {
    for (int i = 0; i <= 400; ++i) {
      times.push_back(0.1 * i);
      gap.push_back(1e-4 * i);
    }
    t.latest_s = 40.0;
    t.time_s = 20.0;
    t.total_s = 100.0;
    t.position_curves = {{"gap", &times, &gap, screen.theme.orange, Stroke::line}};
    draw = [this] { append(asked, transport_bar(t, state, screen.theme)); };
    screen.picture(draw, low, size);
  }
  // Clicks along the row of buttons until one asks for an A.
  template <typename A>
  bool click_until() {
    for (float x = 12.0f; x < 260.0f; x += 7.0f) {
      asked.clear();
      screen.click({x, low.y + 20.0f}, draw, low, size);
      if (count_of<A>(asked) > 0) return true;
    }
    return false;
  }

  HeadlessScreen screen;
  const ImVec2 low{0, 534}, size{1280, 186};
  std::vector<double> times, gap;
  Transport t;
  TransportState state;
  Actions asked;
  std::function<void()> draw;
};

TEST_F(TransportTest, ClickingPlayAsksToPlayAndNothingElse) {
  ASSERT_TRUE(click_until<Play>());
  EXPECT_EQ(asked.size(), 1u);
  t.playing = true;
  ASSERT_TRUE(click_until<Pause>());
}

TEST_F(TransportTest, EveryButtonAsksForItsOwnAction) {
  EXPECT_TRUE(click_until<Restart>());
  EXPECT_TRUE(click_until<ToStart>());
  EXPECT_TRUE(click_until<StepBack>());
  EXPECT_TRUE(click_until<StepForward>());
  EXPECT_TRUE(click_until<ToEnd>());
}

TEST_F(TransportTest, AFinishedRunAtItsEndCannotBePlayedOn) {
  t.finished = true;
  t.time_s = t.latest_s;
  EXPECT_FALSE(click_until<Play>());
  EXPECT_FALSE(click_until<StepForward>());
  EXPECT_TRUE(click_until<Restart>());
}

TEST_F(TransportTest, DraggingTheTimelineScrubsToTheTimeUnderTheMouse) {
  // The strip lies at the bottom; its left end is the plot's, at 12 + 52 pixels, its right end 12 + 8 from the edge.
  const float left = 64.0f, right = 1280.0f - 20.0f, y = 534.0f + 186.0f - 10.0f - 12.0f;
  const float x = x_of_time(30.0, left, right, 100.0);
  asked.clear();
  screen.move({x, y});
  screen.picture(draw, low, size);
  screen.press(true);
  screen.picture(draw, low, size);
  ASSERT_EQ(count_of<ScrubTo>(asked), 1);
  EXPECT_NEAR(std::get<ScrubTo>(asked.back()).time_s, 30.0, 100.0 / (right - left));  // a pixel
  // Beyond what was simulated there is nothing to see.
  screen.move({x_of_time(90.0, left, right, 100.0), y});
  screen.picture(draw, low, size);
  EXPECT_DOUBLE_EQ(std::get<ScrubTo>(asked.back()).time_s, 40.0);
}

TEST(ShownCurves, AreTheColumnsOfThePlotWithinItsRangeOfTime) {
  const std::vector<double> time_s{0.0, 1.0, 2.0, 3.0}, gap_m{0.1, 0.2, 0.3, 0.4}, beside_m{0.5, 0.6, 0.7, 0.8};
  Transport t;
  t.position_curves = {{"position gap", &time_s, &gap_m}, {"truck A alone", &time_s, &beside_m}};
  TransportState state;
  Recording all = shown_curves(t, state);
  ASSERT_EQ(all.channels.size(), 2u);
  EXPECT_EQ(all.time_s, time_s);
  EXPECT_EQ(all.channels[0].name, "position_gap_m");
  EXPECT_EQ(all.channels[1].name, "truck_A_alone_m");
  EXPECT_EQ(all.channels[1].values, beside_m);
  state.view.fitted = false;  // zoomed
  state.view.x0 = 0.5;
  state.view.x1 = 2.5;
  all = shown_curves(t, state);
  EXPECT_EQ(all.time_s, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(all.channels[0].values, (std::vector<double>{0.2, 0.3}));
  state.show_heading = true;  // of which there are none
  EXPECT_TRUE(shown_curves(t, state).channels.empty());
}

TEST(Timeline, MapsPositionToTimeAndBack) {
  EXPECT_DOUBLE_EQ(time_at(150.0f, 100.0f, 200.0f, 60.0), 30.0);
  EXPECT_DOUBLE_EQ(time_at(50.0f, 100.0f, 200.0f, 60.0), 0.0);
  EXPECT_DOUBLE_EQ(time_at(999.0f, 100.0f, 200.0f, 60.0), 60.0);
  EXPECT_FLOAT_EQ(x_of_time(15.0, 100.0f, 200.0f, 60.0), 125.0f);
  EXPECT_DOUBLE_EQ(time_at(5.0f, 10.0f, 10.0f, 60.0), 0.0);
}

TEST(MessageBar, ShowsTheNewestUntilAClickAnywhereOnItDismissesIt) {
  HeadlessScreen screen;
  std::vector<Message> messages{{"first.toml:3: found nothing, expected a number", true}, {"second", true}};
  Actions asked;
  float height = 0.0f;
  screen.picture([&] {
    height = message_bar_height(messages, 1280.0f, screen.theme);
    EXPECT_EQ(message_bar_height({}, 1280.0f, screen.theme), 0.0f);
  });
  const auto content = [&] { append(asked, message_bar(messages, screen.theme)); };
  for (int i = 0; i < 100; ++i) screen.picture(content, {0, 40}, {1280, height});
  EXPECT_TRUE(asked.empty());
  screen.click({400.0f, 40.0f + 0.5f * height}, content, {0, 40}, {1280, height});
  ASSERT_EQ(count_of<DismissMessage>(asked), 1);
  EXPECT_EQ(std::get<DismissMessage>(asked.back()).index, 1u);
}

TEST(MessageBar, IsNeverHigherThanTwoLinesOfText) {
  HeadlessScreen screen;
  screen.picture([&] {
    const float two_lines = 2.0f * ImGui::GetTextLineHeight() + screen.theme.px(12);
    const std::string words = std::string(300, 'x') + " " + std::string(300, 'y') + " " + std::string(300, 'z');
    EXPECT_FLOAT_EQ(message_bar_height({{words, true}}, 600.0f, screen.theme), two_lines);
    EXPECT_LE(message_bar_height(std::vector<Message>(20, {words, true}), 600.0f, screen.theme), two_lines);
    EXPECT_LT(message_bar_height({{"short", true}}, 600.0f, screen.theme), two_lines);
  });
}

// A field of 0.1 to 20 m that holds 4 m, alone in a window.
class NumberFieldTest : public ::testing::Test {
 protected:
  NumberFieldTest() { screen.picture(draw, {0, 0}, size); }
  void type(const char* text) {
    screen.pause(draw);
    screen.double_click({60, 20}, draw, {0, 0}, size);
    screen.type(text, draw, {0, 0}, size);
  }

  HeadlessScreen screen;
  const ImVec2 size{300, 200};
  double value = 4.0;
  int done = 0;
  std::function<void()> draw = [this] {
    done +=
        number_field({"##side", kMetres, 0.1, 20.0, "Length of a side."}, value, 120.0f, screen.theme) == Edited::done;
  };
};

TEST_F(NumberFieldTest, TakesATypedNumberOnceItIsConfirmed) {
  type("7.5");
  EXPECT_EQ(done, 0);
  screen.press_key(ImGuiKey_Enter, draw, {0, 0}, size);
  EXPECT_DOUBLE_EQ(value, 7.5);
  EXPECT_EQ(done, 1);
}

TEST_F(NumberFieldTest, TakesNoLettersAndACommaForAPoint) {
  type("1e3abc,5");
  screen.press_key(ImGuiKey_Enter, draw, {0, 0}, size);
  EXPECT_DOUBLE_EQ(value, 13.5);
}

TEST_F(NumberFieldTest, BringsANumberOutOfRangeToTheBoundAndSaysSo) {
  type("500");
  screen.press_key(ImGuiKey_Enter, draw, {0, 0}, size);
  EXPECT_DOUBLE_EQ(value, 20.0);
  EXPECT_EQ(done, 1);
  bool noted = false;
  screen.picture(
      [&] {
        draw();
        noted = ImGui::GetForegroundDrawList()->VtxBuffer.Size > 0;
      },
      {0, 0}, size);
  EXPECT_TRUE(noted);
}

TEST_F(NumberFieldTest, ComesBackToWhatItWasOnEscapeAndConfirmsNothing) {
  type("9");
  screen.press_key(ImGuiKey_Escape, draw, {0, 0}, size);
  screen.picture(draw, {0, 0}, size);
  EXPECT_DOUBLE_EQ(value, 4.0);
  EXPECT_EQ(done, 0);
}

TEST_F(NumberFieldTest, TypedAsItWasConfirmsNothing) {
  type("4");
  screen.press_key(ImGuiKey_Enter, draw, {0, 0}, size);
  EXPECT_EQ(done, 0);
}

// The dialog over a button that fills the window behind it.
class PathDialogTest : public ::testing::Test {
 protected:
  std::string opened;
  int behind = 0;
  bool open = true;
  PathDialog state;
  std::vector<PathEntry> entries;
  HeadlessScreen screen;
  std::function<void()> draw = [this] {
    behind += ImGui::InvisibleButton("behind", {1200, 700});
    const std::string chosen = path_dialog("Open", "Open", open, state, entries, {}, screen.theme);
    if (!chosen.empty()) opened = chosen;
  };
};

TEST_F(PathDialogTest, ClosesOnOneEscapeHoweverMuchIsTyped) {
  screen.picture(draw);
  screen.picture(draw);
  screen.type("abc", draw);
  EXPECT_STREQ(state.path, "abc");
  screen.press_key(ImGuiKey_Escape, draw);
  EXPECT_FALSE(open);
  EXPECT_EQ(opened, "");
}

TEST_F(PathDialogTest, LetsNothingBehindItReact) {
  screen.picture(draw);
  screen.picture(draw);
  screen.click({20, 650}, draw);
  EXPECT_EQ(behind, 0);
  EXPECT_TRUE(open);
  screen.press_key(ImGuiKey_Escape, draw);
  screen.click({20, 650}, draw);
  EXPECT_EQ(behind, 1);
}

TEST_F(PathDialogTest, OpenedAgainReplacesThePathThatFailed) {
  std::snprintf(state.path, sizeof state.path, "wrong.toml");
  screen.picture(draw);
  screen.picture(draw);
  screen.type("right.toml", draw);
  screen.press_key(ImGuiKey_Enter, draw);
  EXPECT_EQ(opened, "right.toml");
  EXPECT_FALSE(open);
}

TEST_F(PathDialogTest, KeptOpenWithAProblemStillTakesKeysAndClosesOnEscape) {
  const auto failing = [this] {
    draw();
    if (opened.empty()) return;
    opened.clear();
    state.problem = "There is no such file.";
    open = true;
  };
  screen.picture(failing);
  screen.picture(failing);
  screen.type("wrong", failing);
  screen.press_key(ImGuiKey_Enter, failing);
  for (int i = 0; i < 5; ++i) screen.picture(failing);
  ASSERT_TRUE(open);
  screen.type("right", failing);
  EXPECT_STREQ(state.path, "right");
  EXPECT_EQ(state.problem, "");
  screen.press_key(ImGuiKey_Escape, failing);
  EXPECT_FALSE(open);
}

TEST_F(PathDialogTest, OpensAFileThatIsClickedAndWalksIntoAFolder) {
  entries = {{"runs/", "data/runs/", true}, {"one.csv", "data/one.csv", false}};
  screen.picture(draw);
  screen.picture(draw);
  float y = 0.0f;
  for (y = 150.0f; y < 400.0f && std::string(state.path).empty(); y += 5.0f) screen.click({640, y}, draw);
  EXPECT_STREQ(state.path, "data/runs/");
  EXPECT_TRUE(open);
  screen.picture(draw);
  screen.picture(draw);
  screen.type("x", draw);
  EXPECT_STREQ(state.path, "data/runs/x");  // typed on, behind the folder
  for (y += 5.0f; y < 400.0f && opened.empty(); y += 5.0f) screen.click({640, y}, draw);
  EXPECT_EQ(opened, "data/one.csv");
}

TEST(TopBar, AModeIsChosenByAClick) {
  HeadlessScreen screen;
  TopBar bar;
  bar.title =
      "a scenario with a very long name that does not fit between the menu and the modes whatever the window's width "
      "may be today";
  WindowChoices choices;
  Actions asked;
  const auto content = [&] { append(asked, top_bar(bar, choices, screen.theme)); };
  bool found = false;
  for (float x = 1270.0f; x > 900.0f && !found; x -= 10.0f) {
    asked.clear();
    screen.click({x, 20.0f}, content, {0, 0}, {1280, 40});
    for (const Action& a : asked)
      if (const SetMode* set = std::get_if<SetMode>(&a)) found = found || set->mode == Mode::calibrate;
  }
  EXPECT_TRUE(found);
}

TEST(VehiclePanel, ADiameterThatIsDraggedChangesTheRadiusByHalfOfItAndIsHandedOverOnce) {
  HeadlessScreen screen;
  Scenario draft;
  bool editing = false;
  Actions asked;
  const auto content = [&] { append(asked, vehicle_panel(draft, editing, screen.theme)); };
  // The field of the true left diameter: the first of the third column, looked for from the top.
  bool found = false;
  for (float y = 40.0f; y < 200.0f && !found; y += 6.0f) {
    asked.clear();
    screen.move({250.0f, y});
    screen.picture(content, {0, 0}, {316, 500});
    screen.press(true);
    screen.picture(content, {0, 0}, {316, 500});
    for (int i = 1; i <= 30; ++i) {
      screen.move({250.0f + float(i), y});
      screen.picture(content, {0, 0}, {316, 500});
    }
    screen.press(false);
    screen.picture(content, {0, 0}, {316, 500});
    found = draft.actual.wheel_radius_left_m != 0.075;
  }
  ASSERT_TRUE(found);
  ASSERT_EQ(count_of<EditScenario>(asked), 1);
  const Scenario& edited = std::get<EditScenario>(asked.back()).scenario;
  const double grown_mm = 2000.0 * (edited.actual.wheel_radius_left_m - 0.075);
  EXPECT_GT(grown_mm, 0.2);  // 0.02 mm a pixel over 30 pixels, less the drag's threshold
  EXPECT_LE(grown_mm, 0.61);
  EXPECT_DOUBLE_EQ(edited.actual.wheel_radius_right_m, 0.075);
  EXPECT_DOUBLE_EQ(std::get<DifferentialDrive>(edited.vehicle.kind).wheel_radius_left_m, 0.075);
}

TEST(CalibratePanel, StartsWithTheNumberOfRunsThatIsShown) {
  HeadlessScreen screen;
  std::vector<BenchExperiment> experiments;
  Bench bench;
  bench.experiments = &experiments;
  CalibrateState state;
  state.runs_each_way = 7;
  Actions asked;
  const auto content = [&] { append(asked, calibrate_panel(bench, state, screen.theme)); };
  for (float y = 100.0f; y < 500.0f && count_of<StartBenchmark>(asked) == 0; y += 8.0f)
    screen.click({60.0f, y}, content, {0, 0}, {316, 600});
  ASSERT_EQ(count_of<StartBenchmark>(asked), 1);
  EXPECT_EQ(std::get<StartBenchmark>(asked.back()).runs_each_way, 7);
}

TEST(LostRuns, AreNamed) {
  EXPECT_EQ(words_of_lost({}), "");
  EXPECT_EQ(words_of_lost({{true, 2}}), "cw 2 never arrived");
  EXPECT_EQ(words_of_lost({{true, 2}, {false, 1}, {false, 5}}), "cw 2, ccw 1 and ccw 5 never arrived");
}

// Every panel, in every state it can be in, at a small and at a doubled size: none may touch what is not there.
TEST(Panels, DrawInEveryState) {
  for (const float scale : {1.0f, 2.0f}) {
    HeadlessScreen screen(1280 * scale, 720 * scale);
    screen.theme = make_theme(scale > 1.0f, scale);
    apply(screen.theme);
    std::vector<BenchExperiment> experiments;
    Bench bench;
    bench.experiments = &experiments;
    CalibrateState calibrate;
    ClusterState clusters;
    Readout readout;
    EstimatorState estimators;
    Welcome welcome{true};
    Compare compare;
    ErrorNow now;
    bool ask = false, editing = false;
    Scenario draft;
    const auto all = [&] {
      calibrate_panel(bench, calibrate, screen.theme);
      calibration_result_panel(bench, screen.theme);
      readout_panel(readout, estimators, screen.theme);
      welcome_card(welcome, screen.theme);
      compare_panel(compare, ask, screen.theme);
      error_panel(compare, now, screen.theme);
      path_panel(draft, editing, screen.theme);
      run_panel(draft, editing, screen.theme);
    };
    screen.picture(all);
    screen.picture([&] { cluster_panel(bench, clusters, screen.theme); });

    BenchExperiment one;
    one.name = "uncalibrated";
    one.runs.clockwise = {{-0.2, -0.3, 0.1}, {-0.21, -0.31, 0.1}};
    one.runs.counter_clockwise = {{0.03, -0.03, 0.0}, {0.035, -0.04, 0.0}};
    experiments.push_back(one);
    experiments[0].runs.counter_clockwise.clear();  // under way: one direction alone so far
    bench.running = true;
    screen.picture(all);
    screen.picture([&] { cluster_panel(bench, clusters, screen.theme); });
    experiments[0] = one;
    experiments[0].measure = measure_umbmark(one.runs);
    experiments[0].calibration = calibrate_umbmark(one.runs, one.vehicle);
    experiments[0].only_clockwise = calibrate_one_direction(one.runs, true, one.vehicle);
    bench.running = false;
    screen.picture(all);
    experiments[0].lost = {{true, 2}, {false, 1}, {false, 5}};  // some never arrived
    screen.picture(all);
    experiments[0].lost.clear();
    BenchExperiment two = one;
    two.name = "after calibration";
    two.runs.clockwise = {{0.002, 0.003, 0.0}, {-0.003, 0.001, 0.0}};
    two.runs.counter_clockwise = {{0.004, -0.003, 0.0}, {-0.001, -0.002, 0.0}};
    two.measure = measure_umbmark(two.runs);
    two.calibration = calibrate_umbmark(two.runs, two.vehicle);
    experiments.push_back(two);
    screen.picture(all);
    screen.picture([&] { cluster_panel(bench, clusters, screen.theme); });

    LeastSquaresCalibration calibration;
    calibration.parameters = {{"wheelbase_m", "m", 0.34, 0.342, 0.0001, true},
                              {"truth_mounting.x_m", "m", 0.0, 0.0, 0.0, false},
                              {"something_new", "m", 0.0, 1.0, 0.1, true}};
    compare.loaded = true;
    compare.name = "a recording with a long name that certainly does not fit into the narrow pane.csv";
    compare.calibration = &calibration;
    compare.nominal = ReplayFigures{};
    compare.calibrated = ReplayFigures{};
    compare.job = "driving";
    for (const Path& path : {Path{StraightPath{}}, Path{FigureEightPath{}}, Path{WaypointPath{{{1, 1}, {2, 2}}}},
                             Path{WheelSpeedPath{{{1, 1, 1}}, 0.1}}, Path{HandPath{}}, Path{ReplayPath{}}}) {
      draft.path = path;
      screen.picture(all);
    }
  }
}

}  // namespace
}  // namespace odolab::ui
