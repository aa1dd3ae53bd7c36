#include "ui/plot/plot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/ui/headless_screen.h"
#include "ui/plot/decimation.h"
#include "ui/plot/ticks.h"

namespace odolab::ui {
namespace {

TEST(Ticks, StandAtOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(round_step(10.0, 10), 1.0);
  EXPECT_DOUBLE_EQ(round_step(10.0, 5), 2.0);
  EXPECT_DOUBLE_EQ(round_step(0.013, 4), 0.005);
  EXPECT_DOUBLE_EQ(round_step(97.3, 8), 20.0);
}

TEST(Ticks, AreInsideTheRangeAndNoMoreThanAskedFor) {
  for (double low = -3.7; low < 4.0; low += 0.61)
    for (double span = 1e-4; span < 1e5; span *= 3.3) {
      const std::vector<double> ticks = round_ticks(low, low + span, 7);
      EXPECT_LE(ticks.size(), 8u) << low << " " << span;  // both ends may be ticks: one more than intervals
      for (const double t : ticks) {
        EXPECT_GE(t, low - 1e-6 * span);
        EXPECT_LE(t, low + span * (1 + 1e-6));
      }
    }
}

TEST(Ticks, AreWrittenWithTheDecimalsOfTheirStep) {
  EXPECT_EQ(tick_text(0.30000000000000004, 0.1), "0.3");
  EXPECT_EQ(tick_text(-20.0, 5.0), "−20");
  EXPECT_EQ(tick_text(-1e-17, 0.5), "0.0");
  EXPECT_EQ(tick_text(0.005, 0.005), "0.005");
}

TEST(Ticks, OfAnEmptyRangeAreNone) {
  EXPECT_TRUE(round_ticks(1.0, 1.0, 5).empty());
  EXPECT_TRUE(round_ticks(2.0, 1.0, 5).empty());
  EXPECT_TRUE(round_ticks(0.0, INFINITY, 5).empty());
}

TEST(Decimation, KeepsASpikeOfASingleSample) {
  std::vector<double> x, y;
  for (int i = 0; i < 100000; ++i) {
    x.push_back(i * 0.001);
    y.push_back(std::sin(i * 0.0005));
  }
  y[54321] = 9.0;
  y[54322] = -7.0;
  const std::vector<std::size_t> kept = decimated(x.data(), y.data(), x.size(), 0.0, 100.0, 500);
  EXPECT_LE(kept.size(), 4u * 502u);
  double least = 1e9, most = -1e9;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    least = std::min(least, y[kept[k]]);
    most = std::max(most, y[kept[k]]);
    if (k > 0) {
      EXPECT_LT(kept[k - 1], kept[k]);
    }
  }
  EXPECT_EQ(most, 9.0);
  EXPECT_EQ(least, -7.0);
}

TEST(Decimation, KeepsANeighbourOnEitherSideOfTheRange) {
  std::vector<double> x, y;
  for (int i = 0; i <= 10; ++i) {
    x.push_back(i);
    y.push_back(i * i);
  }
  const std::vector<std::size_t> kept = decimated(x.data(), y.data(), x.size(), 3.5, 6.5, 100);
  EXPECT_EQ(kept, (std::vector<std::size_t>{3, 4, 5, 6, 7}));
}

TEST(Decimation, OfNothingIsNothing) { EXPECT_TRUE(decimated(nullptr, nullptr, 0, 0.0, 1.0, 10).empty()); }

// A plot of a straight line from (0 s, 0 m) to (100 s, 1 m).
class PlotTest : public ::testing::Test {
 protected:
  PlotTest() {
    for (int i = 0; i <= 100; ++i) {
      x.push_back(i);
      y.push_back(0.01 * i);
    }
    what.x = {"time", kSeconds};
    what.y = {"gap", kMillimetres};
    PlotSeries s;
    s.label = "gap";
    s.x = x.data();
    s.y = y.data();
    s.count = x.size();
    what.series.push_back(s);
    draw = [this] {
      const PlotResult now = plot("plot", {800, 400}, what, view, screen.theme);
      if (now.clicked_x) clicked = now.clicked_x;
      result = now;
    };
    screen.picture(draw);
  }
  ImVec2 at(double share_x, double share_y) const {
    return {result.low.x + float(share_x) * (result.high.x - result.low.x),
            result.low.y + float(share_y) * (result.high.y - result.low.y)};
  }

