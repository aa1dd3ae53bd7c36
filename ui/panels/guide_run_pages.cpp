// The pages of the drive: runs that are typed, dropped or simulated, and recordings.
#include <algorithm>

#include "core/base/formatted.h"
#include "ui/panels/guide_entry_parts.h"

namespace odolab::ui {

namespace {

// The run that is typed next.
Actions entry_form(const GuideView& view, PageTask task, GuidePageState& state, const Theme& theme) {
  Actions actions;
  GuideSession& s = state.draft;
  const GuideRound& round = *round_on(*view.session, task);
  if (round.runs.empty() && s.draft.source.empty()) s.draft.clockwise = true;
  const bool needs_heading = s.kind == GuideKind::extended_umbmark;
  if (needs_heading) s.draft.has_heading = true;
  const std::string title =
      formatted("Next run: %s %d", s.draft.clockwise ? "cw" : "ccw", counted(round, s.draft.clockwise) + 1);
  heading(title.c_str(), theme);
  const float width = ImGui::GetContentRegionAvail().x;
  if (width > theme.px(600)) ImGui::SameLine(theme.px(190));
  if (const auto way = segmented("way", {"clockwise", "counter-clockwise"}, s.draft.clockwise ? 0 : 1, theme)) {
    s.draft.clockwise = *way == 0;
    actions.push_back(ChangeGuide{s});
  }
  if (!needs_heading) {
    if (width > theme.px(600)) ImGui::SameLine();
    if (ImGui::Checkbox("heading measured", &s.draft.has_heading)) actions.push_back(ChangeGuide{s});
    tooltip("UMBmark needs the place alone.", theme);
  }
  Edited e = Edited::no;
  const bool narrow = width < theme.px(360);  // the words stand above their fields
  const float label = narrow ? ImGui::GetCursorPosX() : std::min(theme.px(190), 0.34f * width);
  const float field = std::min(theme.px(104), 0.5f * (width - label) - theme.px(34));
  const auto pose_row = [&](const char* words, const char* tip, Pose& pose) {
    ImGui::PushID(words);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(words);
    tooltip(tip, theme);
    struct Part {
      const char* name;
      double* value;
      Unit unit;
      bool there;
    };
    const Part parts[] = {{"x", &pose.x_m, kReadMillimetres, true},
                          {"y", &pose.y_m, kReadMillimetres, true},
                          {"heading", &pose.heading_rad, kDegrees, s.draft.has_heading}};
    float x = label;
    bool begun = !narrow;
    for (const Part& part : parts) {
      if (!part.there) continue;
      const bool fits = begun && x + ImGui::CalcTextSize(part.name).x + field < width + theme.px(30);
      if (!fits) x = label;  // on the next line
      if (fits)
        ImGui::SameLine(x);
      else
        ImGui::SetCursorPosX(x);
      begun = true;
      ImGui::AlignTextToFramePadding();
      ImGui::TextDisabled("%s", part.name);
      x += ImGui::CalcTextSize(part.name).x + theme.px(7);
      ImGui::SameLine(x);
      const bool angle = part.name[0] == 'h';
      ImGui::PushID(part.name);
      e = more(e, number_field({"##value", part.unit, angle ? -kPi : -50.0, angle ? kPi : 50.0, tip}, *part.value,
                               field, theme));
      ImGui::PopID();
      x += field + theme.px(10);
    }
    ImGui::PopID();
  };
  pose_row("It stands at",
           "Measured from the start mark: x forward along the first side, y to its left, the heading "
           "counter-clockwise positive.",
           s.draft.measured);
  pose_row("Odometry says", "What the robot believes at the end, set to zero at the start.", s.draft.odometry);
  keep(e, state, actions);
  ButtonLook enter;
  const int cw = counted(round, true), ccw = counted(round, false), wanted = s.runs_each_way;
  enter.primary = cw < wanted || ccw < wanted;
  enter.tip = "The run becomes a point. It can be taken back from the list.";
  if (text_button("Enter this run", theme, enter, theme.px(150))) {
    GuideRun run = s.draft;
    run.source = "typed";
    run.left_out = false;
    enter_run(s, task, run);
    const bool clockwise = next_is_clockwise(*round_on(s, task));
    s.draft = GuideRun{};
    s.draft.clockwise = clockwise;
    s.draft.has_heading = run.has_heading;
    state.editing = false;
    actions.push_back(ChangeGuide{s});
  }
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%d of %d cw, %d of %d ccw%s", cw, wanted, ccw, wanted,
                      cw >= wanted && ccw >= wanted ? ": go on" : "");
  return actions;
}

// The files of a list, each of which can be taken out.
Actions file_list(const GuideView& view, std::vector<std::string> GuideSession::*list, const Theme& theme) {
  Actions actions;
  const std::vector<std::string>& files = view.session->*list;
  ImGui::Dummy({1, theme.px(4)});
  if (files.empty()) note("No recording yet.", theme);
  for (std::size_t i = 0; i < files.size(); ++i) {
    ImGui::PushID(int(i));
    ButtonLook away;
    away.enabled = !view.busy;
    away.tip = "Take this file out; the file itself stays.";
    if (text_button("Take out", theme, away, theme.px(90))) {
      GuideSession s = *view.session;
      (s.*list).erase((s.*list).begin() + long(i));
      actions.push_back(ChangeGuide{s});
    }
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(fitted(words_of_file(files[i]), ImGui::GetContentRegionAvail().x).c_str());
    tooltip(files[i], theme);
    ImGui::PopID();
  }
  return actions;
}

}  // namespace

