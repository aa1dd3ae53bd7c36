// A run linearised about a model: what a small motion added to it, or a parameter moved, does to the whitened
// innovations. One pass of the filter is kept and every column is carried through it alone, so that hundreds of
// candidates cost no more than their own length.
#pragma once

#include <array>
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
  const SummedRun& summed() const { return summed_; }
  const InnovationSums& sums() const { return sums_; }

  // Derivative of the prediction by the value of an effect that moves the body by `per_step` between wheel samples.
  // `out` has three numbers for each sample and is written to within the returned stretch only.
  Stretch of_motion(const Motions& motions, double* out) const;
  // The same by one of the seven parameters of `column`.
  void of_parameter(int parameter, double* out) const;
  // The sum of squares that a derivative of the pose still brings behind each sample: xx, xy, xh, yy, yh, hh.
  using Tails = std::vector<std::array<double, 6>>;
  Tails tails() const;
  // Products of the columns of several motions with each other, k by k, row by row: as `of_motion` gives them, without
  // writing them down. Costs what the motions last, and nothing for what they leave behind.
  void products_of_motions(const std::vector<Motions>& motions, const Tails& tails, double* products) const;
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
  // What a truth sample does to the derivative of the pose: e = F d + R jac is predicted, `out` e whitened, `on` e goes
  // on. Nothing is whitened where the sample was not used, and nothing goes on where the filter starts anew.
  struct Carry {
    double c = 1.0, s = 0.0;    // R: the heading at the sample before
    double dx = 0.0, dy = 0.0;  // F: the way since then, in the room
    double out[9] = {}, on[9] = {};
  };
  void prepare_carry();
  // Truth intervals [first, last) that the wheel intervals [first, end) touch.
  Stretch touched(std::size_t first, std::size_t end) const;
  // The derivative of the motion in truth interval t, in the frame of its start.
  void add_motion(const Motions& motions, int t, double* d) const {
    for (int p = first_piece_[t]; p < first_piece_[t + 1]; ++p) {
      const Piece& piece = pieces_[p];
      const BodyMotion m = motions.at(static_cast<std::size_t>(piece.interval));
      const double f = piece.share * m.forward_m, l = piece.share * m.sideways_m, w = piece.share * m.turn_rad;
      d[0] += -piece.dy * d[2] + piece.c * f - piece.s * l - 0.5 * piece.dy * w;
      d[1] += piece.dx * d[2] + piece.s * f + piece.c * l + 0.5 * piece.dx * w;
      d[2] += w;
    }
  }
  template <int k>
  void products(const Motions* const* motions, const Tails& tails, double* products) const;
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
  std::vector<Carry> carry_;
  std::vector<double> whitener_;  // rows of the matrix that whitens a room-frame derivative: 9 for each sample
  Whitened residual_;
  InnovationSums sums_;
  InnovationModel model_;
};

}  // namespace odolab
