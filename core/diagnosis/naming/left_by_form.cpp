#include "core/diagnosis/naming/left_by_form.h"

#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

bool may_be_left_by_form(const std::vector<ScoredCandidate>& evidence, std::size_t k, double family_wise_error) {
  constexpr double kOfTheError = 1e-6;
  double others = 0.0;
  for (std::size_t j = 0; j < evidence.size(); ++j)
    if (j != k) others += counted(*evidence[j].effect, evidence[j].test.statistic);
  const ScoredCandidate& name = evidence[k];
  return name.test.statistic < kMostLeft * others && name.p_value > kOfTheError * family_wise_error;
}

}  // namespace odolab
