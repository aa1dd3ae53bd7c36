#include "ui/panels/estimator_panel.h"

#include <gtest/gtest.h>

#include <set>

#include "test/ui/headless_screen.h"

namespace odolab::ui {
namespace {

Estimators two_estimators(const Theme& theme) {
  Estimators e;
  EstimatorRow own;
  own.name = "IPEC";
  own.steers = true;
  EstimatorRow other;
  other.name = "truck B, link";
  other.look = estimator_look(0, theme);
  other.gap = {0.01, -0.02, 0.3};
  e.rows = {own, other};
  return e;
}

TEST(EstimatorPanel, ShowsAndHidesAnEstimatorByItsCheckBoxButNotTheOneThatSteers) {
  HeadlessScreen screen(300, 200);
  EstimatorState state;
  state.shown.clear();
  const auto draw = [&] { estimator_panel(two_estimators(screen.theme), state, screen.theme); };
  screen.picture(draw);
  // Down the column of check boxes: every one is met.
  for (float y = 20.0f; y < 150.0f; y += 6.0f) screen.click({16.0f, y}, draw);
  EXPECT_EQ(state.shown.count("IPEC"), 0u);
  bool toggled = false;
  for (float y = 20.0f; y < 150.0f && !toggled; y += 3.0f) {
    const auto before = state.shown;
    screen.click({16.0f, y}, draw);
    screen.pause(draw);
    toggled = before != state.shown;
  }
  EXPECT_TRUE(toggled);
}

TEST(EstimatorPanel, GivesNoTwoOfTwelveTheSameColourAndDash) {
  const Theme theme = make_theme(false, 1.0f);
  std::set<std::pair<ImU32, Dash>> looks;
  for (std::size_t i = 0; i < 12; ++i) {
    const EstimatorLook look = estimator_look(i, theme);
    EXPECT_NE(look.dash, Dash::solid);
    looks.insert({look.colour, look.dash});
  }
  EXPECT_EQ(looks.size(), 12u);
}

}  // namespace
}  // namespace odolab::ui
