#include "ui/look/widgets.h"

#include <gtest/gtest.h>

#include "test/ui/headless_screen.h"

namespace odolab::ui {
namespace {

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

}  // namespace
}  // namespace odolab::ui
