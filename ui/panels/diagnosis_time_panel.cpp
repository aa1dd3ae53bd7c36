#include "ui/panels/diagnosis_time_panel.h"

#include <algorithm>

#include "core/base/formatted.h"
#include "core/vehicle/key_words.h"
#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

constexpr Unit kTimesNoise{"×", 1.0, 1, 0.0};

std::string brush_words(const DiagnosedRun& run, const DiagnosisState& state) {
  if (state.brush.empty()) return "Drag over the plot, or a rectangle on the floor, to light a stretch in both.";
  double before = 0.0, after = 0.0, length_s = 0.0;
  for (const Stretch& s : state.brush) {
    before = std::max(before, run.mismatch->largest_before(s.first, s.second));
    after = std::max(after, run.mismatch->largest_after(s.first, s.second));
    length_s += s.second - s.first;
  }
  std::string all;
  if (state.brush.size() == 1)
    all = formatted("%.2f to %.2f s: up to %.1f× the noise", state.brush[0].first, state.brush[0].second, before);
  else
    all = formatted("%zu stretches, %.1f s: up to %.1f× the noise", state.brush.size(), length_s, before);
  if (!run.mismatch->after.empty()) all += formatted(", with what was found %.1f×", after);
  return all;
}

// What tows has no name of its own.
std::string unit_words(const std::string& unit) { return unit.empty() ? "towing" : part_words(unit); }

void over_time(const DiagnosisView& view, const DiagnosedRun& run, DiagnosisState& state, ImVec2 size,
               const Theme& theme) {
  Plot what;
  what.x = {"time", kSeconds};
  what.y = {"mismatch, times the noise", kTimesNoise};
  what.from_zero = true;
  what.least_y_span = 3.0;
  what.x_low = 0.0;
  what.x_high = run.duration_s;
  what.brushes = true;
  what.empty_text = !run.problem.empty() ? "Left out: " + run.problem
                    : !view.diagnosis    ? "The mismatch over time, once it was diagnosed"
                    : view.diagnosis->verdict == Verdict::cannot_say
                        ? "Too little truth along this run for a mismatch over time"
                    : run.held_out ? "Held out, and nothing to draw over time: judged by the bars on the right"
                                   : "This run was not part of the answer";
  const double from_s = run.mismatch ? axis_origin_s(run.mismatch->time_s.front()) : 0.0;
  std::vector<double> since_s = run.mismatch ? run.mismatch->time_s : std::vector<double>{0.0};
  for (double& t : since_s) t -= from_s;
  const double noise_x[2] = {since_s.front(), since_s.back()};
  const double noise_y[2] = {1.0, 1.0};
  if (run.mismatch) {
    const MismatchOverTime& m = *run.mismatch;
    what.series.push_back({"noise", noise_x, noise_y, 2, theme.green, Stroke::dotted, Marker::none});
    what.series.push_back(
        {"calibrated only", since_s.data(), m.before.data(), since_s.size(), theme.orange, Stroke::line, Marker::none});
    if (!m.after.empty())
      what.series.push_back({"with what was found", since_s.data(), m.after.data(), m.after.size(), theme.blue,
                             Stroke::line, Marker::none});
    what.x_low = since_s.front();
    what.x_high = since_s.back();
    const auto band = [&](double low_s, double high_s, ImU32 colour) {
      what.bands.push_back({low_s - from_s, high_s - from_s, colour});
    };
    for (const LocatedStretch& s : run.located) band(s.from_s, s.to_s, faded(theme.purple, 0.30f));
    for (const Stretch& s : state.brush) band(s.first, s.second, faded(theme.sky, 0.35f));
  }
  const PlotResult result = plot("mismatch over time", size, what, state.time_view, theme);
  if (!run.mismatch) return;
  if (result.brushed) {
    state.brush = {{result.brushed->first + from_s, result.brushed->second + from_s}};
    state.lit.reset();
  } else if (result.clicked_x) {
    state.brush.clear();
    state.lit.reset();
  }
}

// "yaw rate [rad/s]" as the axes of this window have it: "yaw rate (rad/s)"; a pure number has no unit.
std::string axis_words(const std::string& quantity) {
  const std::size_t at = quantity.find(" [");
  if (at == std::string::npos) return quantity;
  std::string unit = quantity.substr(at + 2, quantity.find(']', at) - at - 2);
  if (unit == "m/s2") unit = "m/s²";
  return quantity.substr(0, at) + (unit == "1" ? "" : " (" + unit + ")");
}

