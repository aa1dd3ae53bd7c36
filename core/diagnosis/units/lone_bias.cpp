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
  bool are_pivots = false;
  for (std::size_t k = 0; k < geometry.joints.size(); ++k) {
    const JointEstimate& e = geometry.joints[k];
    if (!e.is_of_an_encoder()) continue;
    if (!e.determined) return std::nullopt;
    are_pivots = are_pivots || e.parameter.effect == "pivot_angle_bias";
    encoders.push_back(static_cast<Eigen::Index>(k));
  }
  const auto n = static_cast<Eigen::Index>(encoders.size());
  const Eigen::Index others = n - (are_pivots ? 2 : 1);
  if (others < 1 || geometry.covariance.rows() != static_cast<Eigen::Index>(geometry.joints.size()))
    return std::nullopt;
  const auto estimate = [&](Eigen::Index k) -> const JointEstimate& {
    return geometry.joints[static_cast<std::size_t>(encoders[static_cast<std::size_t>(k)])];
  };
  MatrixXd information = MatrixXd(geometry.covariance(encoders, encoders)).inverse();
  const VectorXd of_all = information.rowwise().sum();
  if (are_pivots) information -= of_all * of_all.transpose() / of_all.sum();
  VectorXd off(n);
  for (Eigen::Index k = 0; k < n; ++k) off[k] = estimate(k).value - estimate(k).nominal;
  const VectorXd score = information * off;
  // Of twice the log-likelihood, what one of them alone gains, and what is left then.
  const VectorXd gain = score.array().square() / information.diagonal().array();
  const VectorXd left = VectorXd::Constant(n, off.dot(score)) - gain;
  Eigen::Index least = 0;
  left.minCoeff(&least);
  if (chi_square_tail(left[least], static_cast<int>(others)) < kByChance) return std::nullopt;
  LoneBias lone;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (k == least) continue;
    lone.others.push_back(estimate(k).parameter.name);
    if (left[k] > left[least] + kBeaten) continue;
    if (estimate(k).parameter.effect != estimate(least).parameter.effect) return std::nullopt;
    lone.instead.push_back({static_cast<std::size_t>(encoders[static_cast<std::size_t>(k)]), gain[k]});
  }
  lone.joint = static_cast<std::size_t>(encoders[static_cast<std::size_t>(least)]);
  lone.off = score[least] / information(least, least);
  lone.stderr_value = 1.0 / std::sqrt(information(least, least));
  off[least] -= lone.off;
  if (are_pivots) lone.turned_rad = of_all.dot(off) / of_all.sum();
  return lone;
}

}  // namespace odolab
