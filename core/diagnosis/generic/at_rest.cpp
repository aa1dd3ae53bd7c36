#include "core/diagnosis/generic/at_rest.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include "core/diagnosis/generic/hats.h"

namespace odolab {

namespace {

constexpr double kSince_s[] = {0.0, 0.8, 2.5};
constexpr std::size_t kHats = std::size(kSince_s);

bool stands(const EffectStep& s) { return s.left_read_rad == 0.0 && s.right_read_rad == 0.0; }

// For each step the time since both wheels came to rest, at its middle; below nothing where they do not. Between two
// counts of a slow wheel there is none to be read either, for less than that.
std::vector<double> since_rest_s(const std::vector<EffectStep>& steps) {
  constexpr double kShortest_s = 0.5, kLongAgo_s = 1e3;  // what was before the run is not known
  std::vector<double> since(steps.size(), -1.0);
  for (std::size_t first = 0; first < steps.size();) {
    std::size_t end = first;
    double rests_s = 0.0;
    for (; end < steps.size() && stands(steps[end]); ++end) rests_s += steps[end].duration_s;
    double at_s = first == 0 ? kLongAgo_s : 0.0;
    for (std::size_t i = first; i < end && rests_s >= kShortest_s; ++i) {
      since[i] = at_s + 0.5 * steps[i].duration_s;
      at_s += steps[i].duration_s;
    }
    first = std::max(end, first + 1);
  }
  return since;
}

template <double BodyMotion::*moves>
std::vector<Motions> motions_of(const DriveView& view, const std::vector<double>&) {
  const Hats hats({std::begin(kSince_s), std::end(kSince_s)});
  const std::vector<double> since_s = since_rest_s(view.steps);
  std::vector<Motions> out(kHats, Motions(view.steps.size()));
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
      asked_of(asked, kVariable, "yaw rate [rad/s]", kHats, motions_of<&BodyMotion::turn_rad>, looked_at),
      asked_of(asked, kVariable, "pace [m/s]", kHats, motions_of<&BodyMotion::forward_m>, looked_at)};
  for (GenericTest& t : tests) t.at.assign(std::begin(kSince_s), std::end(kSince_s));
  return tests;
}

}  // namespace odolab
