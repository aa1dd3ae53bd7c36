#include "ui/panels/guide_notes_panel.h"

#include "core/guide/misfit.h"
#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

// The round of a page within a session that may be changed.
std::vector<GuideRun>* runs_of(GuideSession& session, PageTask task) {
  if (task == PageTask::runs) return session.rounds.empty() ? nullptr : &session.rounds.front().runs;
  if (task == PageTask::again) return session.rounds.size() < 2 ? nullptr : &session.rounds.back().runs;
  return task == PageTask::bumps ? &session.bumped.runs : nullptr;
}

// While there is nothing to say yet: what the guide looks for.
void append_words_before(GuideKind kind, const Theme& theme) {
  heading("What it looks for", theme);
  switch (kind) {
    case GuideKind::umbmark:
      note("Type A: a wrong wheelbase. Every turn is too large or too small.", theme);
      note("Type B: unequal wheels. Straight sides become arcs.", theme);
      note("The scale: both wheels larger or smaller than believed.", theme);
      note(
          "Driven one way, types A and B can cancel each other at the end of the square. Driven the other way they add "
          "up. "
          "Both ways together tell them apart (J. Borenstein, L. Feng, UMBmark, 1994).",
          theme);
      break;
    case GuideKind::extended_umbmark:
      note(
          "How far a bump turns the robot. A wheel that climbs a bump rolls further than the robot moves, and the "
          "odometry "
          "cannot know.",
          theme);
      break;
    case GuideKind::castors:
      note(
          "For each castor the radius of both wheels, their distance to the line through the pivot, the distance from "
          "axle "
          "to pivot, and the zero of the pivot's encoder.",
          theme);
      note("J. Doebbler, J. J. Davis, J. L. Junkins, J. Valasek, 2008.", theme);
      break;
    case GuideKind::linked:
      note(
          "The zero of both rotary encoders and of the linear one, the wheelbases of both trucks and the ratios of "
          "their "
          "wheels. The scale is that of truck A's mean wheel: no encoder on board can find it.",
          theme);
      note("J. Borenstein, 1995.", theme);
      break;
  }
}

Actions run_list(const GuideView& view, PageTask task, const GuideRound& round, const Theme& theme) {
  Actions actions;
  const bool narrow = ImGui::GetContentRegionAvail().x < theme.px(210);
  const Unit mm{"", 1e3, narrow ? 0 : 1, 0.0}, deg{"°", kDegrees.per_si, narrow ? 1 : 2, 0.0};
  heading("Runs", theme);
  if (round.runs.empty()) {
    note("None yet.", theme);
    return actions;
  }
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding,
                      ImVec2(narrow ? theme.px(2) : ImGui::GetStyle().CellPadding.x, ImGui::GetStyle().CellPadding.y));
  if (ImGui::BeginTable("runs", 5, ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_NoPadOuterX)) {
    for (const float weight : {0.85f, 0.95f, 0.95f, 0.9f, 0.55f})
      ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, weight);
    ImGui::TableNextRow();
    for (const char* title : {"run", "x mm", "y mm", narrow ? "turn" : "turned", ""}) {
      ImGui::TableNextColumn();
      if (title[0] == 'r')
        ImGui::TextDisabled("%s", title);
      else
        text_right(title, theme.muted);
    }
    tooltip("Return errors: where it really stands less what its odometry says (Eq. 3.1).", theme);
    int number[2] = {0, 0};
    for (std::size_t i = 0; i < round.runs.size(); ++i) {
      const GuideRun& run = round.runs[i];
      const ReturnError e = return_error(run);
      const bool misfit = i < view.misfits.size() && view.misfits[i];
      const ImU32 colour = run.left_out ? faded(theme.muted, 0.7f) : misfit ? theme.error : theme.ink;
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::PushID(int(i));
      ImGui::PushStyleColor(ImGuiCol_Text, run.left_out    ? faded(theme.muted, 0.7f)
                                           : run.clockwise ? theme.orange
                                                           : theme.blue);
      ImGui::AlignTextToFramePadding();
      ImGui::Text("%s %d", run.clockwise ? "cw" : "ccw", ++number[run.clockwise]);
      ImGui::PopStyleColor();
      tooltip(run.left_out ? "Left out by you." : misfit ? misfit_rule() : run.source, theme);
      for (const std::string& text :
           {shown(e.x_m, mm), shown(e.y_m, mm), run.has_heading ? shown(e.heading_rad, deg) : std::string("–")}) {
        ImGui::TableNextColumn();
        ImGui::AlignTextToFramePadding();
        text_right(text, colour);
      }
      ImGui::TableNextColumn();
      ImGui::BeginDisabled(view.busy);
      if (ImGui::Button("…", {-1.0f, 0.0f})) ImGui::OpenPopup("run");
      ImGui::EndDisabled();
      if (ImGui::BeginPopup("run")) {
        GuideSession s = *view.session;
        std::vector<GuideRun>* runs = runs_of(s, task);
        if (runs && ImGui::MenuItem(run.left_out ? "Count it again" : "Leave it out")) {
          (*runs)[i].left_out = !run.left_out;
          actions.push_back(ChangeGuide{s});
        }
        if (runs && s.real_robot && ImGui::MenuItem("Take it back to correct it")) {
          s.draft = run;
          runs->erase(runs->begin() + long(i));
          actions.push_back(ChangeGuide{s});
        }
        close_on_escape();
        ImGui::EndPopup();
      }
      ImGui::PopID();
    }
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
  bool any = false;
  for (std::size_t i = 0; i < view.misfits.size(); ++i) any = any || (view.misfits[i] && !round.runs[i].left_out);
  if (any) {
    warning("A run does not fit the others of its direction.", theme);
    note(misfit_rule(), theme);
  }
  return actions;
}

}  // namespace

