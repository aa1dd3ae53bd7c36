#include <gtest/gtest.h>

#include <cmath>

#include "test/ui/headless_screen.h"
#include "ui/look/strokes.h"
#include "ui/look/units.h"
#include "ui/look/widgets.h"

namespace odolab::ui {
namespace {

TEST(Units, ShowNoUncertaintyWhereItIsUnknown) {
  EXPECT_EQ(shown_with_error(0.0123, 0.0004, kMillimetres, 1), "12.3 ± 0.4 mm");
  EXPECT_EQ(shown_with_error(0.0123, 0.0, kMillimetres, 1), "12.3 mm");
}

TEST(Units, StandBehindEveryNumber) {
  EXPECT_EQ(shown(0.0123, kMillimetres), "12.3 mm");
  EXPECT_EQ(shown(-0.5 * 3.14159265358979 / 180.0, kDegrees), "−0.50°");
  EXPECT_EQ(shown_with_error(0.3425, 0.0001, kMillimetres, 1), "342.5 ± 0.1 mm");
}

TEST(Units, LeaveNoMinusAtZeroAndNoNumberWhereThereIsNone) {
  EXPECT_EQ(shown(-1e-9, kMillimetres), "0.0 mm");
  EXPECT_EQ(shown(NAN, kMillimetres), "– mm");
}

TEST(Units, OfALengthSuitItsSize) {
  EXPECT_EQ(shown_length(0.00043), "0.43 mm");
  EXPECT_EQ(shown_length(0.0123), "12.3 mm");
  EXPECT_EQ(shown_length(1.25), "1.25 m");
}

TEST(Clock, ShowsMinutesSecondsAndHundredthsAndOfHoursNoHundredths) {
  EXPECT_EQ(clock(41.2), "00:41.20");
  EXPECT_EQ(clock(130.0), "02:10.00");
  EXPECT_EQ(clock(59.999), "01:00.00");  // rounds as a whole, never 00:60.00
  EXPECT_EQ(clock(-3.0), "00:00.00");
  EXPECT_EQ(clock(3599.99), "59:59.99");
  EXPECT_EQ(clock(96847.78), "26:54:07");  // hours need no hundredths
}

TEST(Fitted, NeverIsWiderThanAsked) {
  HeadlessScreen screen;
  screen.picture([] {
    const std::string text = "LabMate on its square, with a cable — quer über den Weg";
    for (float width = 30.0f; width < 500.0f; width += 13.0f) {
      const std::string shorter = fitted(text, width);
      EXPECT_LE(ImGui::CalcTextSize(shorter.c_str()).x, width);
      if (shorter != text) {
        EXPECT_EQ(shorter.substr(shorter.size() - 3), "…");
      }
    }
    EXPECT_EQ(fitted(text, 5000.0f), text);
  });
}

TEST(DashedLine, DrawsAboutTheShareOfItsDashes) {
  HeadlessScreen screen;
  screen.picture([] {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const int before = draw.VtxBuffer.Size;
    std::vector<ImVec2> line;
    for (int i = 0; i <= 600; ++i) line.push_back({100.0f + i, 200.0f});  // points closer than a dash
    dashed_line(draw, line, IM_COL32_WHITE, 2.0f, 8.0f, 4.0f);
    const int dashes = 600 / 12;
    EXPECT_GT(draw.VtxBuffer.Size - before, dashes * 4);  // four corners for each dash at the least
    const int used = draw.VtxBuffer.Size;
    dashed_line(draw, {{-5000.0f, -5000.0f}, {-4000.0f, -5000.0f}}, IM_COL32_WHITE, 2.0f, 8.0f, 4.0f);
    EXPECT_EQ(draw.VtxBuffer.Size, used);  // out of sight
  });
}

TEST(NumberField, IsDraggedInItsUnitAndIsDoneOnceWhenLetGo) {
  HeadlessScreen screen;
  double value_m = 0.100;
  int done = 0, changing = 0;
  ImVec2 middle{};
  const auto content = [&] {
    const Edited e = number_field({"##value", {"mm", 1e3, 1, 0.5}, 0.0, 1.0, ""}, value_m, 200.0f, screen.theme);
    done += e == Edited::done;
    changing += e == Edited::changing;
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    middle = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)};
  };
  screen.picture(content);
  screen.drag(middle, {middle.x + 40.0f, middle.y}, content, 40);
  EXPECT_EQ(done, 1);
  EXPECT_GT(changing, 5);
  // 0.5 mm for each pixel, less the few pixels by which ImGui tells a drag from a click.
  EXPECT_GT(value_m, 0.100 + 0.5e-3 * 30);
  EXPECT_LE(value_m, 0.100 + 0.5e-3 * 40 + 1e-9);
}

TEST(Segmented, ReturnsTheChoiceOnceAndNoneThatIsNotThere) {
  HeadlessScreen screen;
  int chosen = 0, changes = 0;
  int available = 2;
  ImVec2 low{}, high{};
  const auto content = [&] {
    if (const auto c = segmented("modes", {"one", "two", "three"}, chosen, screen.theme, 300.0f, available)) {
      chosen = *c;
      ++changes;
    }
    low = ImGui::GetItemRectMin();
    high = ImGui::GetItemRectMax();
  };
  screen.picture(content);
  const float y = 0.5f * (low.y + high.y);
  screen.click({low.x + 150.0f, y}, content);
  EXPECT_EQ(chosen, 1);
  screen.click({low.x + 250.0f, y}, content);
  EXPECT_EQ(chosen, 1);
  available = 3;
  screen.click({low.x + 250.0f, y}, content);
  EXPECT_EQ(chosen, 2);
  EXPECT_EQ(changes, 2);
}

TEST(IconButton, DoesNothingWhileDisabled) {
  HeadlessScreen screen;
  int clicks = 0;
  bool enabled = false;
  ImVec2 middle{};
  const auto content = [&] {
    ButtonLook look;
    look.enabled = enabled;
    look.why_disabled = "not yet";
    clicks += icon_button("play", Icon::play, screen.theme, look);
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    middle = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)};
  };
  screen.picture(content);
  screen.click(middle, content);
  EXPECT_EQ(clicks, 0);
  enabled = true;
  screen.click(middle, content);
  EXPECT_EQ(clicks, 1);
}

}  // namespace
}  // namespace odolab::ui
