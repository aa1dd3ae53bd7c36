#include "core/diagnosis/naming/compared_names.h"

#include <algorithm>

#include "core/diagnosis/naming/one_cause.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

double more_by_tries(const ScoredCandidate& c, const ScoredCandidate& other) {
  return 2.0 * std::max(0.0, c.log_tests - other.log_tests);
}

bool beats(const ScoredCandidate& c, const ScoredCandidate& other) {
  const double by = kClearlyBeaten + more_by_tries(c, other);
  return c.test.judged() > other.test.judged() + by &&
         c.test.statistic > other.test.statistic + by * std::max(1.0, c.test.inflation);
}

bool is_simpler(const ScoredCandidate& c, const ScoredCandidate& other) {
  if (c.test.judged() < (1.0 - kFormError) * other.test.judged()) return false;
  if (of_one_moment(c, other) || other.effect->name == "collision") return c.test.freedom < other.test.freedom;
  return of_one_small_place(c, other) ||
         (c.effect->name == "bump" && c.effect->of_one_recording && other.effect->name == "slip_zone");
}

bool says_as_much_beside(const ScoredCandidate& instead, const std::vector<ScoredCandidate>& with_all) {
  constexpr double kAsMuch = 0.8;
  return std::any_of(with_all.begin(), with_all.end(), [&](const ScoredCandidate& c) {
    return c.effect == instead.effect && c.test.statistic > kAsMuch * instead.test.statistic &&
           (!c.effect->of_one_recording || of_one_moment(c, instead));
  });
}

}  // namespace odolab
