#include "core/diagnosis/naming/own_noise.h"

#include <algorithm>

namespace odolab {

CandidateTest scored_under_own_noise(JointModel& with, bool thorough, const AskedHow& how) {
  with.fit_noise_and_all();
  const AcceptedEffect& term = with.accepted.back();
  CandidateColumns columns = with.columns_of(*term.effect, term.shape);
  columns.how = how;
  CandidateTest test = with.test(columns, static_cast<int>(with.accepted.size()) - 1, thorough);
  test.shape = term.shape;
  return test;
}

CandidateTest tested_under_own_noise(const JointModel& without, JointModel& with, bool thorough, const AskedHow& how) {
  CandidateTest test = scored_under_own_noise(with, thorough, how);
  test.statistic = std::min(test.statistic, without.minus_two_log_likelihood() - with.minus_two_log_likelihood());
  return test;
}

}  // namespace odolab
