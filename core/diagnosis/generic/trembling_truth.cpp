#include "core/diagnosis/generic/trembling_truth.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"

namespace odolab {

TremblingTruth::TremblingTruth(const JointModel& joint) {
  double sum = 0.0, windows = 0.0;
  for (const InnovationRun& run : joint.runs()) {
    std::vector<Third>& of_run = thirds_.emplace_back();
    for (std::size_t i = 3; i < run.truth.size(); ++i) {
      const auto at = [&](std::size_t back) { return run.truth[i - back].position; };
      const Vec2 third = at(0) - 3.0 * at(1) + 3.0 * at(2) - at(3);
      of_run.push_back({0.5 * (run.truth[i].time_s + run.truth[i - 3].time_s), third});
    }
    for (double t = of_run.empty() ? 0.0 : of_run.front().time_s; !of_run.empty() && t < of_run.back().time_s;
         t += kAbout_s)
      if (const double variance = about(thirds_.size() - 1, t); variance > 0.0) sum += variance, ++windows;
  }
  if (windows > 0.0) usual_ = sum / windows;
}

double TremblingTruth::worse(int run, double time_s) const {
  return usual_ > 0.0 ? about(static_cast<std::size_t>(run), time_s) / usual_ : 1.0;
}

double TremblingTruth::about(std::size_t run, double time_s) const {
  const std::vector<Third>& all = thirds_[run];
  const auto earlier = [](const Third& t, double at_s) { return t.time_s < at_s; };
  std::vector<double> sizes;
  for (auto t = std::lower_bound(all.begin(), all.end(), time_s - kAbout_s, earlier);
       t != all.end() && t->time_s < time_s + kAbout_s; ++t)
    sizes.insert(sizes.end(), {t->value.x_m, t->value.y_m});
  return std::pow(scatter_about_zero(std::move(sizes)), 2);
}

}  // namespace odolab
