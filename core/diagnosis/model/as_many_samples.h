// Likelihoods of models that do not use the same samples.
#pragma once

#include <algorithm>

namespace odolab {

struct MisfitOfSamples {
  double minus_two_log_likelihood;
  int scalars;  // that this is of
};

// By how much twice the log-likelihood of `a` is more than that of another: a filter may start anew, or set aside, in
// one and not in the other, and a scalar more counts as all others of that do.
inline double likelier_by(const MisfitOfSamples& a, const MisfitOfSamples& than) {
  const double of_each = than.minus_two_log_likelihood / std::max(1, than.scalars);
  return than.minus_two_log_likelihood - a.minus_two_log_likelihood + of_each * (a.scalars - than.scalars);
}

}  // namespace odolab
