// All runs under one model: calibration, noise and the effects let in so far; and the tests of what is not in it yet.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "core/calibration/least_squares.h"
#include "core/calibration/restamped.h"
#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/model/linearised.h"
#include "core/diagnosis/model/sample_evidence.h"
#include "core/diagnosis/model/score_by_batches.h"
#include "core/diagnosis/model/shared_clock.h"

namespace odolab {

struct TruthError;  // core/diagnosis/generic/truth_errors.h

struct AcceptedEffect {
  const Effect* effect = nullptr;
  std::vector<double> shape, value;
  bool is_held = false;    // found by the likelihood itself: fits leave it where it is
  bool is_damped = false;  // so many numbers that some direction of them is calibration's: fits do not drift along it
  bool acts_on_motion() const { return effect->acts_on_motion(); }
};

// By how much a score scatters more than the model says by what readings err by alone, and from how many squares that
// is known (driven_again.h).
struct Feigned {
  double more = 0.0, squares = 1e9;
};

// The efficient score of a candidate: its signature with everything that is in the model projected off.
struct CandidateTest {
  double statistic = 0.0;  // twice the gain of log-likelihood, chi-square with `freedom` under the null
  int freedom = 0;
  double inflation = 1.0;  // 1 or more: how much wider than the model says its score scatters
  double batches = 1e9;    // from so many it was found how the score scatters
  Feigned feigned;         // what of the inflation readings make
  double survives = 0.0;   // share of the signature's information that the projection leaves
  std::vector<double> value, stderr_value;
  // The same without directions that are mostly calibration's and in which nothing is seen: what can be drawn. Only
  // where that was asked for, of two columns and more.
  std::vector<double> drawn_value, drawn_stderr;
  double cross_validated = 0.0;  // gain of chi-square on every other batch, fitted on the rest
  std::vector<double> shape;
  double judged() const { return statistic / inflation; }
  void widen(const Feigned& by) {
    feigned = by;
    inflation += by.more;
    batches = std::min(batches, by.squares);
  }
};

struct AskedHow {
  double least_surviving = 1e-3;  // directions of which calibration leaves less are not tested
  // How the scores of all that is listed scatter tells how far this one may be believed: not of a term that was made to
  // find what they do not see.
  bool scatters_as_its_like = true;
  bool is_drawn = false;
};

// Columns of a candidate over all runs, of each run those that act in it: rows as the whitened innovations.
struct CandidateColumns {
  struct OfRun {
    std::vector<int> acting;  // amplitudes
    Eigen::MatrixXd z;        // rows of the stretch only; a column for each that acts
    Stretch stretch;
  };
  int amplitudes = 0;
  std::vector<OfRun> of_run;
  AskedHow how;
};

// The same of one candidate: products of its columns with each other, with those of the model, and with what is left.
struct CandidateProducts {
  Eigen::MatrixXd with_itself, with_model;
  Eigen::VectorXd with_residual;
};

class DrivenAgain;
class ScannedProducts;

class JointModel {
 public:
  JointModel(std::vector<InnovationRun> runs, std::vector<char> from_commands, const LeastSquaresCalibration& start,
             const Vehicle& nominal);

  // Gauss-Newton on calibration and amplitudes, shapes that follow their amplitude with them. Returns twice what the
  // log-likelihood gained on that way, from the scores at both ends of each step. Its own difference would not do: the
  // model's covariance moves with the wheelbase, which it likes or dislikes as far as the noise is a little too large
  // or small, and readings that are rounded pull at the radii.
  double fit(int iterations = 4);
  void fit_noise();
  // The noise that is left, and then all else under it.
  void fit_noise_and_all() {
    fit_noise();
    fit(2);
  }
  void gate();  // isolated contradictions only; longer ones are left to be explained
  // Takes what was set aside near that time of that run among the evidence again.
  void readmit(int run, double time_s);
  // Leaves the truth of that run out between two times of its wheels' clock: it shows something else than the vehicle.
  void leave_out(int run, double from_s, double to_s);
  // Whether that time of that run lies more than a few samples and a tenth of a second from all that is left out and
  // from both ends: what happens nearer cannot be told from a sample that errs.
  bool is_well_inside(int run, double time_s) const;
  // `with_columns` false: only what the model leaves, of which nothing can be tested or fitted. Does nothing where the
  // model stands as it was linearised last.
  void linearise(bool with_columns = true);

