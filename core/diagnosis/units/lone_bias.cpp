#include "core/diagnosis/units/lone_bias.h"

#include <Eigen/Dense>
#include <cmath>

#include "core/base/chi_square.h"

namespace odolab {

std::optional<LoneBias> lone_bias(const GeometryFit& geometry) {
  using Eigen::MatrixXd;
  using Eigen::VectorXd;
  constexpr double kByChance = 0.01, kBeaten = 10.0;
  std::vector<Eigen::Index> encoders;
  for (std::size_t k = 0; k < geometry.joints.size(); ++k) {
    const JointEstimate& e = geometry.joints[k];
    if (!e.is_of_an_encoder()) continue;
    if (!e.determined || e.is_from_inside || e.parameter.effect == "pivot_angle_bias") return std::nullopt;
    encoders.push_back(static_cast<Eigen::Index>(k));
  }
  const auto n = static_cast<Eigen::Index>(encoders.size());
  if (n < 2 || geometry.covariance.rows() != static_cast<Eigen::Index>(geometry.joints.size())) return std::nullopt;
  const MatrixXd information = MatrixXd(geometry.covariance(encoders, encoders)).inverse();
  VectorXd off(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const JointEstimate& e = geometry.joints[static_cast<std::size_t>(encoders[static_cast<std::size_t>(k)])];
    off[k] = e.value - e.nominal;
  }
  const VectorXd score = information * off;
  // Of twice the log-likelihood, what is left where one of them alone is free.
  const VectorXd left =
      VectorXd::Constant(n, off.dot(score)).array() - score.array().square() / information.diagonal().array();
  Eigen::Index least = 0;
  left.minCoeff(&least);
  if (chi_square_tail(left[least], static_cast<int>(n - 1)) < kByChance) return std::nullopt;
  for (Eigen::Index k = 0; k < n; ++k)
    if (k != least && left[k] < left[least] + kBeaten) return std::nullopt;
  LoneBias lone;
  lone.joint = static_cast<std::size_t>(encoders[static_cast<std::size_t>(least)]);
  lone.off = score[least] / information(least, least);
  lone.stderr_value = 1.0 / std::sqrt(information(least, least));
  for (const Eigen::Index k : encoders)
    if (k != encoders[static_cast<std::size_t>(least)])
      lone.others.push_back(geometry.joints[static_cast<std::size_t>(k)].parameter.name);
  return lone;
}

}  // namespace odolab