  HeadlessScreen screen;
  std::vector<double> x, y;
  Plot what;
  PlotView view;
  PlotResult result;
  std::optional<double> clicked;
  std::function<void()> draw;
};

TEST_F(PlotTest, FitsItsDataWithAirAboveAndBelow) {
  EXPECT_DOUBLE_EQ(view.x0, 0.0);
  EXPECT_DOUBLE_EQ(view.x1, 100.0);
  EXPECT_LT(view.y0, 0.0);
  EXPECT_GT(view.y1, 1.0);
}

TEST_F(PlotTest, AClickTellsWhereItLanded) {
  screen.click(at(0.25, 0.5), draw);
  ASSERT_TRUE(clicked.has_value());
  EXPECT_NEAR(*clicked, 25.0, 0.1);  // a pixel is 0.14 s
  EXPECT_TRUE(view.fitted);
}

TEST_F(PlotTest, ADragZoomsToTheRangeBetweenItsEnds) {
  screen.drag(at(0.2, 0.5), at(0.6, 0.5), draw);
  EXPECT_NEAR(view.x0, 20.0, 0.2);
  EXPECT_NEAR(view.x1, 60.0, 0.2);
  EXPECT_FALSE(clicked.has_value());
}

TEST_F(PlotTest, TheWheelZoomsAboutTheMouse) {
  screen.move(at(0.5, 0.5));
  screen.picture(draw);
  screen.wheel(2.0f);
  screen.picture(draw);
  EXPECT_NEAR(0.5 * (view.x0 + view.x1), 50.0, 0.1);
  EXPECT_NEAR(view.x1 - view.x0, 100.0 * 0.85 * 0.85, 1e-6);
}

TEST_F(PlotTest, TheWheelLeadsNoFurtherOutThanToAllOfIt) {
  screen.move(at(0.5, 0.5));
  screen.picture(draw);
  for (int i = 0; i < 40; ++i) {
    screen.wheel(-1.0f);
    screen.picture(draw);
  }
  EXPECT_DOUBLE_EQ(view.x0, 0.0);
  EXPECT_DOUBLE_EQ(view.x1, 100.0);
  EXPECT_TRUE(view.fitted);
}

TEST_F(PlotTest, ADoubleClickFitsAgain) {
  screen.drag(at(0.2, 0.5), at(0.6, 0.5), draw);
  screen.pause(draw);
  screen.click(at(0.5, 0.5), draw);
  screen.click(at(0.5, 0.5), draw);
  screen.picture(draw);
  EXPECT_TRUE(view.fitted);
  EXPECT_DOUBLE_EQ(view.x1, 100.0);
}

TEST_F(PlotTest, AnEqualScaleIsTheSameOnBothAxes) {
  what.equal_scale = true;
  view.fitted = true;
  screen.picture(draw);
  const double px_x = (result.high.x - result.low.x) / (view.x1 - view.x0);
  const double px_y = (result.high.y - result.low.y) / (view.y1 - view.y0);
  EXPECT_NEAR(px_x / px_y, 1.0, 1e-5);  // screen coordinates are single precision
}

TEST_F(PlotTest, SurvivesDataThatIsNoNumber) {
  y[50] = NAN;
  x.back() = INFINITY;
  view.fitted = true;
  screen.picture(draw);
  EXPECT_TRUE(std::isfinite(view.x1));
  EXPECT_TRUE(std::isfinite(view.y1));
}

TEST(Plot, IsNotFlattenedByAnUncertaintyFarWiderThanItsCurve) {
  const double x[] = {0.0, 1.0, 2.0}, y[] = {0.0, 0.1, 0.2};
  const auto span_with = [&](double half) {
    double low[3], high[3];
    for (int i = 0; i < 3; ++i) {
      low[i] = y[i] - half;
      high[i] = y[i] + half;
    }
    Plot what;
    what.series.push_back({"curve", x, y, 3, 0, Stroke::line, Marker::none});
    what.areas.push_back({x, low, high, 3, 0});
    const PlotView view = view_of_all(what, {200.0f, 100.0f});
    return view.y1 - view.y0;
  };
  EXPECT_GT(span_with(0.1), 0.4);  // all of a usual one is in sight
  EXPECT_LT(span_with(0.1), 0.6);
  EXPECT_LT(span_with(100.0), 2.0);  // three times 0.2 on either side, and some air
  EXPECT_GT(span_with(100.0), 1.4);
}

}  // namespace
}  // namespace odolab::ui
