#include "core/diagnosis/model/shared_clock.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastVariance_s2 = 1e-14;  // a tenth of a microsecond: no stamps are better

}  // namespace

SharedClock shared_clock(const std::vector<double>& clock_s, const MatrixXd& covariance) {
  const auto n = static_cast<Eigen::Index>(clock_s.size());
  SharedClock out;
  if (n == 0) return out;
  const VectorXd clocks = Eigen::Map<const VectorXd>(clock_s.data(), n);
  VectorXd variance = covariance.diagonal().cwiseMax(kLeastVariance_s2);
  if (!variance.allFinite()) variance.setConstant(kLeastVariance_s2);
  const VectorXd precision = variance.cwiseInverse();
  const double sum = precision.sum(), mean = precision.dot(clocks) / sum;
  const double scatter = precision.dot((clocks.array() - mean).square().matrix());
  const double spread = sum - precision.squaredNorm() / sum;
  const double between_s2 = spread > 0.0 ? std::max(0.0, (scatter - static_cast<double>(n - 1)) / spread) : 0.0;
  out.between_s = std::sqrt(between_s2);
  out.weights = (variance.array() + between_s2).inverse().matrix();
  out.weights /= out.weights.sum();
  out.offset_s = out.weights.dot(clocks);
  const double own_s2 = out.weights.dot(covariance * out.weights);
  out.stderr_s = std::sqrt(std::max(0.0, own_s2) + between_s2 * out.weights.squaredNorm());
  return out;
}

}  // namespace odolab
