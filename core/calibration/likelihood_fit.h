// The fit of one set of parameters, and of the noise, to the likelihood of several runs: README.md in this folder, Eqs.
// 10 and 11.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "core/calibration/innovations.h"
#include "core/calibration/unknown_heading.h"

namespace odolab {

namespace column {
constexpr int shared = truth_clock;  // so many are of all recordings together; then a clock for each recording
}

// All parameters: what the recordings share, and the clock of each.
struct FitParameters {
  InnovationModel shared;
  std::vector<double> clock_s;  // one, or one for each recording

  int size() const { return column::shared + static_cast<int>(clock_s.size()); }
  int clock_of(int recording) const { return column::shared + (clock_s.size() == 1 ? 0 : recording); }
  InnovationModel of(int recording) const {
    InnovationModel model = shared;
    model.truth.time_offset_s = clock_s[clock_of(recording) - column::shared];
    return model;
  }
};

// A parameter by its column.
double& parameter_of(FitParameters& parameters, int c);

// How far from its nominal value each parameter may be expected: a standard deviation in its own unit.
std::vector<double> prior_sizes(const FitParameters& nominal);

// The whole likelihood of all runs, with the state of the fit.
class LikelihoodFit {
 public:
  LikelihoodFit(std::vector<InnovationRun> runs, const FitParameters& nominal)
      : runs_(std::move(runs)), kept_(runs_.size()), nominal_(nominal), now_(nominal), prior_(prior_sizes(nominal)) {}

  // Begins elsewhere than at the nominal values; the priors stay where they are.
  void start_from(const DifferentialDrive& drive) {
    now_.shared.drive = drive;
    sums_now_.reset();
  }
  void start_from(Vec2 tracked_point) {
    sums_now_.reset();
    now_.shared.truth.axle_T_tracked.x_m = tracked_point.x_m;
    now_.shared.truth.axle_T_tracked.y_m = tracked_point.y_m;
  }

  struct Sums {
    double chi2 = 0.0;  // without the prior
    double log_determinant = 0.0;
    int scalars = 0;
    Eigen::MatrixXd information;  // in units of the prior sizes
    Eigen::VectorXd score;
    Eigen::MatrixXd scatter;  // of the score over batches
    int batches = 0;
  };

  // `batches` above 0: also the scatter of the score over about so many batches.
  Sums sums(const FitParameters& parameters, bool derivatives, int batches = 0) const;
  // With derivatives, of what is fitted now; as the last time where nothing has changed since.
  const Sums& sums_now();

  // Holds the mean of both wheel radii where it was given, as where only ratios show.
  void hold_mean_radius() { mean_radius_is_held_ = true; }
  // Leaves the clocks their priors in every fit, as where a late one looks like a tracked point further behind.
  void keep_priors_of_clocks() { clocks_keep_priors_ = true; }
  // What that adds to the information of these columns.
  Eigen::MatrixXd information_held(const std::vector<int>& active) const;

  // Information of these columns as the likelihood falls from what is fitted now, a standard error to either side along
  // each of its axes. Where start headings are open it is no parabola: of a run that ends where it began noise makes a
  // way of its own, and errors as large as that hardly show.
  bool leaves_headings_open() const { return std::any_of(runs_.begin(), runs_.end(), may_leave_heading_open); }
  Eigen::MatrixXd as_it_falls(const std::vector<int>& active, const Eigen::MatrixXd& information) const;

  // On all cores where that is worth starting threads for.
  void each(int count, const std::function<void(int)>& work) const;

  // Levenberg and Marquardt on sum nu' S^-1 nu plus the prior of the active parameters; `weight` 0 leaves the prior
  // out.
  void fit_parameters(const std::vector<int>& active, double weight, int most_iterations);

  // Maximum likelihood of the noise sizes with the parameters held. With few innovations the freedom that the
  // parameters took is counted too (restricted likelihood, Patterson and Thompson 1971), so that the noise is not
  // fitted too small.
  void fit_noise(const std::vector<int>& active);

  // Sets samples aside by the gate, and cuts the runs anew where the clocks have them left out now. True where that
  // changed any.
  bool gate();

  // Lag-one correlation of the whitened innovations of x, y and heading.
  void correlations(double* out) const;
  // The largest of the three between samples two readings of the encoders apart, since those beside the same reading
  // share its rounding; and between samples a second apart.
  struct Lasting {
    double a_reading = 0.0, a_second = 0.0;
  };
  Lasting lasting_correlation() const;

  void hold_at_nominal(int c) {
    parameter_of(now_, c) = value(nominal_, c);
    sums_now_.reset();
  }
  static double value(FitParameters parameters, int c) { return parameter_of(parameters, c); }
  double deviation(const FitParameters& at, int c) const { return (value(at, c) - value(nominal_, c)) / prior_[c]; }
  const FitParameters& now() const { return now_; }
  const std::vector<InnovationRun>& runs() const { return runs_; }
  double prior(int c) const { return prior_[c]; }
  int restarts() const { return restarts_; }
  int truth_samples() const {
    int samples = 0;
    for (const InnovationRun& run : runs_) samples += static_cast<int>(run.truth.size());
    return samples;
  }

 private:
  Sums none() const;

  void add(Sums& total, int recording, const InnovationSums& s) const;

  // A run summed up, as the last time where what that depends on is as it was then. May be asked for several runs at
  // once.
  const SummedRun& summed(int run, const InnovationModel& model) const;

  struct Kept {
    DifferentialDrive drive;
    double clock_s = 0.0;
    bool body_is_noisy = false;
    SummedRun summed;
  };
  bool mean_radius_is_held_ = false, clocks_keep_priors_ = false;
  std::vector<InnovationRun> runs_;
  mutable std::vector<Kept> kept_;  // of each run; without motions where there is none yet
  FitParameters nominal_;
  FitParameters now_;
  std::optional<Sums> sums_now_;
  std::vector<double> prior_;
  int restarts_ = 0;
};

}  // namespace odolab
