#include "ui/look/widgets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "test/ui/headless_screen.h"

namespace odolab::ui {
namespace {

TEST(WrappedAt, BreaksAtBlanksAndAPathThatIsTooLongAtItsSlashes) {
  HeadlessScreen screen;
  screen.picture([] {
    const float room = ImGui::CalcTextSize("/home/somebody/").x + 1.0f;
    EXPECT_EQ(wrapped_at("one two", 1000.0f), "one two");
    EXPECT_EQ(wrapped_at("found in one place", ImGui::CalcTextSize("found in").x + 1.0f), "found in\none\nplace");
    EXPECT_EQ(wrapped_at("/home/somebody/file.csv: wrong", room), "/home/somebody/\nfile.csv: wrong");
    EXPECT_EQ(wrapped_at("in /home/somebody/a", room), "in\n/home/somebody/\na");
    const std::string letters = wrapped_at(std::string(40, 'x'), room);
    EXPECT_EQ(std::count(letters.begin(), letters.end(), 'x'), 40);
    EXPECT_GT(std::count(letters.begin(), letters.end(), '\n'), 0);
    EXPECT_EQ(wrapped_at("ü", 0.0f), "ü");  // no letter is broken
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

TEST_F(NumberFieldTest, TakesWhatIsTypedAfterOneClick) {
  screen.pause(draw);
  screen.click({60, 20}, draw, {0, 0}, size);
  screen.type("7.5", draw, {0, 0}, size);
  screen.press_key(ImGuiKey_Enter, draw, {0, 0}, size);
  EXPECT_DOUBLE_EQ(value, 7.5);
  EXPECT_EQ(done, 1);
}

// Two fields below each other.
class TwoNumberFieldsTest : public ::testing::Test {
 protected:
  TwoNumberFieldsTest() { screen.picture(draw, {0, 0}, size); }

  HeadlessScreen screen;
  const ImVec2 size{300, 200};
  double value[2] = {4.0, 5.0};
  int done[2] = {0, 0};
  std::function<void()> draw = [this] {
    done[0] += number_field({"##a", kMetres, 0.1, 20.0, ""}, value[0], 120.0f, screen.theme) == Edited::done;
    done[1] += number_field({"##b", kMetres, 0.1, 20.0, ""}, value[1], 120.0f, screen.theme) == Edited::done;
  };
};

TEST_F(TwoNumberFieldsTest, TabConfirmsTheOneAndGoesOnToTheNext) {
  screen.click({60, 20}, draw, {0, 0}, size);
  screen.type("7", draw, {0, 0}, size);
  screen.press_key(ImGuiKey_Tab, draw, {0, 0}, size);
  screen.picture(draw, {0, 0}, size);
  EXPECT_DOUBLE_EQ(value[0], 7.0);
  EXPECT_EQ(done[0], 1);
  screen.type("8", draw, {0, 0}, size);
  screen.press_key(ImGuiKey_Enter, draw, {0, 0}, size);
  EXPECT_DOUBLE_EQ(value[0], 7.0);
  EXPECT_DOUBLE_EQ(value[1], 8.0);
  EXPECT_EQ(done[0], 1);
  EXPECT_EQ(done[1], 1);
}

TEST_F(TwoNumberFieldsTest, TabPastANumberThatStaysConfirmsNothing) {
  screen.click({60, 20}, draw, {0, 0}, size);
  screen.press_key(ImGuiKey_Tab, draw, {0, 0}, size);
  screen.picture(draw, {0, 0}, size);
  screen.press_key(ImGuiKey_Enter, draw, {0, 0}, size);
  EXPECT_EQ(done[0], 0);
  EXPECT_EQ(done[1], 0);
}

}  // namespace
}  // namespace odolab::ui
