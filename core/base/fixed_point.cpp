#include "core/base/fixed_point.h"

#include <Eigen/QR>

namespace odolab {

Eigen::VectorXd FixedPoint::next(const Eigen::VectorXd& at, const Eigen::VectorXd& to) {
  const Eigen::VectorXd step = to - at;
  Eigen::VectorXd x = to;
  if (last_step_.size() > 0) {
    constexpr std::size_t kMost = 5;
    if (changes_.size() == kMost) changes_.erase(changes_.begin());
    changes_.push_back({to - last_to_, step - last_step_});
    const auto m = static_cast<Eigen::Index>(changes_.size());
    Eigen::MatrixXd of_step(step.size(), m), of_to(step.size(), m);
    for (Eigen::Index k = 0; k < m; ++k) {
      of_to.col(k) = changes_[static_cast<std::size_t>(k)].of_to;
      of_step.col(k) = changes_[static_cast<std::size_t>(k)].of_step;
    }
    x -= of_to * of_step.colPivHouseholderQr().solve(step);
  }
  last_to_ = to;
  last_step_ = step;
  return x;
}

}  // namespace odolab
