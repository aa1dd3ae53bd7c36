#include "core/diagnosis/generic/waves_on_floor.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/base/parallel.h"
#include "core/diagnosis/effects/floor.h"

namespace odolab {

namespace {

constexpr double kBin_m = 0.1;
constexpr double kShortestLength_m = 0.6;
constexpr std::size_t kMostWaves = 4000;

constexpr Modulated kOnTheFloor[] = {
    {0, 0}, {1, 1}, {2, 2}, {across_m, kAcross}, {across_m + 1, kAcross}, {of_wheel, kUnderWheels}};

// A stretch of a run so short that no wave of the floor turns far within it.
struct Bin {
  Vec2 at;  // in the middle
  double score[kSlots] = {};
};

// `way_m` and `place` are of what goes there, `add` puts the score of one step into a bin.
template <typename Way, typename Place, typename Add>
std::vector<Bin> bins_along(const DriveView& view, const Way& way_m, const Place& place, const Add& add) {
  std::vector<Bin> bins;
  double gone_m = 0.0, steps = 0.0;
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    if (bins.empty() || gone_m > kBin_m) {
      bins.emplace_back();
      gone_m = steps = 0.0;
    }
    Bin& bin = bins.back();
    gone_m += std::abs(way_m(s));
    steps += 1.0;
    bin.at = bin.at + (1.0 / steps) * (place(s) - bin.at);
    add(bin, s, i);
  }
  return bins;
}

std::vector<Bin> bins_of(const DriveView& view, const std::vector<BodyMotion>& score) {
  return bins_along(
      view, [](const EffectStep& s) { return s.forward_m(); }, [](const EffectStep& s) { return s.position; },
      [&](Bin& bin, const EffectStep& s, std::size_t i) { add_scores(view, s, score[i], Along::floor, bin.score); });
}

std::vector<Bin> bins_of_wheel(const DriveView& view, const std::vector<BodyMotion>& score, Wheel wheel) {
  const double b = view.drive.wheelbase_m;
  return bins_along(
      view, [&](const EffectStep& s) { return way_of(s, wheel); },
      [&](const EffectStep& s) { return place_of_wheel(s, b, wheel); },
      [&](Bin& bin, const EffectStep& s, std::size_t i) {
        bin.score[of_wheel] += product(by_wheel(wheel, way_of(s, wheel), b), score[i]);
      });
}

// Wave vectors stand on a grid, so that the angle of each is one of x plus one of y, and all scores of a slot are the
// product of two matrices.
struct Grid {
  double dx = 0.0, dy = 0.0, most = 0.0;  // turns per metre: apart, and the shortest wave's
  Eigen::Index nx = 0, ny = 0;
};

Grid grid_of(const FloorSeen& floor) {
  Grid g;
  g.dx = kTurnsApart / std::max(floor.width_m(), 0.5), g.dy = kTurnsApart / std::max(floor.height_m(), 0.5);
  g.most = std::min(1.0 / kShortestLength_m,  // half a disc of so many at most
                    std::sqrt(2.0 * static_cast<double>(kMostWaves) * g.dx * g.dy / kPi));
  g.nx = static_cast<Eigen::Index>(g.most / g.dx) + 1, g.ny = static_cast<Eigen::Index>(g.most / g.dy) + 1;
  return g;
}

// Cosines, then sines, of the angles at which the waves of one direction stand in each bin.
Eigen::MatrixXd angles_at(const Eigen::VectorXd& at_m, double apart_per_m, Eigen::Index waves) {
  Eigen::MatrixXd of(at_m.size(), 2 * waves);
  for (Eigen::Index b = 0; b < at_m.size(); ++b)
    for (Eigen::Index k = 0; k < waves; ++k) {
      const double angle = 2.0 * kPi * apart_per_m * static_cast<double>(k) * at_m(b);
      of(b, k) = std::cos(angle), of(b, waves + k) = std::sin(angle);
    }
  return of;
}

struct Turned {
  std::vector<Bin> bins;
  Eigen::MatrixXd of_x, of_y;
};

Turned turned_on(const Grid& grid, const FloorSeen& floor, const std::vector<std::vector<Bin>>& bins) {
  Turned t;
  for (const std::vector<Bin>& of_run : bins) t.bins.insert(t.bins.end(), of_run.begin(), of_run.end());
  const auto n = static_cast<Eigen::Index>(t.bins.size());
  Eigen::VectorXd x(n), y(n);
  for (Eigen::Index b = 0; b < n; ++b) {
    const Vec2 at = t.bins[static_cast<std::size_t>(b)].at - floor.low;
    x(b) = at.x_m, y(b) = at.y_m;
  }
  t.of_x = angles_at(x, grid.dx, grid.nx), t.of_y = angles_at(y, grid.dy, grid.ny);
  return t;
}

}  // namespace

std::vector<Heard> heard_on_floor(const std::vector<DriveView>& views,
                                  const std::vector<std::vector<BodyMotion>>& scores) {
  const std::size_t runs = views.size();
  std::vector<std::vector<Bin>> of_vehicle(runs), of_wheels(2 * runs);
  parallel_for(static_cast<int>(runs), [&](int run) {
    const auto r = static_cast<std::size_t>(run);
    of_vehicle[r] = bins_of(views[r], scores[r]);
    of_wheels[2 * r] = bins_of_wheel(views[r], scores[r], Wheel::left);
    of_wheels[2 * r + 1] = bins_of_wheel(views[r], scores[r], Wheel::right);
  });
  const FloorSeen floor = floor_of(views);
  const Grid grid = grid_of(floor);
  const Turned vehicle = turned_on(grid, floor, of_vehicle), wheels = turned_on(grid, floor, of_wheels);
  constexpr std::size_t kMany = std::size(kOnTheFloor);
  std::array<Eigen::MatrixXd, kMany> sums;
  parallel_for(static_cast<int>(kMany), [&](int m) {
    const int slot = kOnTheFloor[m].slot;
    const Turned& of = slot == of_wheel ? wheels : vehicle;
    Eigen::VectorXd score(static_cast<Eigen::Index>(of.bins.size()));
    for (Eigen::Index b = 0; b < score.size(); ++b) score(b) = of.bins[static_cast<std::size_t>(b)].score[slot];
    sums[static_cast<std::size_t>(m)].noalias() = (score.asDiagonal() * of.of_x).transpose() * of.of_y;
  });
  std::vector<Heard> heard;
  for (Eigen::Index i = 0; i < grid.nx; ++i)
    for (Eigen::Index j = 0; j < grid.ny; ++j)
      for (const double side : {1.0, -1.0}) {
        if ((i == 0 || j == 0) && side < 0.0) continue;  // the same again
        Wave w;
        w.per_m = {static_cast<double>(i) * grid.dx, side * static_cast<double>(j) * grid.dy};
        const double k = length(w.per_m);
        if (k == 0.0 || k > grid.most) continue;
        w.band = std::min(kWaveBands - 1, static_cast<int>(kWaveBands * k / grid.most));
        Heard h{w, {}};
        for (std::size_t m = 0; m < kMany; ++m) {
          const Eigen::MatrixXd& of = sums[m];
          const double c = of(i, j) - side * of(grid.nx + i, grid.ny + j),
                       s = of(grid.nx + i, j) + side * of(i, grid.ny + j);
          h.power[static_cast<std::size_t>(kOnTheFloor[m].channel)] += c * c + s * s;
        }
        heard.push_back(h);
      }
  return heard;
}

}  // namespace odolab
