// Calibration of a differential drive from whole recordings with outside truth.
//
// The likelihood is that of Kalman innovations: odometry errors accumulate, so absolute pose errors are not independent
// and plain least squares on them claims far too small a covariance. See README.md in this folder for the equations.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/calibration/aligned_clock.h"
#include "core/calibration/innovations.h"
#include "core/calibration/truth_filter.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

struct LeastSquaresOptions {
  bool fit_drive = true;  // radii and wheelbase; without it they are known
  // Estimated beside radii and wheelbase, because a wrong one would bend them.
  bool fit_truth_mounting = true;
  bool fit_truth_clock = true;
  bool one_truth_clock = false;  // the same offset in all recordings, instead of one for each
  int most_iterations = 30;
  // Of each recording, on the wheels' clock, from one reading to another: no motion across these is used. Without it
  // the gaps between readings. Whoever gives it has put stamps of arrival right.
  std::vector<std::optional<std::vector<std::pair<double, double>>>> left_out;
  // Of each recording, where they are known: held as they are, and stamps put right by the rates.
  std::vector<AlignedClock> clocks;
  bool truth_is_white = false;       // all its samples are used, though its noise seems to last
  bool truth_is_unfiltered = false;  // what had been measured before a filter, or no filter is to be looked for
  bool by_commands = false;  // the wheels are those that would have obeyed commands; a base follows them in its own way

  std::optional<std::vector<std::pair<double, double>>> left_out_of(std::size_t recording) const {
    if (recording >= left_out.size()) return std::nullopt;
    return left_out[recording];
  }
};

// One estimated parameter.
struct ParameterEstimate {
  std::string name;  // the vehicle file's key: "wheel_radius_left_m", "truth_mounting.x_m", ...
  std::string unit;
  double nominal = 0.0;
  double value = 0.0;
  double stderr_value = 0.0;
  bool determined = true;  // false: the recordings hold no information on it; the value is the nominal one
};

struct LeastSquaresCalibration {
  Vehicle vehicle;  // with the estimates put in
  std::vector<ParameterEstimate> parameters;
  std::vector<double> covariance;        // of the determined parameters in their order, row by row
  std::vector<double> time_offset_s;     // of the truth's clock in each recording; the parameter is their mean
  FittedNoise noise;                     // from the same recordings
  std::vector<std::string> cannot_tell;  // what the recordings cannot determine, and which drive would, in words
  std::vector<std::string> warnings;
  std::vector<std::string> of_misfit;    // more warnings: of what these parameters alone do not describe
  bool scale_is_open = false;            // only ratios show: the mean radius is held as it was given
  int innovations = 0;                   // scalar measurements used
  int outliers = 0;                      // truth samples set aside because they contradict their neighbours
  double normalised_chi2_nominal = 0.0;  // of the innovations, with the noise as fitted; 1 is a perfect fit
  double normalised_chi2 = 0.0;
  double minus_two_log_likelihood = 0.0;  // of the innovations, but for what their number makes it
  // Correlation of each whitened innovation with the next, of x, y and heading. Zero where the model is complete; else
  // there is something that these parameters do not describe. The standard errors are then enlarged to what the scatter
  // of the score over batches of the recordings shows.
  double correlation[3] = {};
  bool innovations_are_correlated = false;
  double lasting_correlation = 0.0;    // the largest of these two readings of the encoders apart
  double correlation_after_1_s = 0.0;  // and of innovations a second apart
  // Where these are large and pass within half a second, the truth's noise lasts: only samples so far apart are used
  // then (correlated_truth.h). Zero: all of them.
  double truth_apart_s = 0.0;
  std::optional<TruthFilter> truth_filter;  // it is by what had been measured before that (unfiltered_truth.h)
  double truth_smoothed_for_s = 0.0;  // as shows where the vehicle rests (smoothed_at_rest.h); 0: not, or not told
  // Whether fewer samples are used for another reason than that they are smoothed at rest.
  bool truth_lasts() const { return truth_apart_s > 0.0 && truth_apart_s != truth_smoothed_for_s; }
};

// Needs wheel samples and two truth samples or more in each recording; else an Error that names the recording.
// Stops with an Error where `progress` says so.
Result<LeastSquaresCalibration> calibrate_least_squares(const std::vector<Recording>& recordings,
                                                        const Vehicle& nominal, const LeastSquaresOptions& options = {},
                                                        const Progress& progress = {});

}  // namespace odolab
