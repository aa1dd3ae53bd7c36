// A run linearised about a model: what a small motion added to it, or a parameter moved, does to the whitened
// innovations. One pass of the filter is kept and every column is carried through it alone, so that hundreds of
// candidates cost no more than their own length.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/calibration/innovations.h"
#include "core/diagnosis/effects/motions.h"
#include "core/geometry/small_turn.h"

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
  // `with_columns` false: what the model leaves, and where the filter was; of no column anything may be asked.
  LinearisedRun(InnovationRun run, const InnovationModel& model, bool with_columns = true);

  int samples() const { return static_cast<int>(steps_.size()); }
  const Whitened& residual() const { return residual_; }
  const std::vector<FilterStep>& steps() const { return steps_; }  // one for each truth sample
  const InnovationRun& run() const { return *run_; }
  const SummedRun& summed() const { return summed_; }
  const InnovationSums& sums() const { return sums_; }

  // Derivative of the prediction by the value of an effect that moves the body by `per_step` between wheel samples.
  // `out` has three numbers for each sample and is written to within the returned stretch only.
  Stretch of_motion(const Motions& motions, double* out) const;
  // The same by the seven parameters of `column`, all in one pass; null for one that nobody asks for.
  void of_parameters(const std::array<double*, column::first_extra>& out) const;
  // The sum of squares that a derivative of the pose still brings behind each sample: xx, xy, xh, yy, yh, hh; and,
  // where the truth's frame comes back, of the pose and the frame: 6 by 6.
  struct Tails {
    std::vector<std::array<double, 6>> of_pose;
    std::vector<Eigen::Matrix<double, 6, 6>> of_both;
  };
  Tails tails() const;
  // The product of `whitened` with the column of every motion at once: how fast it grows with the forward, sideways and
  // turning motion of each wheel interval. One pass backward, whatever the number of columns asked for.
  std::vector<BodyMotion> score_of_motions(const double* whitened) const;
  // The same for what moves in each truth interval, x, y and heading at its end in the room: 3 numbers for each.
  std::vector<double> score_of_intervals(const double* whitened) const;
  // What candidates do in truth intervals, x, y and heading at the interval's end in the room, of those parts of the
  // run in which any of them may act. So many lie side by side: of the n-th interval held, column j, number r and
  // candidate l at ((n * columns + j) * 3 + r) * abreast + l.
  static constexpr std::size_t kAbreast = 4;
  struct Moved {
    struct Part {
      int first, end;           // truth intervals
      std::size_t held_before;  // of the parts before it
    };
    std::size_t abreast = 1;
    std::vector<std::size_t> columns;  // in which any of them acts
    std::vector<Part> parts;           // in order and apart
    std::vector<double> by;
    std::vector<char> any;  // of the intervals held: whether anything moves in them
  };
  // Of one candidate, or of kAbreast, those that do not act being empty; all have the same number of columns. What
  // `moved` held is forgotten.
  void move(const std::vector<std::vector<Motions>>& candidates, Moved& moved) const;
  // Products of the columns of each candidate with each other, as `of_motion` gives them, without writing them down:
  // columns by columns of `moved`, those of all candidates side by side. Costs what the motions last, and nothing for
  // what they leave behind.
  void products_of(const Moved& moved, const Tails& tails, std::vector<double>& products) const;
  // By the rate of the wheels' clock, against the truth's, about the run's first truth sample.
  void of_clock_rate(double* out) const;

 private:
  // The part of a wheel interval that lies in a truth interval, and what the body's motion in it moves at the latter's
  // end in the room: forward by (forward_x, forward_y), sideways a right angle to the left of that, a turn by (turn_x,
  // turn_y) and `share` of itself.
  struct Piece {
    int interval, truth;
    double share, forward_x, forward_y, turn_x, turn_y;
  };
  // What a truth sample does to the derivative of the pose: e = F d + R jac is predicted, `out` e whitened, `on` e goes
  // on. Nothing is whitened where the sample was not used, and nothing goes on where the filter starts anew.
  struct Carry {
    double c = 1.0, s = 0.0;    // R: the heading at the sample before
    double dx = 0.0, dy = 0.0;  // F: the way since then, in the room
    double out[9] = {}, on[9] = {};
  };
  // The same where the truth's frame comes back (FittedNoise::wander_lasts_s): what it is off decays, is read with the
  // pose and corrected by what is read. Nothing of that where it never does.
  struct TruthCarry {
    double decay = 0.0, ax = 0.0, ay = 0.0;
    double read_heading = 0.0;  // 1 where one was
    double out[9] = {}, pose_gain[9] = {}, truth_gain[9] = {};
  };
  bool truth_comes_back() const { return !truth_carry_.empty(); }
  void prepare_carry();
  // Truth intervals [first, last) that the wheel intervals [first, end) touch.
  Stretch touched(std::size_t first, std::size_t end) const;
  void cut_into_pieces();
  template <int columns, int abreast, bool comes_back>
  void products(const Moved& moved, const std::size_t* which, const Tails& tails, double* products) const;
  template <int abreast, bool comes_back>
  void products_of_all(const Moved& moved, const Tails& tails, double* products) const;

  std::shared_ptr<const InnovationRun> run_;
  SummedRun summed_;
  std::vector<Piece> pieces_;
  std::vector<int> first_piece_;      // of each truth interval
  std::vector<int> piece_of_wheels_;  // the first one of each wheel interval, or of those behind it
  std::vector<FilterStep> steps_;
  std::vector<Turn> here_;  // of each step's predicted heading
  std::vector<Carry> carry_;
  std::vector<TruthCarry> truth_carry_;
  std::vector<double> whitener_;  // rows of the matrix that whitens a room-frame derivative: 9 for each sample
  Whitened residual_;
  InnovationSums sums_;
  InnovationModel model_;
};

}  // namespace odolab
