// What half of some numbers, or another share of them, do not exceed.
#pragma once

#include <vector>

namespace odolab {

// The number that stands at that share, 0 to 1, of the way from the least to the largest; 0 of none.
double quantile(std::vector<double> values, double share);

// The middle one, or the mean of both in the middle; 0 of none.
double median(std::vector<double> values);

// The standard deviation of normal numbers about zero, by the median of their sizes: outliers hardly count. 0 of none.
double scatter_about_zero(std::vector<double> values);

}  // namespace odolab
