#include "ui/panels/diagnosis_runs_panel.h"

#include <algorithm>
#include <cstdio>

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

InDiagnosis wish(DiagnosisAction action) { return {std::move(action)}; }

Actions vehicle_part(const DiagnosisView& view, const std::string& drive_vehicle, bool& ask_for_file,
                     const Theme& theme) {
  Actions actions;
  heading("Vehicle, as it is believed to be", theme);
  const float width = ImGui::GetContentRegionAvail().x;
  if (!view.vehicle_name.empty()) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(fitted(view.vehicle_name, width - theme.px(78)).c_str());
    tooltip(view.vehicle_name, theme);
    ImGui::SameLine(width - theme.px(58));
    ButtonLook other;
    other.enabled = !view.mystery;
    other.tip = "Open another vehicle's file, or drop it here";
    other.why_disabled = "The mystery's file; its numbers are a few per cent wrong, as files are.";
    if (text_button("Other…", theme, other, theme.px(70))) ask_for_file = true;
    return actions;
  }
  ButtonLook open, take;
  open.primary = !view.runs.empty();
  open.tip = "A vehicle file (TOML): radii, wheelbase, encoder. It need not be right, it is calibrated first.";
  if (text_button("Open a vehicle…", theme, open, width)) ask_for_file = true;
  take.tip = "The vehicle that Drive has now";
  if (text_button(fitted("Take " + drive_vehicle + " of Drive", width - theme.px(20)).c_str(), theme, take, width))
    actions.push_back(TakeDriveVehicle{});
  return actions;
}

// One line for its name and one for what it is, and what is wrong with it in words.
void run_row(const DiagnosedRun& run, std::size_t r, bool busy, DiagnosisState& state, Actions& actions,
             const Theme& theme) {
  ImGui::PushID(int(r));
  const float width = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float pad = theme.px(5), tick = theme.px(80);
  const float text_x = low.x + pad + theme.px(18), room = width - 2.0f * pad - theme.px(18) - tick;
  // How long and what, on two lines where one is too short for both.
  const std::string lasts = clock(run.duration_s), what = run.simulated ? "simulated" : run.truth;
  const float about_room = width - 2.0f * pad - theme.px(18) - theme.px(20);
  const bool beside = ImGui::CalcTextSize((lasts + "  " + what).c_str()).x <= about_room;
  const float height = (beside ? 2.0f : 3.0f) * line + theme.px(2) + 2.0f * pad;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
#if IMGUI_VERSION_NUM >= 18970
  ImGui::SetNextItemAllowOverlap();
#endif
  const bool clicked = ImGui::InvisibleButton("row", {width, height});
#if IMGUI_VERSION_NUM < 18970
  ImGui::SetItemAllowOverlap();
#endif
  if (clicked) {
    if (state.run != r) {
      state.brush.clear();
      state.time_view.fitted = state.fit_floor = true;
    }
    state.run = r;
    state.lit.reset();
  }
  const bool hovered = ImGui::IsItemHovered();
  tooltip(run.name + (run.provenance.empty() ? "" : "\n" + run.provenance) + "\nClick to look at it.", theme);
  const ImVec2 high{low.x + width, low.y + height};
  const bool shown = state.run == r;
  if (shown || hovered) draw.AddRectFilled(low, high, shown ? theme.pressed : theme.hovered, theme.px(5));
  const ImVec2 dot{low.x + pad + theme.px(5), low.y + pad + 0.5f * line};
  draw.AddCircleFilled(dot, theme.px(5), run.problem.empty() ? run_colour(r, theme) : theme.muted);
  draw.AddText({text_x, low.y + pad}, theme.ink, fitted(run.name, room).c_str());
  const std::string about = lasts + (beside ? "  " : "\n") + what;
  draw.AddText({text_x, low.y + pad + line + theme.px(2)}, theme.muted, about.c_str());

  ImGui::SetCursorScreenPos({high.x - pad - tick, low.y + pad - theme.px(1)});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(theme.px(2), 0.0f));
  bool held_out = run.held_out;
  ImGui::BeginDisabled(busy || !run.problem.empty());
  if (ImGui::Checkbox("hold out", &held_out)) actions.push_back(wish(HoldOut{r, held_out}));
  ImGui::EndDisabled();
  ImGui::PopStyleVar();
  tooltip("Looked at only to prove, once everything is fixed, what was found on the others.", theme);
  ImGui::SetCursorScreenPos({high.x - pad - theme.px(16), low.y + pad + line + theme.px(1)});
  if (ImGui::InvisibleButton("remove", {theme.px(16), line}) && !busy) actions.push_back(wish(RemoveRun{r}));
  const bool on_cross = ImGui::IsItemHovered();
  tooltip("Take it off the list (Ctrl+Z brings it back)", theme);
  if (shown || hovered || on_cross)
    draw_icon(draw, Icon::close, {high.x - pad - theme.px(8), low.y + pad + 1.5f * line + theme.px(1)}, theme.px(10),
              on_cross ? theme.ink : theme.muted);
  ImGui::SetCursorScreenPos({low.x, high.y - theme.px(3)});
  ImGui::Dummy({0, 0});
  if (!run.problem.empty()) warning("Left out: " + run.problem, theme);
  if (shown) {
    for (const std::string& fault : run.faults) note("Fault: " + fault, theme);
    for (const std::string& words : run.notes) note(words, theme);
  } else if (!run.faults.empty()) {
    note(run.faults.size() == 1 ? "1 fault in its data" : std::to_string(run.faults.size()) + " faults in its data",
         theme);
  }
  ImGui::PopID();
}

