#include <gtest/gtest.h>

#include "test/ui/asked.h"
#include "test/ui/headless_screen.h"
#include "ui/panels/calibrate_panel.h"
#include "ui/panels/calibration_result_panel.h"
#include "ui/panels/cluster_panel.h"
#include "ui/panels/compare_panel.h"
#include "ui/panels/error_panel.h"
#include "ui/panels/message_bar.h"
#include "ui/panels/path_panel.h"
#include "ui/panels/readout_panel.h"
#include "ui/panels/run_panel.h"
#include "ui/panels/top_bar.h"
#include "ui/panels/transport_bar.h"
#include "ui/panels/vehicle_panel.h"

namespace odolab::ui {
namespace {

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

TEST(TopBar, AnotherMenuOpensByOneClickAndEscapeClosesIt) {
  HeadlessScreen screen;
  TopBar bar;
  WindowChoices choices;
  float menu_x[2] = {0.0f, 0.0f};
  int open = -1;
  const auto content = [&] {
    top_bar(bar, choices, screen.theme);
    open = ImGui::IsPopupOpen("file") ? 0 : ImGui::IsPopupOpen("edit") ? 1 : -1;
  };
  const auto click = [&](float x) {
    screen.click({x, 20.0f}, content, {0, 0}, {1280, 40});
    screen.picture(content, {0, 0}, {1280, 40});
  };
  for (float x = 84.0f; x < 200.0f && menu_x[1] == 0.0f; x += 6.0f) {
    click(x);
    if (open < 0) continue;
    menu_x[open] = x;
    screen.press_key(ImGuiKey_Escape, content, {0, 0}, {1280, 40});
    ASSERT_EQ(open, -1);
  }
  ASSERT_GT(menu_x[0], 0.0f);
  ASSERT_GT(menu_x[1], 0.0f);
  click(menu_x[0]);
  EXPECT_EQ(open, 0);
  click(menu_x[1]);
  EXPECT_EQ(open, 1);
  click(menu_x[1]);
  EXPECT_EQ(open, -1);
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
