#include "core/diagnosis/generic/at_rest.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include "core/diagnosis/generic/hats.h"
#include "core/diagnosis/model/wheels_at_rest.h"

namespace odolab {

namespace {

constexpr double kSinceRest_s[] = {0.0, 0.8, 2.5};
constexpr std::size_t kHatsAtRest = std::size(kSinceRest_s);

// For each step the time since both wheels came to rest, at its middle; below nothing where they do not. Between two
// counts of a slow wheel there is none to be read either, for less than that.
std::vector<double> since_rest_s(const DriveView& view) {
  constexpr double kShortest_s = 0.5, kLongAgo_s = 1e3;  // what was before the run is not known
  std::vector<double> since_s(view.steps.size(), -1.0);
  for (const Rest& rest : rests(view)) {
    if (rest.lasts_s() < kShortest_s) continue;
    const double came_s = rest.first == 0 ? rest.from_s - kLongAgo_s : rest.from_s;
    for (std::size_t i = rest.first; i < rest.end; ++i) since_s[i] = view.steps[i].time_s - came_s;
  }
  return since_s;
}

template <double BodyMotion::*moves>
std::vector<Motions> motions_at_rest(const DriveView& view, const std::vector<double>&) {
  const Hats hats({std::begin(kSinceRest_s), std::end(kSinceRest_s)});
  const std::vector<double> since_s = since_rest_s(view);
  std::vector<Motions> out(kHatsAtRest, Motions(view.steps.size()));
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    if (since_s[i] < 0.0) continue;
    const Hats::Shares s = hats.of(since_s[i]);
    out[s.first][i].*moves = s.of_first * view.steps[i].duration_s;
    out[s.first + 1][i].*moves = s.of_next * view.steps[i].duration_s;
  }
  return out;
}

}  // namespace

std::vector<GenericTest> at_rest_tests(const AskedModel& asked, double looked_at) {
  const std::vector<DriveView>& views = asked.joint.views();
  if (std::any_of(views.begin(), views.end(), std::mem_fn(&DriveView::from_commands))) return {};
  const char* const kVariable = "time since it came to rest [s]";
  std::vector<GenericTest> tests{
      asked_of(asked, kVariable, "yaw rate [rad/s]", kHatsAtRest, motions_at_rest<&BodyMotion::turn_rad>, looked_at),
      asked_of(asked, kVariable, "pace [m/s]", kHatsAtRest, motions_at_rest<&BodyMotion::forward_m>, looked_at)};
  for (GenericTest& t : tests) t.at.assign(std::begin(kSinceRest_s), std::end(kSinceRest_s));
  return tests;
}

}  // namespace odolab