Actions mystery_part(const DiagnosisView& view, const Theme& theme) {
  Actions actions;
  const MysteryView& m = *view.mystery;
  heading(("Mystery robot " + std::to_string(m.seed)).c_str(), theme);
  const float width = ImGui::GetContentRegionAvail().x;
  if (m.revealed) {
    words("Concealed: " + m.answer, theme.ink);
    words(m.guessed_right ? "You were right." : "You were not.", m.guessed_right ? theme.green : theme.error);
    if (m.tool_asked)
      words(!m.tool_right     ? "The tool did not say so."
            : m.guessed_right ? "So was the tool."
                              : "The tool was right.",
            m.tool_right ? theme.green : theme.error);
    return actions;
  }
  note("One thing is concealed, or nothing, or something in no list.", theme);
  const float button = theme.px(78);
  ImGui::SetNextItemWidth(width - button - ImGui::GetStyle().ItemSpacing.x);
  int chosen = -1;
  for (std::size_t i = 0; i < m.guesses.size(); ++i)
    if (m.guess && m.guesses[i].first == *m.guess) chosen = int(i);
  if (ImGui::BeginCombo("##guess", chosen < 0 ? "Your guess…" : m.guesses[std::size_t(chosen)].second.c_str())) {
    for (std::size_t i = 0; i < m.guesses.size(); ++i)
      if (ImGui::Selectable(m.guesses[i].second.c_str(), chosen == int(i)))
        actions.push_back(wish(GuessMystery{m.guesses[i].first}));
    close_on_escape();
    ImGui::EndCombo();
  }
  ImGui::SameLine();
  ButtonLook reveal;
  reveal.enabled = m.guess.has_value();
  reveal.why_disabled = "Guess first.";
  reveal.tip = "What was concealed. The guess counts.";
  if (text_button("Reveal", theme, reveal, button)) actions.push_back(wish(RevealMystery{}));
  return actions;
}

void seed_row(DiagnosisState& state, const DiagnosisView& view, bool primary, Actions& actions, const Theme& theme,
              float width) {
  const float field = theme.px(64);
  ButtonLook draw;
  draw.enabled = !view.busy;
  draw.primary = primary;
  draw.why_disabled = "Busy " + view.job + ".";
  draw.tip =
      "Draws a robot, what it drives, and one thing that is concealed, sometimes none or one that is in no list. "
      "The same number gives the same mystery.";
  if (text_button("A mystery robot", theme, draw, width - field - ImGui::GetStyle().ItemSpacing.x))
    actions.push_back(wish(DrawMystery{std::uint64_t(std::max(0, state.seed))}));
  ImGui::SameLine();
  ImGui::SetNextItemWidth(field);
  ImGui::InputInt("##seed", &state.seed, 0);
  state.seed = std::clamp(state.seed, 0, 999999);
  tooltip("Its number", theme);
}

void progress_row(const DiagnosisView& view, Actions& actions, const Theme& theme) {
  note(view.job + "…", theme);
  if (job_progress(view.share_done, theme)) actions.push_back(CancelJob{});
}

Actions export_part(const DiagnosisState& state, const Theme& theme) {
  Actions actions;
  heading("Take away", theme);
  const float width = ImGui::GetContentRegionAvail().x, half = 0.5f * (width - ImGui::GetStyle().ItemSpacing.x);
  const std::string folder = state.export_folder.empty() ? "" : state.export_folder + "/";
  const auto button = [&](const char* label, const char* file, DiagnosisExport what, const char* tip, float w) {
    ButtonLook look;
    look.tip = std::string(tip) + "\n" + folder + file;
    if (text_button(label, theme, look, w))
      actions.push_back(wish(ExportDiagnosis{what, folder + file, state.run, state.brush}));
  };
  button("Report page", "diagnosis.html", DiagnosisExport::report, "One page with all pictures, as diagnose --html",
         half);
  ImGui::SameLine();
  button("Fitted model", "model.toml", DiagnosisExport::model, "For predict --model, as diagnose --model", half);
  button("JSON", "diagnosis.json", DiagnosisExport::json, "For scripts, as diagnose --json", half);
  ImGui::SameLine();
  button(state.brush.empty() ? "CSV of this run" : "CSV of the stretch", "mismatch.csv", DiagnosisExport::csv,
         "Truth, simulation and mismatch of what is shown", half);
  ButtonLook picture;
  picture.tip = "This window as it is (F12)";
  if (text_button("Picture", theme, picture, width)) actions.push_back(SavePicture{});
  return actions;
}

}  // namespace

