// A run linearised about a model: what a small motion added to it, or a parameter moved, does to the whitened
// innovations. One pass of the filter is kept and every column is carried through it alone, so that hundreds of
// candidates cost no more than their own length.
#pragma once

#include <memory>
#include <vector>

#include "core/calibration/innovations.h"
#include "core/diagnosis/motions.h"

namespace odolab {

// Whitened innovations or derivatives of them: three numbers for each truth sample, along and across the vehicle and in
// heading, zero where the sample was not used.
using Whitened = std::vector<double>;

// The part of a run that a column touches: truth samples [first, last).
struct Stretch {
  int first = 0, last = 0;
};

class LinearisedRun {
 public:
  LinearisedRun(InnovationRun run, const InnovationModel& model);

  int samples() const { return static_cast<int>(steps_.size()); }
  const Whitened& residual() const { return residual_; }
  const std::vector<FilterStep>& steps() const { return steps_; }  // one for each truth sample
  const InnovationRun& run() const { return *run_; }
  const InnovationSums& sums() const { return sums_; }

  // Derivative of the prediction by the value of an effect that moves the body by `per_step` between wheel samples.
  // `out` has three numbers for each sample and is written to within the returned stretch only.
  Stretch of_motion(const Motions& motions, double* out) const;
  // The same by one of the seven parameters of `column`.
  void of_parameter(int parameter, double* out) const;
  // The product of `whitened` with the column of every motion at once: how fast it grows with the forward, sideways and
  // turning motion of each wheel interval. One pass backward, whatever the number of columns asked for.
  std::vector<BodyMotion> score_of_motions(const double* whitened) const;
  // By the rate of the wheels' clock, against the truth's, about the run's first truth sample.
  void of_clock_rate(double* out) const;

 private:
  struct Piece {  // of a wheel interval within a truth interval, in the frame of the latter's start
    int interval;
    float share;
    double dx, dy, c, s;
  };
  template <typename Motion>
  Stretch carried(Motion&& motion, int first, int last_with_motion, int parameter, double* out) const;

  std::shared_ptr<const InnovationRun> run_;
  SummedRun summed_;
  std::vector<Piece> pieces_;
  std::vector<int> first_piece_;  // of each truth interval
  std::vector<FilterStep> steps_;
  struct Turned {  // cosine and sine of a step's headings, before and predicted
    double c0, s0, c1, s1;
  };
  std::vector<Turned> turned_;
  std::vector<double> whitener_;  // rows of the matrix that whitens a room-frame derivative: 9 for each sample
  Whitened residual_;
  InnovationSums sums_;
  InnovationModel model_;
};

}  // namespace odolab
