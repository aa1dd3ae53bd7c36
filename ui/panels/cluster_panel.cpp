#include "ui/panels/cluster_panel.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "ui/look/strokes.h"
#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

constexpr double kLeastEnlargement = 1.5;  // that is worth covering a corner for

// Coordinates of a cloud, kept while the plot is drawn.
struct Cloud {
  std::vector<double> x, y;
};

Cloud cloud_of(const std::vector<ReturnError>& errors) {
  Cloud cloud;
  for (const ReturnError& e : errors) {
    cloud.x.push_back(e.x_m);
    cloud.y.push_back(e.y_m);
  }
  return cloud;
}

class Clouds {
 public:
  void add(Plot& plot, Cloud cloud, std::string label, ImU32 colour, Marker marker, Stroke stroke = Stroke::none,
           bool fits = true) {
    kept_.push_back(std::move(cloud));
    PlotSeries s;
    s.label = std::move(label);
    s.x = kept_.back().x.data();
    s.y = kept_.back().y.data();
    s.count = kept_.back().x.size();
    s.colour = colour;
    s.marker = marker;
    s.stroke = stroke;
    s.width = 1.2f;
    s.fits = fits;
    plot.series.push_back(s);
  }

 private:
  std::deque<Cloud> kept_;  // its elements stay where they are
};

void add_experiment(Plot& plot, Clouds& clouds, const BenchExperiment& e, bool is_last, const char* when,
                    const Theme& theme) {
  const float strength = is_last ? 1.0f : 0.6f;
  const ImU32 cw = faded(theme.orange, strength), ccw = faded(theme.blue, strength);
  if (e.measure) {
    for (const auto& [cluster, colour] :
         {std::pair<const Cluster&, ImU32>{e.measure->clockwise, cw}, {e.measure->counter_clockwise, ccw}})
      clouds.add(plot, {{0.0, cluster.centre_of_gravity.x_m}, {0.0, cluster.centre_of_gravity.y_m}}, "", colour,
                 Marker::none, Stroke::dashed);
  }
  clouds.add(plot, cloud_of(e.runs.clockwise), when ? std::string("cw") + when : "", cw,
             is_last ? Marker::disc : Marker::ring);
  clouds.add(plot, cloud_of(e.runs.counter_clockwise), when ? std::string("ccw") + when : "", ccw,
             is_last ? Marker::square : Marker::box);
  if (e.measure)
    for (const Cluster* cluster : {&e.measure->clockwise, &e.measure->counter_clockwise})
      clouds.add(plot, {{cluster->centre_of_gravity.x_m}, {cluster->centre_of_gravity.y_m}}, "", theme.ink,
                 Marker::cross);
}

struct Box {
  float x0, y0, x1, y1;

  bool contains(ImVec2 p, float near) const {
    return p.x > x0 - near && p.x < x1 + near && p.y > y0 - near && p.y < y1 + near;
  }
  bool meets(const Box& b) const { return x0 < b.x1 && x1 > b.x0 && y0 < b.y1 && y1 > b.y0; }
};

// Words near a cluster's centre of gravity, at the place around it that hides the fewest points and no other words.
void centre_label(ImVec2 at, const std::string& words, const std::vector<ImVec2>& points, std::vector<Box>& taken,
                  const PlotResult& result, const Theme& theme) {
  if (at.x < result.low.x || at.x > result.high.x || at.y < result.low.y || at.y > result.high.y) return;
  const ImVec2 size = ImGui::CalcTextSize(words.c_str());
  const float pad = theme.px(4);
  Box best{};
  int least = 1 << 30;
  for (const float reach : {20.0f, 36.0f, 56.0f})
    for (int k = 0; k < 8; ++k) {
      const float angle = 0.785398f * float(k), dx = std::cos(angle), dy = std::sin(angle);
      const float away_x = theme.px(reach) + (std::abs(dx) > 0.5f ? 0.5f * size.x : 0.0f);
      const ImVec2 middle{at.x + dx * away_x, at.y + dy * (theme.px(reach) + 0.5f * size.y)};
      const Box box{middle.x - 0.5f * size.x - pad, middle.y - 0.5f * size.y - 0.5f * pad,
                    middle.x + 0.5f * size.x + pad, middle.y + 0.5f * size.y + 0.5f * pad};
      if (box.x0 < result.low.x || box.x1 > result.high.x || box.y0 < result.low.y || box.y1 > result.high.y) continue;
      int cost = 0;
      for (const ImVec2 p : points) cost += box.contains(p, theme.px(5)) ? 10 : 0;
      for (const Box& other : taken) cost += box.meets(other) ? 1000 : 0;
      if (cost < least) {
        least = cost;
        best = box;
      }
    }
  if (least == 1 << 30) return;
  taken.push_back(best);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled({best.x0, best.y0}, {best.x1, best.y1}, faded(theme.paper, 0.88f), theme.px(3));
  draw.AddText({std::round(best.x0 + pad), std::round(best.y0 + 0.5f * pad)}, theme.ink, words.c_str());
}

