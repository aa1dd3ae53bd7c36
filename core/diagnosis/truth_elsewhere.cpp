#include "core/diagnosis/truth_elsewhere.h"

#include <algorithm>
#include <cmath>

namespace odolab {

TimeStretches truth_elsewhere(const InnovationRun& run, const InnovationModel& model) {
  constexpr double kMost_s = 2.0;
  constexpr double kBackOnItsWay = 0.25, kOfTheJump = 0.05;  // of the gate, and of the least that was refused
  TimeStretches found;
  if (run.truth.size() < 2) return found;
  const double period_s =
      (run.truth.back().time_s - run.truth.front().time_s) / static_cast<double>(run.truth.size() - 1);
  const int most = static_cast<int>(kMost_s / std::max(period_s, 1e-6));
  if (most <= kContradiction) return found;
  FilterOptions options;
  options.derivatives = false;
  options.gate = kGate;
  options.contradiction = most;
  std::vector<double> squared(run.truth.size(), kGate);
  options.on_innovation = [&](const Innovation& i) { squared[static_cast<std::size_t>(i.truth_index)] = i.squared; };
  const std::vector<char> aside = filtered(run, summed_up(run, model), model, options).set_aside;
  for (std::size_t i = 0; i < aside.size();) {
    std::size_t j = i;
    double jump = 1e300;
    bool begins_anew = false;
    for (; j < aside.size() && aside[j]; ++j) {
      jump = std::min(jump, squared[j]);
      begins_anew = begins_anew || aside[j] != 1;
    }
    const bool is_long = j - i >= static_cast<std::size_t>(kContradiction);
    if (is_long && j < aside.size() && !begins_anew && squared[j] < std::max(kBackOnItsWay * kGate, kOfTheJump * jump))
      found.emplace_back(run.truth[i].time_s, run.truth[j - 1].time_s);
    i = std::max(j, i + 1);
  }
  return found;
}

}  // namespace odolab
