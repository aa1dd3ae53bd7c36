#include "core/diagnosis/generic/on_the_spot.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

constexpr std::size_t kTermsOnTheSpot = 2;  // to either side alike, and by the side

// Of what both wheels turn, what they turn against each other.
double share_against(const EffectStep& s) {
  const double of_both_m = std::abs(s.left_m) + std::abs(s.right_m);
  return of_both_m > 0.0 ? 1.0 - std::abs(s.left_m + s.right_m) / of_both_m : 0.0;
}

std::vector<Motions> motions_on_the_spot(const DriveView& view) {
  std::vector<Motions> out(kTermsOnTheSpot, Motions(view.steps.size()));
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    const double turned_rad = share_against(s) * s.turn_rad;
    out[0][i] = {std::abs(turned_rad), 0.0, 0.0};
    out[1][i] = {turned_rad, 0.0, 0.0};
  }
  return out;
}

}  // namespace

std::vector<GenericTest> on_the_spot_tests(const AskedModel& asked, double looked_at) {
  return {asked_of(
      asked, "turning on the spot", "forward per radian [m/rad]", kTermsOnTheSpot,
      [](const DriveView& view, const std::vector<double>&) { return motions_on_the_spot(view); }, looked_at)};
}

}  // namespace odolab
