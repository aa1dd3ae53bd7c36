#include "ui/panels/guide_entries.h"

#include <algorithm>

#include "ui/panels/guide_entry_parts.h"

namespace odolab::ui {

void keep(Edited edited, GuidePageState& state, Actions& actions) {
  if (edited == Edited::no) return;
  actions.push_back(ChangeGuide{state.draft, state.editing ? GuideEdit::goes_on : GuideEdit::edit});
  state.editing = edited == Edited::changing;
}

Actions drive_button(const GuideView& view, const char* words, const Theme& theme) {
  Actions actions;
  if (view.session->real_robot) return actions;
  if (view.busy) {
    if (job_progress(view.share_done, theme, theme.px(220), theme.px(90))) actions.push_back(CancelJob{});
    return actions;
  }
  ButtonLook look;
  look.primary = true;
  look.enabled = view.can_simulate.empty();
  look.why_disabled = view.can_simulate;
  look.tip = "The simulation drives it, faster than real time.";
  if (text_button(words, theme, look, theme.px(150))) actions.push_back(DriveGuide{});
  return actions;
}

void clusters(const GuideView& view, bool last_alone, GuidePageState& state, const Theme& theme) {
  if (!view.experiments) return;
  std::vector<BenchExperiment> rounds = *view.experiments;
  if (last_alone && !rounds.empty()) rounds.erase(rounds.begin(), rounds.end() - 1);
  Bench bench;
  bench.experiments = &rounds;
  bench.running = view.busy;
  ImGui::BeginChild("clusters", {0, std::max(theme.px(260), ImGui::GetContentRegionAvail().y - theme.px(4))}, false);
  cluster_panel(bench, state.clusters, theme);
  ImGui::EndChild();
}

Actions guide_entries(const GuideView& view, PageTask task, GuidePageState& state, const Theme& theme) {
  ImGui::Dummy({1, theme.px(2)});
  switch (task) {
    case PageTask::robot:
      return robot_page(view, state, theme);
    case PageTask::tape:
      return tape_page(view, state, theme);
    case PageTask::drive:
      return drive_page(view, state, theme);
    case PageTask::runs:
    case PageTask::bumps:
    case PageTask::again:
      return runs_page(view, task, state, theme);
    case PageTask::recordings:
      return recordings_page(view, theme);
    case PageTask::held_out:
      return held_out_page(view, theme);
    case PageTask::result:
      result_page(view, state, theme);
      return {};
    case PageTask::verdict:
      return verdict_page(view, state, theme);
    case PageTask::finish:
      return finish_page(view, state, theme);
  }
  return {};
}

}  // namespace odolab::ui
