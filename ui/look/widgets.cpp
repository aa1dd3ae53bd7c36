#include "ui/look/widgets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/formatted.h"
#include "ui/look/figure_table.h"

namespace odolab::ui {

namespace {

// Where the field of a labelled row begins, as a share of the panel's width.
constexpr float kLabelShare = 0.50f;

// The one field that a person has in hand: there is but one mouse and one keyboard.
struct FieldInHand {
  ImGuiID id = 0;
  double before_si = 0.0;  // to come back to
  bool outside = false;    // what is typed so far
};

FieldInHand& field_in_hand() {
  static FieldInHand hand;
  return hand;
}

// The one that Tab has just led away from: it hears of it when it is drawn next.
FieldInHand& field_just_left() {
  static FieldInHand left;
  return left;
}

// Digits, signs and points alone; a comma counts as the point that it is on many keyboards.
void keep_number_characters() {
  ImVector<ImWchar>& typed = ImGui::GetIO().InputQueueCharacters;
  int kept = 0;
  for (const ImWchar c : typed)
    if ((c >= '0' && c <= '9') || c == '.' || c == ',' || c == '-' || c == '+') typed[kept++] = c == ',' ? '.' : c;
  typed.resize(kept);
}

// Under the item before it, over whatever is there.
void words_under_item(const std::string& text, const Theme& theme) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str()), screen = ImGui::GetIO().DisplaySize;
  const float pad = theme.px(6);
  const ImVec2 low{std::round(std::max(0.0f, std::min(ImGui::GetItemRectMin().x, screen.x - size.x - 2.0f * pad))),
                   std::round(ImGui::GetItemRectMax().y + theme.px(2))};
  const ImVec2 high{low.x + size.x + 2.0f * pad, low.y + size.y + pad};
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  draw.AddRectFilled(low, high, theme.error_paper, theme.px(4));
  draw.AddRect(low, high, theme.error, theme.px(4));
  draw.AddText({low.x + pad, low.y + 0.5f * pad}, theme.error, text.c_str());
}

// How much of a word without a blank fits: up to one of its slashes if it has any, at least a letter.
std::size_t fitting_part(const std::string& word, float width) {
  if (ImGui::CalcTextSize(word.c_str()).x <= width) return word.size();
  const auto begins_letter = [&](std::size_t i) { return (static_cast<unsigned char>(word[i]) & 0xC0) != 0x80; };
  std::size_t letters = 0, to_slash = 0;
  for (std::size_t i = 1; i < word.size(); ++i) {
    if (!begins_letter(i)) continue;
    if (letters > 0 && ImGui::CalcTextSize(word.c_str(), word.c_str() + i).x > width) break;
    letters = i;
    if (word[i - 1] == '/' && i > 1) to_slash = i;
  }
  return to_slash > 0 ? to_slash : letters > 0 ? letters : word.size();
}

// That a number takes in a field, with its unit and a little air.
float width_of(double value_si, const Unit& unit) {
  return ImGui::CalcTextSize(shown(value_si, unit).c_str()).x + 0.5f * ImGui::GetStyle().FramePadding.x;
}

// Beside the item before it, so that neither it nor its neighbours are covered.
void tooltip_beside(const std::string& text, const Theme& theme) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax(), screen = ImGui::GetIO().DisplaySize;
  const bool on_left = 0.5f * (low.x + high.x) < 0.5f * screen.x;
  const float height = ImGui::CalcTextSize(text.c_str(), nullptr, false, theme.px(400)).y + theme.px(20);
  const float y = std::max(0.0f, std::min(low.y, screen.y - height));
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) && !text.empty() && !ImGui::GetIO().WantTextInput)
    ImGui::SetNextWindowPos({on_left ? high.x + theme.px(18) : low.x - theme.px(18), y}, ImGuiCond_Always,
                            {on_left ? 0.0f : 1.0f, 0.0f});
  tooltip(text, theme);
}

}  // namespace

void tooltip(const std::string& text, const Theme& theme) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  if (ImGui::GetIO().WantTextInput) return;  // who types does not want to have it covered
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(10), theme.px(8)));
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(theme.px(400));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

