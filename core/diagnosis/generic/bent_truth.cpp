#include "core/diagnosis/generic/bent_truth.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/diagnosis/effects/floor.h"

namespace odolab {

namespace {

// Gradient of a field of displacements: of its x by x and y, of its y by x and y.
struct Gradient {
  double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;
};

// Two that are linear (one axis longer than the other; a skew), then u^i v^j along x and along y, i + j = 2 and 3.
constexpr std::size_t kFields = 16;

void gradients_at(const Vec2& at, const FloorSquare& floor, Gradient* out) {
  const auto [u, v] = floor.at(at);
  out[0] = {1.0, 0.0, 0.0, -1.0};
  out[1] = {0.0, 1.0, 1.0, 0.0};
  std::size_t k = 2;
  for (int degree = 2; degree <= 3; ++degree)
    for (int i = degree; i >= 0; --i) {
      const int j = degree - i;
      const double by_u = i > 0 ? i * std::pow(u, i - 1) * std::pow(v, j) : 0.0;
      const double by_v = j > 0 ? j * std::pow(u, i) * std::pow(v, j - 1) : 0.0;
      out[k++] = {by_u, by_v, 0.0, 0.0};
      out[k++] = {0.0, 0.0, by_u, by_v};
    }
}

std::vector<Motions> motions_of_bends(const DriveView& view, const FloorSquare& floor, bool headings_too) {
  std::vector<Motions> out(kFields, Motions(view.steps.size()));
  Gradient of[kFields];
  double turned[kFields] = {}, before[kFields] = {};
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    gradients_at(s.position, floor, of);
    const double c = s.cos_heading, sn = s.sin_heading, way = s.forward_m();
    for (std::size_t k = 0; k < kFields; ++k) {
      const double dx = of[k].xx * c + of[k].xy * sn, dy = of[k].yx * c + of[k].yy * sn;
      turned[k] = -sn * dx + c * dy;  // of an arrow along the heading
      const double turn = headings_too && i > 0 ? turned[k] - before[k] : 0.0;
      // A heading that is bent alike shows where the bent way leads: nothing goes aside of it.
      out[k][i] = {way * (c * dx + sn * dy), headings_too ? 0.0 : way * turned[k], turn};
      before[k] = turned[k];
    }
  }
  return out;
}

// How far off the truth is along the middle of the floor, from one end to the other.
GenericCurve bend_along(bool x, const FloorSquare& floor) {
  constexpr int kPoints = 25;
  GenericCurve curve;
  curve.variable = x ? "x, across the middle of the floor [m]" : "y, across the middle of the floor [m]";
  curve.channel = x ? "truth off along x [m]" : "truth off along y [m]";
  for (int i = 0; i < kPoints; ++i) {
    const double u = 2.0 * i / (kPoints - 1) - 1.0;
    curve.at.push_back((x ? floor.middle.x_m : floor.middle.y_m) + u * floor.half_m);
    std::vector<double> by(kFields, 0.0);
    by[0] = (x ? 1.0 : -1.0) * u * floor.half_m;
    // of degrees 2 and 3, along x with u alone; along y with v alone
    by[x ? 2 : 7] = u * u * floor.half_m;
    by[x ? 8 : 15] = u * u * u * floor.half_m;
    curve.basis.push_back(std::move(by));
  }
  return curve;
}

}  // namespace

std::vector<GenericTest> bent_truth_tests(const AskedModel& asked, double looked_at) {
  const FloorSquare floor = square_around(floor_of(asked.joint.views()));
  if (floor.half_m < 1e-3) return {};
  std::vector<GenericTest> tests(kBentTruthTests);
  parallel_for(kBentTruthTests, [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    const bool headings_too = i == 1;
    t = asked_of(
        asked, "place on the floor", headings_too ? "truth's position and heading" : "truth's position", kFields,
        [floor, headings_too](const DriveView& view, const std::vector<double>&) {
          return motions_of_bends(view, floor, headings_too);
        },
        looked_at);
    t.curves = {bend_along(true, floor), bend_along(false, floor)};
  });
  return tests;
}

}  // namespace odolab
