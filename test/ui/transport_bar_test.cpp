#include "ui/panels/transport_bar.h"

#include <gtest/gtest.h>

#include "test/ui/asked.h"
#include "test/ui/headless_screen.h"

namespace odolab::ui {
namespace {

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

}  // namespace
}  // namespace odolab::ui