bool icon_button(const char* id, Icon icon, const Theme& theme, const ButtonLook& look) {
  const float side = ImGui::GetFrameHeight();
  ImGui::PushID(id);
  ImGui::BeginDisabled(!look.enabled);
  const bool clicked = ImGui::InvisibleButton("##icon", {side * 1.15f, side});
  ImGui::EndDisabled();
  ImGui::PopID();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const bool filled = look.toggled || look.primary;
  ImU32 back = filled ? theme.ink : 0;
  if (look.enabled && !filled && ImGui::IsItemHovered()) back = ImGui::IsItemActive() ? theme.pressed : theme.hovered;
  if (back) draw.AddRectFilled(low, high, faded(back, look.enabled ? 1.0f : 0.4f), theme.px(4));
  const ImU32 front = filled ? theme.on_ink : theme.ink;
  draw_icon(draw, icon, {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)}, side * 0.62f,
            look.enabled ? front : faded(front, 0.35f));
  tooltip(look.enabled || look.why_disabled.empty() ? look.tip : look.why_disabled, theme);
  return clicked && look.enabled;
}

bool text_button(const char* label, const Theme& theme, const ButtonLook& look, float width) {
  if (look.toggled) ImGui::PushStyleVar(ImGuiStyleVar_DisabledAlpha, 1.0f);  // what was chosen stays to be read
  ImGui::BeginDisabled(!look.enabled);
  if (look.primary || look.toggled) {
    const ImVec4 ink = ImGui::ColorConvertU32ToFloat4(theme.ink);
    ImGui::PushStyleColor(ImGuiCol_Text, theme.on_ink);
    ImGui::PushStyleColor(ImGuiCol_Button, ink);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, faded(theme.ink, 0.85f));
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, faded(theme.ink, 0.75f));
  }
  const bool clicked = ImGui::Button(label, {width, 0.0f});
  if (look.primary || look.toggled) ImGui::PopStyleColor(4);
  ImGui::EndDisabled();
  if (look.toggled) ImGui::PopStyleVar();
  tooltip(look.enabled || look.why_disabled.empty() ? look.tip : look.why_disabled, theme);
  return clicked && look.enabled;
}

bool job_progress(double share_done, const Theme& theme, float bar_width, float button_width) {
  const std::string share = formatted("%.0f %%", 100.0 * share_done);
  if (bar_width <= 0.0f) bar_width = ImGui::GetContentRegionAvail().x - theme.px(84);
  ImGui::PushStyleColor(ImGuiCol_Text, share_done > 0.5 ? theme.on_ink : theme.ink);
  ImGui::ProgressBar(float(share_done), {bar_width, 0.0f}, share.c_str());
  ImGui::PopStyleColor();
  ImGui::SameLine();
  return text_button("Cancel", theme, {}, button_width);
}

std::optional<int> segmented(const char* id, const std::vector<std::string>& labels, int chosen, const Theme& theme,
                             float width, int available) {
  std::optional<int> choice;
  ImGui::PushID(id);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight(), pad = theme.px(12);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  std::vector<float> widths;
  float total = 0.0f;
  std::vector<float> needs;
  for (const std::string& label : labels) {
    needs.push_back(ImGui::CalcTextSize(label.c_str()).x + theme.px(6));
    widths.push_back(width > 0.0f ? width / float(labels.size()) : ImGui::CalcTextSize(label.c_str()).x + 2.0f * pad);
  }
  if (width > 0.0f) widths = column_widths(width, widths, needs);
  for (const float part : widths) total += part;
  draw.AddRectFilled(at, {at.x + total, at.y + height}, theme.hovered, theme.px(5));
  float x = at.x;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    ImGui::SetCursorScreenPos({x, at.y});
    ImGui::PushID(int(i));
    const bool there = int(i) < available;
    if (ImGui::InvisibleButton("##part", {widths[i], height}) && int(i) != chosen && there) choice = int(i);
    ImGui::PopID();
    const bool on = int(i) == chosen;
    const float inset = theme.px(2);
    if (on)
      draw.AddRectFilled({x + inset, at.y + inset}, {x + widths[i] - inset, at.y + height - inset}, theme.ink,
                         theme.px(4));
    else if (there && ImGui::IsItemHovered())
      draw.AddRectFilled({x + inset, at.y + inset}, {x + widths[i] - inset, at.y + height - inset}, theme.pressed,
                         theme.px(4));
    const ImVec2 text = ImGui::CalcTextSize(labels[i].c_str());
    draw.AddText({std::round(x + 0.5f * (widths[i] - text.x)), std::round(at.y + 0.5f * (height - text.y))},
                 on      ? theme.on_ink
                 : there ? theme.ink
                         : faded(theme.muted, 0.6f),
                 labels[i].c_str());
    x += widths[i];
  }
  ImGui::SetCursorScreenPos(at);
  ImGui::Dummy({total, height});
  ImGui::PopID();
  return choice;
}

