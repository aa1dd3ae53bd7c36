#include "core/diagnosis/units/drawn_joints.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace odolab {

namespace {

// Where a joint's reading changes: half way between two samples, in angle and by the way driven.
struct Edge {
  std::size_t behind;  // the first sample that reads otherwise
  double way, at;
  double by;           // so much more it reads behind it
  double slope = 0.0;  // by the way
};

// The step of what a joint reads, as its changes show it: whole multiples of it, nearly all. 0 where they are not.
double step_of(const std::vector<UnitSample>& samples, std::size_t joint) {
  constexpr double kNear = 0.15, kNearlyAll = 0.95;
  std::vector<double> changes;
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (const double by = std::abs(samples[i].joints[joint] - samples[i - 1].joints[joint]); by > 0.0)
      changes.push_back(by);
  if (changes.empty()) return 0.0;
  std::sort(changes.begin(), changes.end());
  double step = changes.front(), products = 0.0, squares = 0.0, near = 0.0;
  for (const double by : changes) {  // the smallest first: what is printed is rounded once more
    const double n = std::round(by / step);
    near += std::abs(by / step - n) < kNear;
    products += n * by;
    squares += n * n;
    step = products / squares;
  }
  return near < kNearlyAll * static_cast<double>(changes.size()) ? 0.0 : step;
}

std::vector<double> ways_of(const std::vector<UnitSample>& samples) {
  std::vector<double> way(samples.size(), 0.0);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    way[i] = way[i - 1];
    for (std::size_t u = 0; u < samples[i].wheels.size(); ++u)
      way[i] += std::abs(samples[i].wheels[u].left_rad - samples[i - 1].wheels[u].left_rad) +
                std::abs(samples[i].wheels[u].right_rad - samples[i - 1].wheels[u].right_rad);
  }
  return way;
}

std::vector<Edge> edges_of(const std::vector<UnitSample>& samples, const std::vector<double>& way, std::size_t joint,
                           double step) {
  std::vector<Edge> edges;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double a = samples[i - 1].joints[joint], b = samples[i].joints[joint];
    if (std::abs(b - a) > 0.5 * step && way[i] > way[i - 1])
      edges.push_back({i, 0.5 * (way[i - 1] + way[i]), 0.5 * (a + b), b - a});
  }
  return edges;
}

// Whether it comes back within two readings more often than one that moves smoothly would: what it reads errs at random
// as well, and no edge tells where it is.
bool flickers(const std::vector<Edge>& edges) {
  constexpr std::size_t kSoon = 2;
  constexpr double kOften = 0.1;  // of all edges
  double back = 0.0;
  for (std::size_t e = 1; e < edges.size(); ++e)
    back += edges[e].behind - edges[e - 1].behind <= kSoon && edges[e - 1].by * edges[e].by < 0.0;
  return back > kOften * static_cast<double>(edges.size());
}

// That of the parabola through an edge and its neighbours, no steeper than three times the pace to either where the
// joint goes on (Fritsch and Carlson 1980: a cubic between them then goes on, too).
void give_slopes(std::vector<Edge>& edges, double step) {
  for (std::size_t e = 1; e + 1 < edges.size(); ++e) {
    const Edge &a = edges[e - 1], &b = edges[e + 1];
    Edge& here = edges[e];
    const double w0 = here.way - a.way, w1 = b.way - here.way, p0 = (here.at - a.at) / w0, p1 = (b.at - here.at) / w1;
    here.slope = (p0 * w1 + p1 * w0) / (w0 + w1);
    for (const auto& [pace, w] : {std::pair(p0, w0), std::pair(p1, w1)})
      if (std::abs(pace * w) > 0.5 * step)
        here.slope = std::copysign(std::min(std::abs(here.slope), 3.0 * std::abs(pace)), here.slope);
  }
}

// The cubic from one edge to the next, at u of the way.
double cubic_at(double u, const Edge& a, const Edge& b, double step) {
  const double on = b.way - a.way, v = 1.0 - u, by = b.at - a.at;
  double s0 = on * a.slope, s1 = on * b.slope;
  // Where it would turn back deeper than the step is it did not swing but was held, anywhere in it.
  const double deep = 0.125 * std::abs(s0 - s1);
  const bool was_held = std::abs(by) < 0.5 * step && deep > step;
  if (was_held) s0 *= 0.5 * step / deep, s1 *= 0.5 * step / deep;
  return a.at + by * u * u * (3.0 - 2.0 * u) + u * v * (v * s0 - u * s1);
}

void draw_joint(std::vector<UnitSample>& samples, const std::vector<double>& way, std::size_t joint, double step) {
  std::vector<Edge> edges = edges_of(samples, way, joint, step);
  if (edges.size() < 3 || flickers(edges)) return;
  give_slopes(edges, step);
  const double half = 0.5 * step;
  const auto put = [&](std::size_t i, double drawn) {
    double& reads = samples[i].joints[joint];
    reads = std::clamp(drawn, reads - half, reads + half);
  };
  for (std::size_t e = 1; e < edges.size(); ++e) {
    const Edge &a = edges[e - 1], &b = edges[e];
    if (b.behind - a.behind < 2) continue;
    for (std::size_t i = a.behind; i < b.behind; ++i) put(i, cubic_at((way[i] - a.way) / (b.way - a.way), a, b, step));
  }
}

}  // namespace

std::vector<UnitSample> with_joints_drawn(std::vector<UnitSample> samples) {
  if (samples.empty()) return samples;
  const std::vector<double> way = ways_of(samples);
  for (std::size_t joint = 0; joint < samples.front().joints.size(); ++joint)
    if (const double step = step_of(samples, joint); step > 0.0) draw_joint(samples, way, joint, step);
  return samples;
}

}  // namespace odolab