Actions guide_notes_panel(const GuideView& view, const Theme& theme) {
  Actions actions;
  if (!view.session) {
    heading("What you need", theme);
    note(
        "For a real robot: a smooth floor of 5 by 5 m, a tape measure, tape for a mark on the floor, and a display of "
        "the "
        "robot's odometry. Half an hour.",
        theme);
    note("The simulated robot is the one of Drive, or a usual one where that does not fit the guide.", theme);
    return actions;
  }
  const PageTask task = guide_of(view.session->kind).pages[std::size_t(view.session->page)].task;
  const GuideRound* round = round_on(*view.session, task);
  if (round && task != PageTask::verdict) append(actions, run_list(view, task, *round, theme));
  const GuideOutcome& out = *view.outcome;
  if (task == PageTask::robot || task == PageTask::tape || task == PageTask::drive || (!round && out.sentences.empty()))
    append_words_before(view.session->kind, theme);
  const bool measured = !out.rounds.empty() && out.rounds.front().measure;
  if (task == PageTask::runs && !measured) return actions;
  if (!out.sentences.empty() && task != PageTask::robot && task != PageTask::drive) {
    heading("What it says", theme);
    for (const std::string& sentence : out.sentences) {
      words(sentence, theme.ink);
      ImGui::Dummy({1, theme.px(2)});
    }
  }
  if (task == PageTask::result && view.session->kind == GuideKind::umbmark && !out.rounds.empty() &&
      out.rounds.front().only_clockwise) {
    heading("One direction alone", theme);
    const OneDirectionCalibration& o = *out.rounds.front().only_clockwise;
    note("The clockwise squares alone would have blamed the wheelbase, promised " +
             shown(o.predicted_error_this_way_m, kMillimetres) + ", and left " +
             shown(o.predicted_error_other_way_m, kMillimetres) + " the other way round.",
         theme);
  }
  if (!out.warnings.empty() && task != PageTask::robot && task != PageTask::tape && task != PageTask::drive) {
    heading("To bear in mind", theme);
    for (const std::string& sentence : out.warnings) note(sentence, theme);
  }
  return actions;
}

}  // namespace odolab::ui
