#include "ui/panels/guide_page.h"

#include <algorithm>

#include "ui/look/widgets.h"
#include "ui/panels/guide_drawing.h"
#include "ui/panels/guide_entries.h"

namespace odolab::ui {

namespace {

void paragraph(const std::string& text, const Theme& theme) {
  words(text, theme.ink, std::min(ImGui::GetContentRegionAvail().x, theme.px(760)));
  ImGui::Dummy({1, theme.px(1)});
}

// No guide is open: which one, and for which robot.
Actions choose(const GuideView& view, const Theme& theme) {
  Actions actions;
  {
    WithFont large(theme.large);
    ImGui::TextUnformatted("What shall be calibrated?");
  }
  for (const Guide& guide : guides()) {
    ImGui::Dummy({1, theme.px(8)});
    heading(guide.name.c_str(), theme);
    paragraph(guide.about, theme);
    ImGui::PushID(guide.key.c_str());
    ButtonLook real, simulated;
    real.primary = guide.kind == GuideKind::umbmark;
    real.tip = "You drive it, and type or drop what you measured.";
    simulated.tip = "The simulation drives, as far as it can be driven in Drive.";
    if (text_button("My real robot", theme, real, theme.px(150))) actions.push_back(BeginGuide{guide.kind, true});
    ImGui::SameLine();
    if (text_button("A simulated one", theme, simulated, theme.px(150)))
      actions.push_back(BeginGuide{guide.kind, false});
    ImGui::PopID();
  }
  if (!view.problem.empty()) warning(view.problem, theme);
  return actions;
}

Actions navigation(const GuideView& view, const Theme& theme) {
  Actions actions;
  const GuideSession& session = *view.session;
  const Guide& guide = guide_of(session.kind);
  const float width = ImGui::GetContentRegionAvail().x, button = std::min(theme.px(120), 0.46f * width);
  const auto to = [&](int page) {
    GuideSession next = session;
    turn_to(next, page);
    actions.push_back(ChangeGuide{next, GuideEdit::page});
  };
  ButtonLook back;
  back.enabled = session.page > 0 && !view.busy;
  if (text_button("Back", theme, back, button)) to(session.page - 1);
  const bool last = session.page + 1 == int(guide.pages.size());
  if (last) return actions;
  const std::string missing = still_to_do(session);
  ButtonLook next;
  next.primary = true;
  next.enabled = missing.empty() && !view.busy;
  next.why_disabled = view.busy ? "Busy " + view.job + "." : missing;
  ImGui::SameLine();
  if (!missing.empty() && !view.busy && width > 3.0f * button) {
    const std::string why = fitted(missing, width - 2.0f * button - theme.px(40));
    ImGui::AlignTextToFramePadding();
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + theme.px(8));
    ImGui::TextDisabled("%s", why.c_str());
    ImGui::SameLine();
  }
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - button);
  if (text_button("Next", theme, next, button)) to(session.page + 1);
  return actions;
}

}  // namespace

Actions guide_page(const GuideView& view, GuidePageState& state, const Theme& theme) {
  Actions actions;
  const ImVec2 pad{theme.px(18), theme.px(12)};
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, pad);
  const float bottom = view.session ? ImGui::GetFrameHeight() + theme.px(22) : 0.0f;
  const ImVec2 low = ImGui::GetCursorPos();
  const float height = ImGui::GetContentRegionAvail().y - bottom;
  ImGui::BeginChild("page", {0, height - state.covered_below}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  if (!view.session) {
    append(actions, choose(view, theme));
  } else {
    if (!state.editing || !ImGui::IsAnyItemActive()) {
      state.draft = *view.session;
      state.editing = false;
    }
    const GuidePage& page = guide_of(view.session->kind).pages[std::size_t(view.session->page)];
    {
      WithFont large(theme.large);
      ImGui::TextUnformatted(page.title.c_str());
    }
    for (const std::string& words : page.words) paragraph(words, theme);
    for (const std::string& words : view.session->real_robot ? page.for_the_real : page.for_the_simulated)
      paragraph(words, theme);
    if (!view.problem.empty()) warning(view.problem, theme);
    append(actions, guide_entries(view, page.task, state, theme));
  }
  ImGui::EndChild();
  ImGui::SetCursorPos({low.x, low.y + height + ImGui::GetStyle().ItemSpacing.y});
  if (view.session) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    draw.AddLine(at, {at.x + ImGui::GetContentRegionAvail().x, at.y}, theme.line);
    ImGui::BeginChild("way", {0, 0}, false, ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar);
    ImGui::SetCursorPosY(theme.px(8));
    append(actions, navigation(view, theme));
    ImGui::EndChild();
  }
  ImGui::PopStyleVar();
  return actions;
}

}  // namespace odolab::ui
