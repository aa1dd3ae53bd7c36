#include "ui/panels/guide_panel.h"

#include <cmath>

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

// One page in the list; true when clicked.
bool page_row(int number, const char* title, bool now, bool reached, const Theme& theme) {
  const float side = ImGui::GetFrameHeight(), width = ImGui::GetContentRegionAvail().x;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushID(number);
  const bool clicked = ImGui::InvisibleButton("##page", {width, side});
  ImGui::PopID();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (now || (reached && ImGui::IsItemHovered()))
    draw.AddRectFilled({at.x - theme.px(4), at.y - theme.px(1)}, {at.x + width, at.y + side + theme.px(1)},
                       now ? theme.pressed : theme.hovered, theme.px(4));
  const ImVec2 centre{at.x + 0.5f * side, at.y + 0.5f * side};
  if (now || reached)
    draw.AddCircleFilled(centre, 0.46f * side, now ? theme.ink : theme.muted);
  else
    draw.AddCircle(centre, 0.46f * side, theme.line, 0, theme.px(1.5f));
  const std::string text = std::to_string(number);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  draw.AddText({std::round(centre.x - 0.5f * size.x), std::round(centre.y - 0.5f * size.y)},
               now || reached ? theme.on_ink : theme.muted, text.c_str());
  const WithFont strong(now ? theme.strong : nullptr);
  draw.AddText({std::round(at.x + side + theme.px(8)), std::round(centre.y - 0.5f * ImGui::GetTextLineHeight())},
               now || reached ? theme.ink : theme.muted, title);
  return clicked && reached && !now;
}

}  // namespace

Actions guide_panel(const GuideView& view, const Theme& theme) {
  Actions actions;
  const float width = ImGui::GetContentRegionAvail().x;
  if (!view.session) {
    heading("Guided calibration", theme);
    note(
        "Page by page, for the simulated robot or for your own. What you enter is kept as you go; you can leave and "
        "come "
        "back.",
        theme);
    ImGui::Dummy({1, theme.px(6)});
    heading("Go on with", theme);
    if (view.saved.empty()) note("Nothing yet.", theme);
    for (const SavedGuide& saved : view.saved) {
      ImGui::PushID(saved.path.c_str());
      ButtonLook look;
      look.tip = saved.path;
      if (text_button(fitted(saved.words, width - theme.px(16)).c_str(), theme, look, width))
        actions.push_back(ResumeGuide{saved.path});
      note(saved.where, theme);
      ImGui::PopID();
    }
    return actions;
  }
  const GuideSession& session = *view.session;
  const Guide& guide = guide_of(session.kind);
  heading(guide.name.c_str(), theme);
  note(session.vehicle.name + (session.real_robot ? ", the real robot" : ", simulated"), theme);
  ImGui::Dummy({1, theme.px(4)});
  for (std::size_t i = 0; i < guide.pages.size(); ++i)
    if (page_row(int(i) + 1, guide.pages[i].title.c_str(), int(i) == session.page, int(i) <= session.reached, theme) &&
        !view.busy) {
      GuideSession next = session;
      turn_to(next, int(i));
      actions.push_back(ChangeGuide{next, GuideEdit::page});
    }
  ImGui::Dummy({1, theme.px(6)});
  ButtonLook leave;
  leave.enabled = !view.busy;
  leave.tip = "Everything entered is kept; go on with it whenever you like.";
  leave.why_disabled = "Busy " + view.job + ".";
  if (text_button("Leave", theme, leave, width)) actions.push_back(LeaveGuide{});
  if (!view.file.empty()) {
    note(view.all_saved ? "All is saved." : "Saving…", theme);
    tooltip(view.file, theme);
  }
  return actions;
}

}  // namespace odolab::ui