bool section(const char* title, const Theme& theme, bool open_at_first) {
  ImGui::Dummy({0, theme.px(2)});
  ImGui::PushID(title);
  bool& open = *ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("##open"), open_at_first);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFrameHeight();
  if (ImGui::InvisibleButton("##section", {width, height})) open = !open;
  const bool hovered = ImGui::IsItemHovered();
  ImGui::PopID();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float pad = ImGui::GetStyle().WindowPadding.x;
  draw.AddRectFilled({at.x - pad, at.y}, {at.x + width + pad, at.y + height}, hovered ? theme.pressed : theme.hovered);
  const float s = theme.px(4), x = at.x + width - theme.px(8), y = at.y + 0.5f * height;
  if (open)
    draw.AddTriangleFilled({x - s, y - 0.6f * s}, {x + s, y - 0.6f * s}, {x, y + 0.8f * s}, theme.muted);
  else
    draw.AddTriangleFilled({x + 0.7f * s, y - s}, {x + 0.7f * s, y + s}, {x - 0.7f * s, y}, theme.muted);
  WithFont strong(theme.strong);
  draw.AddText({at.x, std::round(at.y + 0.5f * (height - ImGui::GetTextLineHeight()))}, theme.ink, title);
  return open;
}

void heading(const char* title, const Theme& theme) {
  ImGui::Dummy({0, theme.px(2)});
  WithFont strong(theme.strong);
  ImGui::TextUnformatted(wrapped_at(title, ImGui::GetContentRegionAvail().x).c_str());
}

void close_on_escape() {
  const int escape = ImGui::GetKeyIndex(ImGuiKey_Escape);
  if (escape >= 0 && ImGui::IsKeyPressed(escape)) ImGui::CloseCurrentPopup();
}

std::string wrapped_at(const std::string& text, float width) {
  std::string lines, line;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    std::string word = text.substr(at, end - at);
    if (!line.empty() && ImGui::CalcTextSize((line + " " + word).c_str()).x > width) {
      lines += line + "\n";
      line.clear();
    }
    while (line.empty()) {
      const std::size_t fits = fitting_part(word, width);
      if (fits == word.size()) break;
      lines += word.substr(0, fits) + "\n";
      word.erase(0, fits);
    }
    line += (line.empty() ? "" : " ") + word;
    if (end < text.size() && text[end] == '\n') {
      lines += line + "\n";
      line.clear();
    }
    at = end + 1;
  }
  return lines + line;
}

void words(const std::string& text, ImU32 colour, float width) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(wrapped_at(text, width > 0.0f ? width : ImGui::GetContentRegionAvail().x).c_str());
  ImGui::PopStyleColor();
}

void note(const std::string& text, const Theme& theme) { words(text, theme.muted); }

void warning(const std::string& text, const Theme& theme) { words(text, theme.error); }

