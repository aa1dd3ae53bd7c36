// What values have to do with those before them.
#pragma once

#include <vector>

namespace odolab {

// How many times the variance of a sum of values is what it would be if each stood by itself, from stretches of them in
// order whose mean is zero: one and twice the sum of their correlations, as far as these are above zero together two by
// two (Geyer 1992, "Practical Markov chain Monte Carlo": the initial positive sequence), 200 apart at most. Never less
// than one.
double sum_widened_by_correlation(const std::vector<std::vector<double>>& stretches);

}  // namespace odolab