void response(const DiagnosisView& view, DiagnosisState& state, ImVec2 size, const Theme& theme) {
  const std::vector<Response>& all = *view.responses;
  Plot what;
  what.empty_text = "No variable of the motion was tried";
  if (!all.empty()) {
    const Response& r = all[std::size_t(state.response)];
    what.x = {axis_words(r.variable), Unit{"", 1.0, 2, 0.0}};
    what.y = {axis_words(r.channel), Unit{"", 1.0, 5, 0.0}};
    what.areas.push_back({r.at.data(), r.low.data(), r.high.data(), r.at.size(), faded(theme.orange, 0.22f)});
    what.series.push_back(
        {"calibrated only", r.at.data(), r.value.data(), r.at.size(), theme.orange, Stroke::line, Marker::disc});
    if (!r.after.empty())
      what.series.push_back({"with what was found", r.at.data(), r.after.data(), r.after.size(), theme.blue,
                             Stroke::dashed, Marker::none});
    what.legend = false;
  }
  plot("response", size, what, state.response_view, theme);
}

void response_choice(const DiagnosisView& view, DiagnosisState& state, float width) {
  const std::vector<Response>& all = *view.responses;
  if (all.empty()) return;
  state.response = std::clamp(state.response, 0, int(all.size()) - 1);
  const auto label = [](const Response& r) {
    return r.channel.substr(0, r.channel.find(" [")) + " against " + r.variable.substr(0, r.variable.find(" ["));
  };
  ImGui::SetNextItemWidth(width);
  const float room = width - ImGui::GetFrameHeight() - 2.0f * ImGui::GetStyle().FramePadding.x;
  if (!ImGui::BeginCombo("##response", fitted(label(all[std::size_t(state.response)]), room).c_str())) return;
  for (int k = 0; k < int(all.size()); ++k)
    if (ImGui::Selectable(label(all[std::size_t(k)]).c_str(), k == state.response)) {
      state.response = k;
      state.response_view.fitted = true;
    }
  close_on_escape();
  ImGui::EndCombo();
}

}  // namespace

Actions diagnosis_time_panel(const DiagnosisView& view, DiagnosisState& state, const Theme& theme) {
  Actions actions;
  if (view.runs.empty()) {
    note("The mismatch over time and what it depends on will stand here.", theme);
    return actions;
  }
  const DiagnosedRun& run = view.runs[std::min(state.run, view.runs.size() - 1)];
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float gap = theme.px(16), line = ImGui::GetFrameHeight() + theme.px(4);
  const bool two =
      view.responses && room.x > theme.px(700) &&
      std::any_of(view.responses->begin(), view.responses->end(), [](const Response& r) { return !r.at.empty(); });
  const float left = two ? std::round(0.62f * room.x) : room.x, right = room.x - left - gap;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(fitted(run.held_out ? run.name + ", held out" : run.name, 0.3f * left).c_str());
  if (run.units.size() > 1) {
    ImGui::SameLine(0, theme.px(14));
    std::vector<std::string> labels;
    int shown = 0;
    for (std::size_t u = 0; u < run.units.size(); ++u) {
      labels.push_back(unit_words(run.units[u]));
      if (run.units[u] == run.unit) shown = int(u);
    }
    if (const auto choice = segmented("unit", labels, shown, theme))
      actions.push_back(InDiagnosis{ShowUnit{run.units[std::size_t(*choice)]}});
  }
  if (run.mismatch) {
    ImGui::SameLine(0, theme.px(14));
    ImGui::TextDisabled("%s", fitted(brush_words(run, state), left - ImGui::GetCursorPosX()).c_str());
  }
  if (two) {
    ImGui::SameLine(left + gap + ImGui::GetStyle().WindowPadding.x);
    response_choice(view, state, right);
  }
  const float height = std::max(theme.px(60), room.y - line);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  over_time(view, run, state, {left, height}, theme);
  if (two) {
    ImGui::SetCursorScreenPos({at.x + left + gap, at.y});
    response(view, state, {right, height}, theme);
  }
  return actions;
}

}  // namespace odolab::ui
