#include "ui/panels/transport_bar.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

constexpr float kSpeedChoice = 96.0f;  // its width in points

void transport_buttons(const Transport& t, const Theme& theme, Actions& actions) {
  const auto button = [&](const char* id, Icon icon, const char* tip, bool enabled, const char* why,
                          bool primary = false) {
    ButtonLook look;
    look.enabled = t.enabled && enabled;
    look.primary = primary;
    look.tip = tip;
    look.why_disabled = t.enabled ? why : t.why_disabled;
    const bool clicked = icon_button(id, icon, theme, look);
    ImGui::SameLine(0, theme.px(3));
    return clicked;
  };
  if (button("restart", Icon::restart, "Restart from the beginning (R)", true, "")) actions.push_back(Restart{});
  if (button("first", Icon::to_start, "To the start (Home)", t.time_s > 0.0, "This is the start."))
    actions.push_back(ToStart{});
  if (button("back", Icon::step_back, "Back by one picture (Left)", t.can_step_back, "This is the start."))
    actions.push_back(StepBack{});
  const bool over = t.finished && t.time_s >= t.latest_s;
  if (button("play", t.playing ? Icon::pause : Icon::play, t.playing ? "Pause (Space)" : "Play (Space)",
             t.playing || !over, "The run is over: restart it, or go back in time.", true)) {
    if (t.playing)
      actions.push_back(Pause{});
    else
      actions.push_back(Play{});
  }
  if (button("forward", Icon::step_forward, "Forward by one picture, 20 ms (Right)", !over, "The run is over."))
    actions.push_back(StepForward{});
  if (button("last", Icon::to_end, "To the latest (End)", t.time_s < t.latest_s, "This is the latest."))
    actions.push_back(ToEnd{});
}

// `until`: where on the line something else begins; what was reached is left out where it would lie under that.
void speed_choice(const Transport& t, float until, const Theme& theme, Actions& actions) {
  static const double kSpeeds[] = {0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 50.0, 0.0};
  ImGui::SetNextItemWidth(theme.px(kSpeedChoice));
  const std::string now = t.speed == 0.0 ? "fastest" : times(t.speed);
  if (ImGui::BeginCombo("##speed", now.c_str())) {
    for (const double s : kSpeeds)
      if (ImGui::Selectable(s == 0.0 ? "as fast as possible" : times(s).c_str(), s == t.speed))
        actions.push_back(SetSpeed{s});
    close_on_escape();
    ImGui::EndCombo();
  }
  tooltip("Speed wanted, as a multiple of real time (+ and −)", theme);
  ImGui::SameLine();
  const std::string reached = t.playing                              ? "reached " + times(t.reached_speed)
                              : t.finished && t.time_s >= t.latest_s ? "finished"
                                                                     : "paused";
  if (ImGui::GetCursorPosX() + ImGui::CalcTextSize(reached.c_str()).x > until - theme.px(8)) return;
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", reached.c_str());
}

// The strip under the plot; a press or drag on it scrubs.
void timeline(const Transport& t, float left, float right, float height, const Theme& theme, Actions& actions) {
  const float y = ImGui::GetCursorScreenPos().y;
  const float reach = theme.px(7);
  ImGui::SetCursorScreenPos({left - reach, y});
  ImGui::BeginDisabled(!t.enabled);
  ImGui::InvisibleButton("timeline", {right - left + 2 * reach, height});
  ImGui::EndDisabled();
  if (ImGui::IsItemActive())
    actions.push_back(ScrubTo{std::min(t.latest_s, time_at(ImGui::GetIO().MousePos.x, left, right, t.total_s))});
  const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
  tooltip(t.enabled ? "Drag to look at any moment so far" : t.why_disabled, theme);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float middle = std::round(y + 0.5f * height), half = theme.px(2.5f);
  draw.AddRectFilled({left, middle - half}, {right, middle + half}, theme.pressed, half);
  draw.AddRectFilled({left, middle - half}, {x_of_time(t.latest_s, left, right, t.total_s), middle + half}, theme.muted,
                     half);
  for (const TimelineEvent& e : t.events) {
    const float x = x_of_time(e.time_s, left, right, t.total_s);
    draw.AddRectFilled({x - theme.px(1), middle - theme.px(5)}, {x + theme.px(1), middle + theme.px(5)}, e.colour);
  }
  const float x = x_of_time(t.time_s, left, right, t.total_s);
  draw.AddCircleFilled({x, middle}, theme.px(lit ? 7.5f : 6.5f), theme.ink);
  draw.AddCircle({x, middle}, theme.px(lit ? 7.5f : 6.5f), theme.panel, 0, theme.px(1.5f));
}

}  // namespace

