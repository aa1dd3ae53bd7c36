#include "ui/panels/diagnosis_findings_panel.h"

#include <algorithm>
#include <cmath>

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

void two_columns(const std::string& name, const std::string& value, ImU32 ink) {
  ImGui::TextDisabled("%s", name.c_str());
  ImGui::SameLine();
  if (ImGui::CalcTextSize(value.c_str()).x > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
  text_right(value, ink);
}

void two_columns(const std::string& name, const std::string& value, const Theme& theme) {
  two_columns(name, value, theme.ink);
}

// Turns towards the run in which a finding was located, and lights it there.
void look_at(const DiagnosisView& view, std::size_t finding, DiagnosisState& state) {
  state.lit = finding;
  state.brush.clear();
  for (std::size_t step = 0; step < view.runs.size(); ++step) {
    const std::size_t r = (state.run + step) % view.runs.size();
    std::vector<Stretch> found = stretches_of(view.runs[r], finding);
    if (found.empty()) continue;
    if (state.run != r) state.time_view.fitted = state.fit_floor = true;
    state.run = r;
    state.brush = std::move(found);
    return;
  }
}

Actions card(const DiagnosisView& view, std::size_t k, DiagnosisState& state, const Theme& theme) {
  Actions actions;
  const FindingCard& f = view.findings[k];
  ImGui::PushID(int(k));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, pad = theme.px(9), inner = width - 2.0f * pad;
  draw.ChannelsSplit(2);
  draw.ChannelsSetCurrent(1);
  ImGui::SetCursorScreenPos({low.x + pad, low.y + theme.px(7)});
  ImGui::BeginGroup();
  {
    WithFont strong(theme.strong);
    words(f.title, theme.ink, inner);
  }
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(theme.px(8), theme.px(3)));
  if (!f.sentence.empty()) words(f.sentence + ".", theme.ink, inner);
  for (const auto& [name, value] : f.parameters) {
    const float value_width = ImGui::CalcTextSize(value.c_str()).x, name_width = ImGui::CalcTextSize(name.c_str()).x;
    ImGui::TextDisabled("%s", name.c_str());
    if (name_width + value_width + theme.px(10) < inner) ImGui::SameLine();
    ImGui::SetCursorScreenPos({low.x + pad + std::max(0.0f, inner - value_width), ImGui::GetCursorScreenPos().y});
    ImGui::TextUnformatted(value.c_str());
  }
  if (!f.where.empty()) words(f.where, theme.muted, inner);
  if (!f.evidence.empty()) words(f.evidence, theme.muted, inner);
  for (const auto& [which, told_apart_by] : f.alternatives) {
    words(which, theme.orange, inner);
    if (!told_apart_by.empty()) tooltip("Told apart by " + told_apart_by + ".", theme);
  }
  ImGui::PopStyleVar();
  if (f.can_be_switched) {
    bool on = f.on;
    ImGui::BeginDisabled(view.busy);
    if (ImGui::Checkbox("in the simulation", &on)) actions.push_back(InDiagnosis{SwitchFinding{k, on}});
    ImGui::EndDisabled();
    tooltip(view.busy ? "Busy " + view.job + "."
                      : "Switched on, the simulated track moves to where this puts it, beside the recorded one.",
            theme);
  }
  const bool located = std::any_of(view.runs.begin(), view.runs.end(),
                                   [&](const DiagnosedRun& r) { return !stretches_of(r, k).empty(); });
  if (located) {
    if (f.can_be_switched) ImGui::SameLine();
    ButtonLook show;
    show.toggled = state.lit == k;
    show.tip = "Light where it was located, on the floor and in the plot";
    if (text_button("show where", theme, show)) look_at(view, k, state);
  }
  ImGui::EndGroup();
  const float bottom = ImGui::GetItemRectMax().y + theme.px(7);
  draw.ChannelsSetCurrent(0);
  draw.AddRectFilled(low, {low.x + width, bottom}, f.on ? theme.note_paper : theme.raised, theme.px(5));
  draw.AddRect(low, {low.x + width, bottom}, f.on ? theme.blue : theme.line, theme.px(5), 0,
               theme.px(f.on ? 1.6f : 1.0f));
  draw.ChannelsMerge();
  ImGui::SetCursorScreenPos({low.x, bottom + theme.px(6)});
  ImGui::Dummy({0, 0});
  ImGui::PopID();
  return actions;
}

void simulation_part(const DiagnosisView& view, const Theme& theme) {
  if (!view.simulated_before) return;
  heading("Simulation against the recordings", theme);
  const auto figures = [](const FitFigures& f) {
    return shown(f.position_rms_m, kMillimetres, 2) + "   " + shown(f.heading_rms_rad, kDegrees, 3);
  };
  two_columns("calibrated", figures(*view.simulated_before), theme);
  if (view.findings_on() && view.simulated_now) two_columns("switched on", figures(*view.simulated_now), theme);
  note("Error " + view.over_which_way + ", root mean square, of all runs.", theme);
}

