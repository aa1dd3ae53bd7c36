#include "core/diagnosis/generic/uneven_floor.h"

#include "core/diagnosis/effects/floor.h"

namespace odolab {

namespace {

constexpr std::size_t kOfEachAxis = 3;  // everywhere alike, and growing along x and along y
constexpr std::size_t kTermsOfFloor = 2 * kOfEachAxis;

std::vector<Motions> motions_of_floor(const DriveView& view, const FloorSquare& floor) {
  std::vector<Motions> out(kTermsOfFloor, Motions(view.steps.size()));
  const std::vector<char> turns = view.turning();
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    if (!turns[i]) continue;
    const Vec2 at = floor.at(s.position);
    const double by[kOfEachAxis] = {s.duration_s, s.duration_s * at.x_m, s.duration_s * at.y_m};
    for (std::size_t k = 0; k < kOfEachAxis; ++k) {
      out[k][i] = {s.cos_heading * by[k], -s.sin_heading * by[k], 0.0};
      out[kOfEachAxis + k][i] = {s.sin_heading * by[k], s.cos_heading * by[k], 0.0};
    }
  }
  return out;
}

// Along one axis, through the middle of the floor.
GenericCurve creep_along(bool x, const FloorSquare& floor) {
  GenericCurve curve;
  curve.variable = x ? "x, across the middle of the floor [m]" : "y, across the middle of the floor [m]";
  curve.channel = x ? "creep along x [m/s]" : "creep along y [m/s]";
  const double middle_m = x ? floor.middle.x_m : floor.middle.y_m;
  for (const double u : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    curve.at.push_back(middle_m + u * floor.half_m);
    std::vector<double> by(kTermsOfFloor, 0.0);
    const std::size_t first = x ? 0 : kOfEachAxis;
    by[first] = 1.0;
    by[first + (x ? 1 : 2)] = u;
    curve.basis.push_back(std::move(by));
  }
  return curve;
}

}  // namespace

std::vector<GenericTest> uneven_floor_tests(const AskedModel& asked, double looked_at) {
  const FloorSquare floor = square_around(floor_of(asked.joint.views()));
  if (floor.half_m < 1e-3) return {};
  GenericTest t = asked_of(
      asked, "place on the floor", "creep across the floor", kTermsOfFloor,
      [floor](const DriveView& view, const std::vector<double>&) { return motions_of_floor(view, floor); }, looked_at);
  t.component = "floor";
  t.of_when_or_where = true;
  t.curves = {creep_along(true, floor), creep_along(false, floor)};
  return {t};
}

}  // namespace odolab
