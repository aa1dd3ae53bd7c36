// Tails of the distributions that tests are held against.
#pragma once

namespace odolab {

// P(chi-square with that freedom > x).
double chi_square_tail(double x, int freedom);
// The same where x was divided by a scale that was itself found from so many batches: the tail of Fisher's F.
double scaled_chi_square_tail(double x, int freedom, double batches);

}  // namespace odolab