void labels_of(const BenchExperiment& e, const PlotResult& result, const PlotView& view, const Theme& theme) {
  if (!e.measure) return;
  const Unit mm{"mm", 1e3, 1, 0.0};
  std::vector<ImVec2> points;
  for (const auto* errors : {&e.runs.clockwise, &e.runs.counter_clockwise})
    for (const ReturnError& r : *errors) points.push_back(result.screen_at(r.x_m, r.y_m, view));
  std::vector<Box> taken;
  const auto label = [&](const Cluster& cluster, const char* way) {
    centre_label(result.screen_at(cluster.centre_of_gravity.x_m, cluster.centre_of_gravity.y_m, view),
                 way + shown(cluster.distance_m, mm), points, taken, result, theme);
  };
  if (!e.runs.clockwise.empty()) label(e.measure->clockwise, "cw ");
  if (!e.runs.counter_clockwise.empty()) label(e.measure->counter_clockwise, "ccw ");
}

Plot plot_of_errors() {
  Plot p;
  const Unit mm{"mm", 1e3, 1, 0.0};
  p.x = {"x", mm};
  p.y = {"y", mm};
  p.equal_scale = true;
  return p;
}

// The corner of the plot in which the fewest points lie.
ImVec2 emptiest_corner(const std::vector<BenchExperiment>& experiments, const PlotResult& result, const PlotView& view,
                       ImVec2 size, const Theme& theme) {
  const float margin = theme.px(10);
  ImVec2 best{};
  int fewest = 1 << 30;  // points weigh more than lines
  for (const bool right : {true, false})
    for (const bool below : {true, false}) {
      const ImVec2 low{right ? result.high.x - margin - size.x : result.low.x + margin,
                       below ? result.high.y - margin - size.y : result.low.y + margin};
      int inside = 0;
      for (const BenchExperiment& e : experiments)
        for (const auto* errors : {&e.runs.clockwise, &e.runs.counter_clockwise})
          for (const ReturnError& r : *errors) {
            const ImVec2 at = result.screen_at(r.x_m, r.y_m, view);
            const float near = theme.px(24);
            if (at.x > low.x - near && at.x < low.x + size.x + near && at.y > low.y - near &&
                at.y < low.y + size.y + near)
              inside += 10;
          }
      for (const BenchExperiment& e : experiments) {
        if (!e.measure) continue;
        for (const Cluster* c : {&e.measure->clockwise, &e.measure->counter_clockwise})
          for (int k = 0; k <= 10; ++k) {  // the lines from the origin to the centres
            const ImVec2 at =
                result.screen_at(0.1 * k * c->centre_of_gravity.x_m, 0.1 * k * c->centre_of_gravity.y_m, view);
            if (at.x > low.x && at.x < low.x + size.x && at.y > low.y && at.y < low.y + size.y) ++inside;
          }
      }
      if (inside < fewest) {
        fewest = inside;
        best = low;
      }
    }
  return best;
}

}  // namespace