ImU32 run_colour(std::size_t run, const Theme& theme) {
  const ImU32 colours[] = {theme.blue, theme.orange, theme.green, theme.purple, theme.sky, theme.bump_edge};
  return colours[run % 6];
}

Actions diagnosis_runs_panel(const DiagnosisView& view, DiagnosisState& state, const std::string& drive_vehicle,
                             bool& ask_for_file, const Theme& theme) {
  Actions actions = vehicle_part(view, drive_vehicle, ask_for_file, theme);
  if (view.mystery) append(actions, mystery_part(view, theme));
  const float width = ImGui::GetContentRegionAvail().x;
  heading("Runs", theme);
  if (view.runs.empty()) note("None yet. Drop recordings here: CSV, ROS 2 bags, or what import knows.", theme);
  state.run = view.runs.empty() ? 0 : std::min(state.run, view.runs.size() - 1);
  for (std::size_t r = 0; r < view.runs.size(); ++r) run_row(view.runs[r], r, view.busy, state, actions, theme);
  const float half = 0.5f * (width - ImGui::GetStyle().ItemSpacing.x);
  ButtonLook add, clear;
  add.tip = "Open a recording (Ctrl+O), or drop files on the window";
  if (text_button("Add…", theme, add, view.runs.empty() ? width : half)) ask_for_file = true;
  if (!view.runs.empty()) {
    ImGui::SameLine();
    clear.enabled = !view.busy;
    clear.why_disabled = "Busy " + view.job + ".";
    clear.tip = "Empty the list (Ctrl+Z brings it back)";
    if (text_button("Clear", theme, clear, half)) actions.push_back(wish(ClearRuns{}));
  }
  ImGui::Dummy({1, theme.px(2)});
  if (view.busy) {
    if (!view.runs.empty()) progress_row(view, actions, theme);  // else the middle shows it
  } else {
    ButtonLook ask;
    ask.primary = view.can_diagnose && (!view.diagnosis || view.stale);
    ask.enabled = view.can_diagnose;
    ask.why_disabled = view.why_not;
    ask.tip = "Where do the recordings and the vehicle's model differ, and what physics was left out?";
    if (text_button(view.diagnosis ? "Diagnose again" : "Diagnose", theme, ask, width))
      actions.push_back(wish(FindMissing{}));
    if (view.stale) note("The list has changed since the answer on the right.", theme);
  }
  if (!view.problem.empty() && !view.runs.empty()) warning(view.problem, theme);  // else the middle says it
  if (view.diagnosis) append(actions, export_part(state, theme));
  if (!view.runs.empty() && (!view.mystery || view.mystery->revealed)) {
    heading("Practise", theme);
    seed_row(state, view, false, actions, theme, width);
  }
  return actions;
}

Actions diagnosis_welcome(const DiagnosisView& view, DiagnosisState& state, bool& ask_for_file, const Theme& theme) {
  Actions actions;
  const ImVec2 pane = ImGui::GetWindowSize();
  const float width = std::min(theme.px(460), pane.x - theme.px(48));
  ImGui::SetCursorPos({0.5f * (pane.x - width), std::max(theme.px(40), 0.5f * pane.y - theme.px(150))});
  ImGui::BeginChild("welcome", {width, theme.px(330)});
  {
    WithFont large(theme.large);
    ImGui::TextUnformatted("Find the missing physics");
  }
  words("Recordings with an outside truth say where a robot and its model part.", theme.ink, width);
  words("This finds what was left out, how much of it, and proves it on runs that it has not seen.", theme.ink, width);
  ImGui::Dummy({1, theme.px(10)});
  ButtonLook open, vehicle;
  open.primary = true;
  open.tip = "CSV, ROS 2 bags, pairs of files: what `odolab import` knows, or just drop them here";
  if (text_button("Open recordings, or drop them here…", theme, open, width)) ask_for_file = true;
  vehicle.tip = "The vehicle's file as it is believed to be";
  if (text_button(view.vehicle_name.empty() ? "Open a vehicle…" : "Open another vehicle…", theme, vehicle, width))
    ask_for_file = true;
  ImGui::Dummy({1, theme.px(6)});
  note("No recordings at hand? A robot whose fault is concealed: guess it, then ask.", theme);
  seed_row(state, view, false, actions, theme, width);
  if (view.busy) progress_row(view, actions, theme);
  if (!view.problem.empty()) warning(view.problem, theme);
  ImGui::EndChild();
  return actions;
}

}  // namespace odolab::ui