  std::vector<AcceptedEffect> accepted;
  InnovationModel model;  // without the clocks
  std::vector<double> clock_s;
  std::vector<char> clock_active;
  // Clocks and their rates stay where they are: they were found by the moments themselves (clocks_first). Their slope,
  // of smoothed readings as all columns, is another one than that of the likelihood where a robot jitters.
  bool clocks_are_held = false;
  std::array<double, 2> half_counts{};  // left and right: how much of counts_at_rest there is
  std::vector<char> nuisance_active = std::vector<char>(6, 1);
  // Of a run that was left out: whether all that acts in it is known from the others.
  bool is_foretold = true;
  // Of the truth as it was recorded: its samples are not what the likelihood takes them for.
  bool truth_noise_lasts = false;
  double truth_smoothed_for_s = 0.0;  // as its rests show (smoothed_at_rest.h); 0: they do not
  bool shows_at_rest(const Effect& e) const { return e.of_the_truth && truth_smoothed_for_s > 0.0; }
  // Whether the first fit of the noise asks after how long the truth's frame comes back.
  bool truth_may_come_back = true;
  std::shared_ptr<const std::vector<TruthError>> truth_errors;  // what else it may err by; null: nothing
  std::shared_ptr<const DrivenAgain> driven_again;              // what readings feign; null: nothing
  double truth_feigns_m = 0.0;  // of a wheel's way at a place or moment, by the steps that the truth has
  bool truth_jumps = false;     // time and again, so that what happens at one moment is not told from these

  const std::vector<DriveView>& views() const { return now_->views; }
  const std::vector<InnovationRun>& runs() const { return runs_; }
  const std::vector<LinearisedRun>& linearised() const { return now_->runs; }
  double minus_two_log_likelihood_of(int run) const;  // of that run alone, as it is now
  double chi2() const { return chi2_; }
  double minus_two_log_likelihood() const { return chi2_ + log_determinant_; }
  int scalars() const { return scalars_; }
  // Of samples between which a wheel rolled: those at rest are asked again and again, and say the same of any motion.
  int scalars_on_the_way() const;
  Eigen::MatrixXd covariance() const;  // of the columns: nuisances, clocks, half counts, amplitudes
  double stderr_of_nuisance(int c) const;
  SharedClock shared_clock() const;
  int first_column(int accepted) const;  // of an accepted effect's amplitudes
  // How much wider than the curvature says each column's estimate scatters, from the scatter of the score over batches:
  // 1 or more.
  Eigen::VectorXd inflation_of_columns() const;
  // By how much the columns together stand for a candidate's: a model without the candidate errs by this.
  Eigen::MatrixXd absorbed(const CandidateColumns& columns) const;
  // Mean square error of dead reckoning gathered over a metre or a radian, position and heading, over all runs; zero
  // windows where the truth has no headings.
  struct GatheredError {
    double position_m2 = 0.0, heading_rad2 = 0.0;
    double noise_position_m2 = 0.0, noise_heading_rad2 = 0.0;  // what the model's noise alone would leave
    int windows = 0;
    std::vector<Pose> of_window;      // in the order of the runs
    std::vector<double> window_at_s;  // where each begins, by the truth's stamps
    void add(const GatheredError& of_other_runs);
  };
  GatheredError gathered_error(int first_run = 0) const;  // of the runs from that one on
  // The same of the position alone, of runs whose truth has no headings: each window begins with the heading that the
  // model makes of the truth before it, and none within the first metre. The heading's error is no number.
  GatheredError path_error() const;
  // How little the likelihood is to be believed, since innovations are correlated: from 0, white, to 1. `of_a_moment`:
  // of what acts at one moment or place.
  double distrust(bool of_a_moment = false) const;
  // How much wider sums of innovations scatter than the model says, in the channel that is widest: one and more.
  double wider_by_correlation() const;
  Track poses(int run) const;  // corrected, at the wheels' times
  // Of the tracked point by the wheels and the accepted effects alone, from the axle's pose zero, on the truth's clock.
  Track dead_reckoned(int run) const;

