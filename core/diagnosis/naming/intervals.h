// How well a fitted model's parameters are known: amplitudes and calibration from the joint curvature, shapes (a place,
// a time, a threshold) from the profile of the likelihood, which need not be smooth: core/diagnosis/README.md, Eqs. 10
// to 12.
#pragma once

#include <vector>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

struct Intervals {
  Eigen::MatrixXd columns;                 // covariance of the model's columns: nuisances, clocks, amplitudes
  std::vector<Eigen::MatrixXd> of_effect;  // covariance of each accepted effect's amplitudes, then of its free shapes
  std::vector<double> from_nothing;        // how far its amplitudes together are from zero: chi-square of so many

  double stderr_of_nuisance(int c) const;
  SharedClock shared_clock(const JointModel& joint) const;
};

// Which entries of a shape are estimated: not the number of a recording, nor one that is its own amplitude.
std::vector<int> free_shapes(const Effect& effect);

// Moves the shapes to where their likelihood has its weight, refits, and says how well everything is known.
// `inflation`: of the evidence of each accepted effect.
Intervals refined(JointModel& joint, const std::vector<double>& inflation);

// An accepted effect in the catalogue's words, as these drives show it. `covariance`: as in Intervals::of_effect.
std::vector<FoundParameter> parameters_of(const AcceptedEffect& accepted, const Eigen::MatrixXd& covariance,
                                          const std::vector<DriveView>& views);

// The calibration that belongs to a model with effects; what was not determined without them is not determined now.
LeastSquaresCalibration calibration_with(const JointModel& joint, const Intervals& intervals,
                                         const LeastSquaresCalibration& alone, const Vehicle& nominal);

}  // namespace odolab