Recording shown_curves(const Transport& t, const TransportState& state) {
  Recording shown;
  shown.name = t.quantity;
  const std::vector<TimeCurve>& curves = state.show_heading ? t.heading_curves : t.position_curves;
  if (curves.empty()) return shown;
  // All curves of one plot are of the same moments.
  const std::vector<double>& time_s = *curves.front().time_s;
  const auto is_shown = [&](double time) {
    return state.view.fitted || (time >= state.view.x0 && time <= state.view.x1);
  };
  for (double time : time_s)
    if (is_shown(time)) shown.time_s.push_back(time);
  for (const TimeCurve& curve : curves) {
    Channel channel;
    for (char c : curve.label) channel.name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    channel.name += state.show_heading ? "_rad" : "_m";
    for (std::size_t i = 0; i < std::min(time_s.size(), curve.value->size()); ++i)
      if (is_shown(time_s[i])) channel.values.push_back((*curve.value)[i]);
    channel.values.resize(shown.time_s.size(), std::numeric_limits<double>::quiet_NaN());
    shown.channels.push_back(std::move(channel));
  }
  return shown;
}

double time_at(float x, float left, float right, double total_s) {
  if (!(right > left)) return 0.0;
  return std::clamp(double(x - left) / double(right - left), 0.0, 1.0) * total_s;
}

float x_of_time(double time_s, float left, float right, double total_s) {
  if (!(total_s > 0.0)) return left;
  return left + float(std::clamp(time_s / total_s, 0.0, 1.0)) * (right - left);
}

Actions transport_bar(const Transport& t, TransportState& state, const Theme& theme) {
  Actions actions;
  transport_buttons(t, theme, actions);
  ImGui::SameLine(0, theme.px(14));
  const float speed_x = ImGui::GetCursorPosX();
  std::string time = clock(t.time_s);
  const std::string of_all = " / " + (t.total_is_planned ? "about " + clock(t.total_s) : clock(t.latest_s));
  const std::vector<std::string> kinds{"position", "heading"};
  float kinds_width = 0.0f;
  for (const std::string& k : kinds) kinds_width += ImGui::CalcTextSize(k.c_str()).x + theme.px(24);
  const float right_edge = ImGui::GetWindowSize().x - ImGui::GetStyle().WindowPadding.x;
  const float time_room = right_edge - kinds_width - theme.px(18) - speed_x - theme.px(kSpeedChoice + 16);
  if (ImGui::CalcTextSize((time + of_all).c_str()).x < time_room) time += of_all;
  const float time_x = right_edge - kinds_width - theme.px(18) - ImGui::CalcTextSize(time.c_str()).x;
  speed_choice(t, time_x, theme, actions);
  ImGui::SameLine(time_x);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(time.c_str());
  ImGui::SameLine(right_edge - kinds_width);
  if (const auto choice = segmented("kind", kinds, state.show_heading ? 1 : 0, theme)) {
    state.show_heading = *choice == 1;
    state.view.fitted = true;
  }

  Plot plot_of;
  plot_of.x = {"time", kSeconds};
  plot_of.x.unit.decimals = 2;
  plot_of.y = {t.quantity, state.show_heading ? Unit{"°", kDegrees.per_si, 2, 0.0} : Unit{"mm", 1e3, 1, 0.0}};
  plot_of.x_low = 0.0;
  plot_of.x_high = std::max(t.total_s, t.latest_s);
  plot_of.from_zero = !state.show_heading;
  plot_of.least_y_span = 0.001;
  plot_of.cursor_x = t.time_s;
  plot_of.empty_text = t.empty_text;
  for (const TimeCurve& c : state.show_heading ? t.heading_curves : t.position_curves) {
    PlotSeries s;
    s.label = c.label;
    s.x = c.time_s->data();
    s.y = c.value->data();
    s.count = std::min(c.time_s->size(), c.value->size());
    s.colour = c.colour;
    s.stroke = c.stroke;
    plot_of.series.push_back(s);
  }
  for (const TimelineEvent& e : t.events) plot_of.marks.push_back({e.time_s, e.words, e.colour});
  const float strip = theme.px(18);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const PlotResult result = plot("error over time", {room.x, std::max(theme.px(40), room.y - strip - theme.px(6))},
                                 plot_of, state.view, theme);
  if (result.clicked_x && t.enabled) actions.push_back(ScrubTo{std::clamp(*result.clicked_x, 0.0, t.latest_s)});
  timeline(t, result.low.x, result.high.x, strip, theme, actions);
  return actions;
}

}  // namespace odolab::ui