  CandidateColumns columns_of(const Effect& effect, const std::vector<double>& shape) const;
  // `without`: an accepted effect that is taken out for the question. `thorough`: inflation and cross-validation too.
  static constexpr int kNone = -1, kAll = -2;
  CandidateTest test(const CandidateColumns& columns, int without = kNone, bool thorough = false) const;
  // What thorough tests of many candidates have in common: the model without an effect, and what that leaves.
  class Asked;
  std::shared_ptr<const Asked> asked(int without = kNone) const;
  // Thoroughly, against each of these.
  std::vector<CandidateTest> tests(const CandidateColumns& columns,
                                   const std::vector<std::shared_ptr<const Asked>>& against) const;
  // Twice the log-likelihood that an accepted effect could lend to a candidate of these amplitudes, or to another
  // accepted one, if it were there and showed only as the other does, wherever both show: (sum |a| |b|)^2 / sum a^2
  // over the samples, b its own trace, a the other's with all that is in the model projected off. A form that is wrong
  // by a share, however that comes and goes, lends no more than that share, squared, of this.
  double can_look_like(const CandidateColumns& candidate, const std::vector<double>& value, int accepted) const;
  double can_look_like(int other_accepted, int accepted) const;
  // How much wider than the model says what is left scatters about a moment of a run, once a candidate of these
  // amplitudes is taken off: within a second of it, but not where it happens. One where that is no more than chance.
  double scatter_about(int run, double time_s, const CandidateColumns& candidate,
                       const std::vector<double>& value) const;
  // How fast the log-likelihood grows with the motion of each wheel interval of a run, everything in the model fitted
  // anew: the score of any column is its product with this.
  std::vector<BodyMotion> score_of_motions(int run) const;
  // By how much twice the log-likelihood is smaller without an accepted effect, all else fitted anew; and that model. A
  // score is linear about the model that has the effect: where that is much, only this tells.
  double lost_without(int accepted_effect, JointModel* without = nullptr) const;
  // Of each run.
  std::vector<std::vector<SampleEvidence>> evidence_of(int accepted_effect) const;
  // That run alone under what all others say: one step of Gauss-Newton from here without it. Its clock is its own, and
  // what happened in it alone is unknown to the others.
  JointModel left_out(int run) const;
  // With the recordings of another model of the same robot, which has the same effects let in but for what happened in
  // one recording alone, as it stands; to be linearised.
  JointModel together_with(const JointModel& others) const;
  InnovationModel model_of(int run) const;
  double* clock_rate_of(int run);    // null where its clock has no rate of its own
  double clock_rate(int run) const;  // by how much its wheels' clock is fast
  TwoClocks clocks(int run) const;
  InnovationRun prepared(int run) const;  // with the accepted effects put in
  // The same of all its samples, where fewer are fitted to; and the noise of these.
  InnovationRun recorded(int run) const;
  FittedNoise noise_as_recorded() const;
  JointModel as_recorded() const;  // all that was recorded, with what the model leaves of it; without columns
  JointModel under(const FittedNoise& noise) const;  // to be linearised
  // Of drives of which all that was assumed is true: priors say what the model does. To be linearised.
  JointModel with_runs(std::vector<InnovationRun> runs) const;

