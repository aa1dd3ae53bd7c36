#include "core/diagnosis/generic/moving_frame.h"

#include "core/diagnosis/effects/floor.h"

namespace odolab {

namespace {

constexpr std::size_t kOfEach = 3;  // rad/s, and m/s along x and y

// What a frame that moves adds to the motion that the truth shows: its own, seen from the vehicle. It turns about the
// middle of the floor: about a point far away a turn is a shift, and nothing would be left of it beside that.
std::vector<Motions> motions_of_frame(const DriveView& view, std::size_t runs, const Vec2& middle) {
  std::vector<Motions> out(kOfEach * runs, Motions(view.steps.size()));
  const std::size_t first = kOfEach * static_cast<std::size_t>(view.number);
  if (first >= out.size()) return out;  // a run that was not fitted
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    const auto carried = [&](const Vec2& by_m, double turn_rad) {
      return BodyMotion{s.cos_heading * by_m.x_m + s.sin_heading * by_m.y_m,
                        s.cos_heading * by_m.y_m - s.sin_heading * by_m.x_m, turn_rad};
    };
    const Vec2 at = s.position - middle;
    out[first][i] = carried(s.duration_s * Vec2{-at.y_m, at.x_m}, s.duration_s);
    out[first + 1][i] = carried({s.duration_s, 0.0}, 0.0);
    out[first + 2][i] = carried({0.0, s.duration_s}, 0.0);
  }
  return out;
}

}  // namespace

std::vector<GenericTest> moving_frame_tests(const AskedModel& asked, double looked_at) {
  const std::size_t runs = asked.joint.views().size();
  const FloorSeen floor = floor_of(asked.joint.views());
  const Vec2 middle = 0.5 * (floor.low + floor.high);
  GenericTest t = asked_of(
      asked, "time", "turn and shift of the truth's frame", kOfEach * runs,
      [=](const DriveView& view, const std::vector<double>&) { return motions_of_frame(view, runs, middle); },
      looked_at);
  t.component = "truth";
  GenericCurve turns{"recording", "turn of the truth's frame [rad/s]", {}, {}};
  for (std::size_t run = 0; run < runs; ++run) {
    turns.at.push_back(static_cast<double>(run) + 1.0);
    turns.basis.emplace_back(kOfEach * runs, 0.0);
    turns.basis.back()[kOfEach * run] = 1.0;
  }
  if (runs > 1) t.curves = {turns};
  return {t};
}

}  // namespace odolab
