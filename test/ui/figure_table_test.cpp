#include "ui/look/figure_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "test/ui/headless_screen.h"
#include "ui/look/widgets.h"

namespace odolab::ui {
namespace {

TEST(ColumnWidths, FollowTheWeightsWhereAllHaveRoom) {
  EXPECT_EQ(column_widths(300.0f, {1.0f, 2.0f}, {50.0f, 50.0f}), (std::vector<float>{100.0f, 200.0f}));
}

TEST(ColumnWidths, GiveAColumnWhatItNeedsAndShareTheRest) {
  EXPECT_EQ(column_widths(300.0f, {1.0f, 1.0f, 1.0f}, {20.0f, 140.0f, 20.0f}),
            (std::vector<float>{80.0f, 140.0f, 80.0f}));
}

TEST(ColumnWidths, LetTheWordsGiveWayBeforeTheNumbers) {
  EXPECT_EQ(column_widths(200.0f, {1.0f, 1.0f, 1.0f}, {90.0f, 70.0f, 80.0f}),
            (std::vector<float>{50.0f, 70.0f, 80.0f}));
}

TEST(FigureTable, CutsNoNumberInANarrowPanelAndWrapsTheWords) {
  HeadlessScreen screen;
  const std::string number = "-1234.5678 m";
  float least = 1e9f, needed = 0.0f, label_height = 0.0f, line = 0.0f;
  const auto content = [&] {
    needed = ImGui::CalcTextSize(number.c_str()).x;
    line = ImGui::GetTextLineHeight();
    least = 1e9f;
    if (!begin_figures("figures", {3.0f, 1.0f, 1.0f})) return;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    figure_label("stands on the floor", screen.theme.ink);
    label_height = ImGui::GetItemRectSize().y;
    for (int i = 0; i < 2; ++i) {
      ImGui::TableNextColumn();
      least = std::min(least, ImGui::GetContentRegionAvail().x);
      text_right(number, screen.theme.ink);
    }
    end_figures();
  };
  for (int i = 0; i < 3; ++i) screen.picture(content, {0, 0}, {280, 200});
  EXPECT_GE(least, needed);
  EXPECT_GT(label_height, 1.5f * line);
}

}  // namespace
}  // namespace odolab::ui