Edited number_field(const NumberField& field, double& value_si, float width, const Theme& theme) {
  double value = value_si * field.unit.per_si;
  const bool bounded = field.least < field.most;
  const double least = field.least * field.unit.per_si, most = field.most * field.unit.per_si;
  char format[32];
  std::string unit = field.unit.name;
  // A number is never cut: where there is no room for it, its unit goes.
  const float room = width > 0.0f ? width : ImGui::GetContentRegionAvail().x + width;
  const bool bare = unit != "×" && width_of(value_si, field.unit) > room;
  if (bare) unit.clear();
  const char* gap = unit.empty() || unit == "°" ? "" : " ";
  if (unit == "×")
    std::snprintf(format, sizeof format, "×%%.%df", field.unit.decimals);
  else
    std::snprintf(format, sizeof format, "%%.%df%s%s", field.unit.decimals, gap, unit == "%" ? "%%" : unit.c_str());
  const ImGuiID id = ImGui::GetID(field.id);
  FieldInHand& hand = field_in_hand();
  if (hand.id == id) keep_number_characters();
  const double before_si = value_si;
  ImGui::SetNextItemWidth(width);
  ImGui::BeginDisabled(!field.enabled);
  const bool changed = ImGui::DragScalar(field.id, ImGuiDataType_Double, &value, float(field.unit.drag),
                                         bounded ? &least : nullptr, bounded ? &most : nullptr, format);
  ImGui::EndDisabled();
  if (ImGui::IsItemActivated()) {
    if (hand.id != 0 && hand.id != id) field_just_left() = hand;
    hand = {id, before_si, false};
  }
  if (changed) {
    hand.outside = bounded && (value < least || value > most);
    value_si = (bounded ? std::clamp(value, least, most) : value) / field.unit.per_si;
  }
  Edited result = changed ? Edited::changing : Edited::no;
  float& said_until_s = *ImGui::GetStateStorage()->GetFloatRef(id, -1.0f);
  if (hand.id == id && ImGui::IsItemDeactivated()) {
    const int escape = ImGui::GetKeyIndex(ImGuiKey_Escape);
    if (escape >= 0 && ImGui::IsKeyPressed(escape)) {
      value_si = hand.before_si;
      result = Edited::changing;  // back to what it was, and nothing confirmed
    } else {
      result = value_si != hand.before_si ? Edited::done : Edited::no;
      if (hand.outside) said_until_s = float(ImGui::GetTime()) + 6.0f;
    }
    hand.id = 0;
  }
  if (FieldInHand& left = field_just_left(); left.id == id) {
    if (value_si != left.before_si) result = Edited::done;
    if (left.outside) said_until_s = float(ImGui::GetTime()) + 6.0f;
    left.id = 0;
  }
  const bool outside_now = hand.id == id && ImGui::IsItemActive() && hand.outside;
  if (outside_now || float(ImGui::GetTime()) < said_until_s)
    words_under_item("from " + shown(field.least, field.unit) + " to " + shown(field.most, field.unit), theme);
  else if (!ImGui::IsItemActive())
    tooltip_beside(field.tip.empty() ? ""
                                     : field.tip + (bare ? std::string("\nIn ") + field.unit.name + "." : "") +
                                           "\n\nClick to type, drag to change; Tab goes on to the next.",
                   theme);
  return result;
}

Edited number_row(const char* label, const NumberField& field, double& value_si, const Theme& theme) {
  const float width = ImGui::GetContentRegionAvail().x;
  // A long label gets what its number can spare.
  const float longest = ImGui::CalcTextSize(label).x + theme.px(8);
  const float most = std::max(width * kLabelShare, width - width_of(value_si, field.unit) - theme.px(8));
  const float left = std::round(std::clamp(longest, width * kLabelShare, most));
  const float x = ImGui::GetCursorPosX();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(fitted(label, left - theme.px(4)).c_str());
  tooltip(field.tip, theme);
  ImGui::SameLine(x + left);
  return number_field(field, value_si, width - left, theme);
}

Edited count_row(const char* label, const char* id, int& value, int least, int most, const std::string& tip,
                 const Theme& theme) {
  double number = value;
  const Edited result = number_row(label, {id, {"", 1.0, 0, 0.1}, double(least), double(most), tip}, number, theme);
  value = int(std::lround(number));
  return result;
}

void text_right(const std::string& text, ImU32 colour) {
  needs_width(ImGui::CalcTextSize(text.c_str()).x);
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  if (room > 0.0f) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

std::string words_of_file(const std::string& path) {
  std::string words = path.substr(path.find_last_of('/') + 1);
  words = words.substr(0, words.find_last_of('.'));
  for (char& c : words)
    if (c == '_') c = ' ';
  return words;
}

std::string fitted(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::string shorter = text;
  while (!shorter.empty()) {
    // Bytes that continue a character go with it.
    while (!shorter.empty() && (static_cast<unsigned char>(shorter.back()) & 0xC0u) == 0x80u) shorter.pop_back();
    if (!shorter.empty()) shorter.pop_back();
    if (ImGui::CalcTextSize((shorter + "…").c_str()).x <= width) return shorter + "…";
  }
  return "…";
}

}  // namespace odolab::ui