void proof_part(const DiagnosisView& view, const Theme& theme) {
  if (view.proof.empty()) return;
  heading(view.proof_title.c_str(), theme);
  double largest = 0.0;
  for (const ProofBar& bar : view.proof) largest = std::max(largest, bar.position_rms_m);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float width = ImGui::GetContentRegionAvail().x, thick = theme.px(9);
  for (const ProofBar& bar : view.proof) {
    const std::string heading = std::isnan(bar.heading_rms_rad) ? "" : "  " + shown(bar.heading_rms_rad, kDegrees, 3);
    two_columns(bar.label, shown(bar.position_rms_m, kMillimetres, 2) + heading, theme);
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImU32 colour = bar.kind == ProofBar::Kind::calibrated      ? theme.orange
                         : bar.kind == ProofBar::Kind::with_findings ? theme.blue
                                                                     : theme.green;
    const float length = largest > 0.0 ? float(bar.position_rms_m / largest) * width : 0.0f;
    draw.AddRectFilled(low, {low.x + width, low.y + thick}, theme.hovered, theme.px(2));
    draw.AddRectFilled(low, {low.x + std::max(theme.px(2), length), low.y + thick}, colour, theme.px(2));
    ImGui::Dummy({width, thick + theme.px(2)});
  }
  note("Predicted from the wheels alone, " + view.over_which_way + ".", theme);
}

Actions advice_part(const DiagnosisView& view, DiagnosisState& state, const Theme& theme) {
  Actions actions;
  if (view.next_drive.empty()) return actions;
  heading("Drive next", theme);
  words(view.next_drive, theme.ink);
  if (view.diagnosis->next_legs.empty()) {
    if (!view.busy) note(view.why_no_advice, theme);
    return actions;
  }
  const float width = ImGui::GetContentRegionAvail().x, half = 0.5f * (width - ImGui::GetStyle().ItemSpacing.x);
  ButtonLook show, drive;
  show.toggled = state.show_advice;
  show.tip = "The way of it, dotted on the floor, from where the first run began";
  if (text_button("On the floor", theme, show, half)) state.show_advice = !state.show_advice;
  ImGui::SameLine();
  drive.enabled = view.can_simulate_advice;
  drive.why_disabled = view.why_no_advice;
  drive.tip = view.mystery
                  ? "The mystery robot drives it; the recording joins the list."
                  : "A robot as it was found drives it in the simulation; the recording joins the list. It says "
                    "nothing new about a real robot: drive that one for evidence.";
  if (text_button("Simulate it", theme, drive, half)) actions.push_back(InDiagnosis{SimulateAdvice{}});
  return actions;
}

void asked_part(const DiagnosisView& view, const Theme& theme) {
  if (view.asked.empty()) return;
  ImGui::Dummy({1, theme.px(4)});
  if (!ImGui::TreeNodeEx("Every effect that was asked for", ImGuiTreeNodeFlags_NoTreePushOnOpen)) return;
  for (const AskedRow& row : view.asked) {
    two_columns(row.effect, row.answer, row.named ? theme.blue : theme.ink);
    tooltip(row.grounds, theme);
  }
  note("How likely chance alone would say as much, all that was tried allowed for.", theme);
}

}  // namespace

std::vector<Stretch> stretches_of(const DiagnosedRun& run, std::size_t finding) {
  std::vector<Stretch> found;
  for (const LocatedStretch& s : run.located)
    if (s.finding == finding) found.emplace_back(s.from_s, s.to_s);
  return found;
}

Actions diagnosis_findings_panel(const DiagnosisView& view, DiagnosisState& state, const Theme& theme) {
  Actions actions;
  if (!view.diagnosis) {
    heading("What you will see", theme);
    note(
        "Whether anything is missing. What, where and how much, each with its error and what else it could be. The "
        "proof on runs that were not looked at, what these runs cannot tell, and what to drive next.",
        theme);
    return actions;
  }
  heading("The answer", theme);
  {
    WithFont strong(theme.strong);
    words(view.verdict, theme.ink);
  }
  ImGui::Dummy({1, theme.px(2)});
  for (std::size_t k = 0; k < view.findings.size(); ++k) append(actions, card(view, k, state, theme));
  simulation_part(view, theme);
  proof_part(view, theme);
  append(actions, advice_part(view, state, theme));
  if (!view.not_testable.empty()) {
    heading("What these runs cannot tell", theme);
    for (const auto& [what, why] : view.not_testable) {
      ImGui::Bullet();
      ImGui::TextUnformatted(fitted(what, ImGui::GetContentRegionAvail().x).c_str());
      tooltip(why, theme);
    }
  }
  asked_part(view, theme);
  if (!view.diagnosis->warnings.empty()) {
    heading("To be aware of", theme);
    for (const std::string& w : view.diagnosis->warnings) note(w, theme);
  }
  return actions;
}

}  // namespace odolab::ui
