// What the recordings say of the shape of one effect (a place, a time, a threshold), whatever all else may be.
#pragma once

#include <vector>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

struct ShapeLikelihood {
  std::vector<double> best;       // the whole shape, where the likelihood is highest
  std::vector<double> mean;       // the whole shape, weighted by the likelihood
  Eigen::MatrixXd covariance;     // of the free entries about `mean`
  Eigen::MatrixXd of_amplitudes;  // covariance of the amplitudes that belong to them
  double lost = 0.0;              // chi-square that `mean` costs against `best`
};

// The profile of the likelihood over the shape of an accepted effect, tempered by `inflation`: climbed by simplex, then
// weighed by adaptive importance sampling (O. Cappe, A. Guillin, J.-M. Marin, C. Robert 2004, population Monte Carlo),
// since thresholds and rims are no smooth functions. The samples are the same on every machine.
ShapeLikelihood shape_likelihood(const JointModel& joint, int accepted, double inflation);

// How far an entry of a shape is moved at first when a better one is looked for.
double first_stride(const Effect& effect, int entry, double value);

}  // namespace odolab