Actions runs_page(const GuideView& view, PageTask task, GuidePageState& state, const Theme& theme) {
  Actions actions;
  const GuideSession& s = *view.session;
  if (task == PageTask::again && s.rounds.size() > 1) {
    const DifferentialDrive& d = s.rounds.back().nominal;
    const Unit mm{"mm", 1e3, 3, 0.0};
    note("Settings for these runs: wheels " + shown(2.0 * d.wheel_radius_left_m, mm) + " left and " +
             shown(2.0 * d.wheel_radius_right_m, mm) + " right, wheelbase " + shown(d.wheelbase_m, mm) + ".",
         theme);
  }
  append(actions, s.real_robot ? entry_form(view, task, state, theme) : drive_button(view, "Drive", theme));
  clusters(view, task == PageTask::bumps, state, theme);
  return actions;
}

Actions recordings_page(const GuideView& view, const Theme& theme) {
  Actions actions = drive_button(view, "Drive", theme);
  if (view.session->real_robot && view.busy)
    ImGui::ProgressBar(float(view.share_done), {theme.px(220), 0.0f}, view.job.c_str());
  append(actions, file_list(view, &GuideSession::recordings, theme));
  return actions;
}

Actions held_out_page(const GuideView& view, const Theme& theme) {
  Actions actions = drive_button(view, "Drive", theme);
  append(actions, file_list(view, &GuideSession::held_out, theme));
  const std::vector<HeldOutError>& errors = view.outcome->held_out;
  if (errors.empty()) return actions;
  ImGui::Dummy({1, theme.px(4)});
  heading("How far the odometry ends from the truth", theme);
  if (!ImGui::BeginTable("held out", 3, ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_SizingFixedFit)) return actions;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, theme.px(170));
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, theme.px(170));
  ImGui::TableNextRow();
  for (const char* title : {"drive", "as it was", "calibrated"}) {
    ImGui::TableNextColumn();
    if (title[0] == 'd')
      ImGui::TextDisabled("%s", title);
    else
      text_right(title, theme.muted);
  }
  for (const HeldOutError& e : errors) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(words_of_file(e.name).c_str());
    ImGui::TableNextColumn();
    text_right(shown(e.before_m, kMillimetres) + ",  " + shown(e.before_rad, kDegrees), theme.muted);
    ImGui::TableNextColumn();
    WithFont strong(theme.strong);
    text_right(shown(e.after_m, kMillimetres) + ",  " + shown(e.after_rad, kDegrees), theme.ink);
  }
  ImGui::EndTable();
  return actions;
}

}  // namespace odolab::ui