 private:
  friend class CandidateScan;
  // About the model as it was when it was linearised last; shared by its copies, since it is large.
  struct Linearisation {
    std::vector<DriveView> views;       // smoothed, for columns
    std::vector<DriveView> read_views;  // for what the accepted effects move
    std::vector<LinearisedRun> runs;
    std::vector<std::vector<int>> columns;  // those that act in a run
    std::vector<Eigen::MatrixXd> z;         // of each run: only these
    // Of all columns, those that act in a run.
    Eigen::VectorXd acting(std::size_t run, const Eigen::VectorXd& of_all) const;
  };
  // The model's columns but for an effect that is taken out for the question, ready to absorb a candidate.
  struct Absorbing {
    std::vector<int> kept;
    Eigen::VectorXd taken;  // amplitudes of what is taken out, at its columns
    Eigen::LDLT<Eigen::MatrixXd> gram;
    Eigen::VectorXd step;  // of the kept columns, from here to their best
  };
  Absorbing absorbing(int without) const;
  // The test without its thorough part; `absorbed`: what the kept columns take of each of the candidate's.
  static CandidateTest tested(const Absorbing& by, CandidateProducts products, const AskedHow& how,
                              Eigen::MatrixXd* absorbed);
  CandidateTest tested_thoroughly(const Asked& by, CandidateProducts products, const CandidateColumns& c) const;
  int batch_samples() const;
  // Of a candidate that was tested, `absorbed` by the kept columns.
  ScoreByBatches score_by_batches(const Asked& by, const CandidateColumns& c, const CandidateTest& test,
                                  const Eigen::MatrixXd& absorbed) const;
  // From the scores of all effects that have no shape to look for. Of the linearisation as it is.
  double batches_believed_white() const;
  // The linearisation is another one, or what it leaves.
  void forget_what_was_asked() {
    scanned_.reset();
    white_ = std::make_shared<BelievedWhite>();
  }
  // Of the model's columns, what makes up an accepted effect with all else projected off.
  Eigen::VectorXd beside_all_else(int accepted) const;
  CandidateProducts products_of(const CandidateColumns& columns) const;
  // What a candidate of these amplitudes leaves in a run, `of_model` of the model's columns taken off.
  Eigen::VectorXd beside_model(int run, const CandidateColumns& c, const Eigen::VectorXd& value,
                               const Eigen::VectorXd& of_model) const;
  // Of the linearisation as it is. Not to be asked for the first time by several threads.
  std::shared_ptr<ScannedProducts> scanned_products() const;
  JointModel() = default;
  // All that a linearisation depends on, and that may change.
  struct Standing {
    std::vector<double> numbers;
    std::vector<const Effect*> effects;
    std::vector<char> active;
    bool operator==(const Standing&) const = default;
  };
  Standing standing() const;
  // `headings_of` the truth's samples of a run; NaN where none is known.
  GatheredError gathered(int first_run,
                         const std::function<std::vector<double>(int, const InnovationRun&)>& headings_of) const;
  Track dead_reckoned(const InnovationRun& run, double truth_late_s) const;
  void cut();  // the runs anew, where the clocks have them left out now
  InnovationRun prepared(int run, const InnovationRun& of, const DriveView& view) const;
  // At the speeds that the accepted effects leave.
  DriveView as_it_goes(DriveView by_wheels) const;
  // Radii, wheelbase and mounting by their column, 0 to 5.
  static double& nuisance(InnovationModel& model, int c);
  void add_products(int run, Eigen::MatrixXd& gram, Eigen::VectorXd& zr) const;
  // As in calibration: wide, so that what these runs do not determine stays where it was.
  void add_priors();
  std::array<double, 6> sizes_of_priors() const;
  static constexpr double kMeanRadiusHeld = 1e8;  // to a ten-thousandth of its prior, as calibration does
  Eigen::Matrix2d of_mean_radius() const;
  int columns() const;
  std::vector<int> held_columns() const;
  int columns_fitted() const;  // those that some run has and that are not held
  int clock_column(int run) const { return 6 + run; }
  int half_count_column(int wheel) const { return 6 + static_cast<int>(runs_.size()) + wheel; }
  int first_amplitude() const { return 6 + static_cast<int>(runs_.size()) + 2; }

  std::vector<InnovationRun> runs_;
  std::vector<int> numbers_;  // of the recordings, as the effects know them
  std::vector<char> from_commands_;
  std::vector<std::vector<char>> masked_;  // as the runs came: faults of the data
  Vehicle nominal_;
  bool mean_radius_is_held_ = false;  // only ratios show
  // Of radii, wheelbase and mounting those of which calibration learned next to nothing: they stay where they are.
  std::array<char, 6> untold_{};
  std::shared_ptr<const Linearisation> now_;
  std::optional<Standing> linearised_at_;  // none where the runs have changed since
  bool has_columns_ = false;
  std::vector<Eigen::VectorXd> residual_;             // of each run, whitened
  mutable std::shared_ptr<ScannedProducts> scanned_;  // made when the first asks
  struct BelievedWhite {
    std::once_flag once;
    double batches = 0.0;
  };
  std::shared_ptr<BelievedWhite> white_;  // the same
  Eigen::MatrixXd gram_;                  // with priors
  Eigen::VectorXd zr_;
  double chi2_ = 0.0, log_determinant_ = 0.0;
  int scalars_ = 0;
};

}  // namespace odolab