void cluster_panel(const Bench& bench, ClusterState& state, const Theme& theme) {
  const std::vector<BenchExperiment>& experiments = *bench.experiments;
  ImGui::SetCursorPos({theme.px(14), theme.px(10)});
  {
    WithFont strong(theme.strong);
    ImGui::TextUnformatted("Return position errors");
  }
  const char* what = "true minus calculated, after each square";
  ImGui::SameLine();
  if (ImGui::CalcTextSize(what).x > ImGui::GetContentRegionAvail().x) {
    ImGui::NewLine();
    ImGui::SetCursorPosX(theme.px(14));
  }
  note(what, theme);
  ImGui::SetCursorPosX(theme.px(10));
  Plot p = plot_of_errors();
  Clouds clouds;
  std::size_t points = 0;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const bool last = i + 1 == experiments.size();
    const char* when = experiments.size() < 2 ? "" : last ? ", after" : i == 0 ? ", before" : nullptr;
    add_experiment(p, clouds, experiments[i], last, when, theme);
    points += experiments[i].runs.clockwise.size() + experiments[i].runs.counter_clockwise.size();
  }
  if (points < state.points_seen || points == 0) state.view.fitted = state.enlarged.fitted = true;
  state.points_seen = points;
  if (points == 0)
    p.empty_text = bench.running ? "The first square is being driven…" : "Each square driven becomes a point here.";
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const PlotResult result = plot("clusters", {room.x - theme.px(10), room.y - theme.px(8)}, p, state.view, theme);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (experiments.empty() || points == 0) return;
  const BenchExperiment& last = experiments.back();
  const bool two = experiments.size() > 1 && !last.runs.clockwise.empty();
  // The calibrated runs lie close about the origin: a second, enlarged plot in the emptiest corner.
  const float side = std::round(0.44f * std::min(result.high.x - result.low.x, result.high.y - result.low.y));
  const ImVec2 size{side * 1.15f, side};
  Plot q = plot_of_errors();
  q.legend = false;
  Clouds near;
  add_experiment(q, near, last, true, nullptr, theme);
  const ImVec2 area = drawing_area(q, {size.x - theme.px(8), size.y - theme.px(10)}, theme);
  const PlotView whole = view_of_all(q, area);
  const double outer_per_px = (state.view.x1 - state.view.x0) / (result.high.x - result.low.x);
  const bool enlarges = outer_per_px / ((whole.x1 - whole.x0) / area.x) > kLeastEnlargement;
  const bool readable = side >= theme.px(110);
  if (two && readable && !enlarges && state.enlarged.fitted) {  // the last clouds are seen where they are
    labels_of(last, result, state.view, theme);
    return;
  }
  labels_of(experiments.front(), result, state.view, theme);
  if (!two || !readable) return;
  const ImVec2 low = emptiest_corner(experiments, result, state.view, size, theme);
  const ImVec2 high{low.x + size.x, low.y + size.y};
  draw.AddRectFilled({low.x + theme.px(2), low.y + theme.px(3)}, {high.x + theme.px(2), high.y + theme.px(4)},
                     IM_COL32(0, 0, 0, 28), theme.px(5));
  draw.AddRectFilled(low, high, theme.panel, theme.px(4));
  draw.AddRect(low, high, theme.ink, theme.px(4), 0, theme.px(1.2f));
  ImGui::SetCursorScreenPos({low.x + theme.px(2), low.y + theme.px(4)});
  const PlotResult inner = plot("enlarged", {size.x - theme.px(8), size.y - theme.px(10)}, q, state.enlarged, theme);
  const double enlargement = (inner.high.x - inner.low.x) / (state.enlarged.x1 - state.enlarged.x0) /
                             ((result.high.x - result.low.x) / (state.view.x1 - state.view.x0));
  const float title_room = inner.high.x - inner.low.x;
  std::string title = last.name + ", enlarged " + times(enlargement);
  if (ImGui::CalcTextSize(title.c_str()).x > title_room) title = "enlarged " + times(enlargement);
  if (ImGui::CalcTextSize(title.c_str()).x > title_room) title = times(enlargement);
  draw.AddText({inner.high.x - ImGui::CalcTextSize(title.c_str()).x, low.y + theme.px(4)}, theme.ink, title.c_str());
  labels_of(last, inner, state.enlarged, theme);
}

}  // namespace odolab::ui
