// Long curves reduced to what a screen can show.
#pragma once

#include <cstddef>
#include <vector>

namespace odolab::ui {

// Indices of the samples that matter between x0 and x1 on a screen of `columns` pixels: of each column the first, the
// least, the greatest and the last, and a neighbour on either side of the range. x never decreases.
std::vector<std::size_t> decimated(const double* x, const double* y, std::size_t count, double x0, double x1,
                                   int columns);

}  // namespace odolab::ui
