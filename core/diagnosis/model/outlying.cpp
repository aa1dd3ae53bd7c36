#include "core/diagnosis/model/outlying.h"

#include <algorithm>

namespace odolab {

std::vector<Refused> refused_in_a_row(const InnovationRun& run, const InnovationModel& model, int contradiction) {
  constexpr double kBackOnItsWay = 0.25, kOfTheJump = 0.05;
  FilterOptions options;
  options.derivatives = false;
  options.gate = kGate;
  options.contradiction = contradiction;
  std::vector<double> squared(run.truth.size(), kGate);
  options.on_innovation = [&](const Innovation& i) { squared[static_cast<std::size_t>(i.truth_index)] = i.squared; };
  const std::vector<char> aside = filtered(run, summed_up(run, model), model, options).set_aside;
  std::vector<Refused> refused;
  for (std::size_t i = 0; i < aside.size();) {
    std::size_t j = i;
    double jump = 1e300;  // the least of those refused
    bool begins_anew = false;
    for (; j < aside.size() && aside[j]; ++j) {
      jump = std::min(jump, squared[j]);
      begins_anew = begins_anew || aside[j] != 1;
    }
    const bool comes_back =
        j < aside.size() && !begins_anew && squared[j] < std::max(kBackOnItsWay * kGate, kOfTheJump * jump);
    if (j > i) refused.push_back({i, j, comes_back, jump, j < aside.size() ? squared[j] : jump});
    i = std::max(j, i + 1);
  }
  return refused;
}

std::vector<char> outlying(const InnovationRun& run, const InnovationModel& model) {
  constexpr std::size_t kFew = 4;
  std::vector<char> aside(run.truth.size(), 0);
  for (const Refused& r : refused_in_a_row(run, model, kContradiction))
    if (r.end - r.first <= kFew || r.comes_back)
      std::fill(aside.begin() + static_cast<std::ptrdiff_t>(r.first),
                aside.begin() + static_cast<std::ptrdiff_t>(r.end), 1);
  return aside;
}

}  // namespace odolab
