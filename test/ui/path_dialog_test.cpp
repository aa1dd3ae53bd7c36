#include "ui/panels/path_dialog.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "test/ui/headless_screen.h"

namespace odolab::ui {
namespace {

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

}  // namespace
}  // namespace odolab::ui
