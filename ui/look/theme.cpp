#include "ui/look/theme.h"

namespace odolab::ui {

namespace {

ImVec4 vec(ImU32 colour, float alpha = 1.0f) {
  ImVec4 v = ImGui::ColorConvertU32ToFloat4(colour);
  v.w *= alpha;
  return v;
}

}  // namespace

Theme make_theme(bool dark, float scale) {
  Theme t;
  t.dark = dark;
  t.scale = scale;
  t.orange = rgb(0xD55E00);
  t.blue = rgb(0x0072B2);
  t.green = rgb(0x009E73);
  t.purple = rgb(0xCC79A7);
  t.sky = rgb(0x56B4E9);
  t.bump = rgb(0xF0E442);
  if (dark) {
    t.paper = rgb(0x14171B);
    t.panel = rgb(0x1D2126);
    t.raised = rgb(0x2A3037);
    t.hovered = rgb(0x363E47);
    t.pressed = rgb(0x434D58);
    t.line = rgb(0x3B434C);
    t.faint = rgb(0x22272D);
    t.ink = rgb(0xF1EFEA);
    t.muted = rgb(0x9DA5AD);
    t.on_ink = rgb(0x14171B);
    t.error = rgb(0xFF9C8A);
    t.error_paper = rgb(0x3D211D);
    t.note_paper = rgb(0x262C33);
    t.bump_edge = rgb(0xB9AE22);
    t.zone = rgb(0x8FA3B5);
    t.orange = rgb(0xF07B1D);  // lifted for the dark ground, as is the blue
    t.blue = rgb(0x3C9FDB);
    t.green = rgb(0x21BD92);
  } else {
    t.paper = rgb(0xFFFFFF);
    t.panel = rgb(0xF5F4F1);
    t.raised = rgb(0xFFFFFF);
    t.hovered = rgb(0xEAE7E1);
    t.pressed = rgb(0xDAD6CE);
    t.line = rgb(0xD6D2CA);
    t.faint = rgb(0xF0EEEA);
    t.ink = rgb(0x1C2126);
    t.muted = rgb(0x656B72);
    t.on_ink = rgb(0xFFFFFF);
    t.error = rgb(0x9B1C0B);
    t.error_paper = rgb(0xFCE9E5);
    t.note_paper = rgb(0xFBF7E8);
    t.bump_edge = rgb(0x6B6408);
    t.zone = rgb(0x5F7A92);
  }
  t.truth = t.ink;
  return t;
}

ImU32 faded(ImU32 colour, float alpha) {
  const float a = float((colour >> IM_COL32_A_SHIFT) & 255u) * alpha;
  return (colour & ~IM_COL32_A_MASK) | (ImU32(a + 0.5f) << IM_COL32_A_SHIFT);
}

void apply(const Theme& t) {
  ImGuiStyle style;
  style.WindowPadding = {12, 10};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.CellPadding = {4, 3};
  style.IndentSpacing = 14;
  style.ScrollbarSize = 10;
  style.GrabMinSize = 12;
  style.WindowRounding = 0;
  style.ChildRounding = 4;
  style.FrameRounding = 4;
  style.PopupRounding = 6;
  style.ScrollbarRounding = 6;
  style.GrabRounding = 4;
  style.WindowBorderSize = 0;
  style.ChildBorderSize = 1;
  style.FrameBorderSize = 1;
  style.PopupBorderSize = 1;
  style.DisabledAlpha = 0.45f;
  style.ScaleAllSizes(t.scale);
  style.ChildBorderSize = style.FrameBorderSize = style.PopupBorderSize = 1.0f;

  ImVec4* c = style.Colors;
  for (int i = 0; i < ImGuiCol_COUNT; ++i) c[i] = vec(t.raised);
  c[ImGuiCol_Text] = vec(t.ink);
  c[ImGuiCol_TextDisabled] = vec(t.muted);
  c[ImGuiCol_WindowBg] = vec(t.panel);
  c[ImGuiCol_ChildBg] = {0, 0, 0, 0};
  c[ImGuiCol_PopupBg] = vec(t.dark ? t.raised : t.paper);
  c[ImGuiCol_Border] = vec(t.line);
  c[ImGuiCol_BorderShadow] = {0, 0, 0, 0};
  c[ImGuiCol_FrameBg] = vec(t.raised);
  c[ImGuiCol_FrameBgHovered] = vec(t.hovered);
  c[ImGuiCol_FrameBgActive] = vec(t.hovered);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = vec(t.panel);
  c[ImGuiCol_MenuBarBg] = vec(t.panel);
  c[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
  c[ImGuiCol_ScrollbarGrab] = vec(t.line);
  c[ImGuiCol_ScrollbarGrabHovered] = c[ImGuiCol_ScrollbarGrabActive] = vec(t.muted);
  c[ImGuiCol_CheckMark] = vec(t.ink);
  c[ImGuiCol_SliderGrab] = c[ImGuiCol_SliderGrabActive] = vec(t.ink);
  c[ImGuiCol_Button] = vec(t.raised);
  c[ImGuiCol_ButtonHovered] = vec(t.hovered);
  c[ImGuiCol_ButtonActive] = vec(t.pressed);
  c[ImGuiCol_Header] = {0, 0, 0, 0};
  c[ImGuiCol_HeaderHovered] = vec(t.hovered);
  c[ImGuiCol_HeaderActive] = vec(t.pressed);
  c[ImGuiCol_Separator] = vec(t.line);
  c[ImGuiCol_SeparatorHovered] = c[ImGuiCol_SeparatorActive] = vec(t.muted);
  c[ImGuiCol_TableHeaderBg] = vec(t.panel);
  c[ImGuiCol_TableBorderStrong] = c[ImGuiCol_TableBorderLight] = vec(t.line);
  c[ImGuiCol_TableRowBg] = c[ImGuiCol_TableRowBgAlt] = {0, 0, 0, 0};
  c[ImGuiCol_TextSelectedBg] = vec(t.sky, 0.45f);
  c[ImGuiCol_PlotHistogram] = c[ImGuiCol_PlotLines] = vec(t.ink);
  c[ImGuiCol_NavHighlight] = vec(t.sky);
  c[ImGuiCol_ModalWindowDimBg] = {0, 0, 0, 0.25f};
  ImGui::GetStyle() = style;
  ImGui::GetIO().ConfigDragClickToInputText = true;
}

WithFont::WithFont(ImFont* font) : pushed_(font != nullptr) {
  if (pushed_) ImGui::PushFont(font);
}

WithFont::~WithFont() {
  if (pushed_) ImGui::PopFont();
}

}  // namespace odolab::ui
