// What a term of a model says in one place.
#pragma once

namespace odolab {

// Of what is read at one time, by the wheels' clock, all else fitted anew without the term: the product of the term's
// trace with what is left beside it, and the square of that trace, whitened. The product and half the square together
// are what the log-likelihood gains.
struct SampleEvidence {
  double time_s = 0.0, product = 0.0, square = 0.0;
};

}  // namespace odolab
