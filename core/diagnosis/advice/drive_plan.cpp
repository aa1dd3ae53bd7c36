#include "core/diagnosis/advice/drive_plan.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLongestDrive_s = 180.0;
constexpr int kMostDrives = 5;

}  // namespace

double separation(const MatrixXd& information, const Decision& d) {
  const auto m = static_cast<Eigen::Index>(d.free.size()), n = d.value.size();
  MatrixXd rest(m, m), cross(m, n);
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index j = 0; j < m; ++j) rest(i, j) = information(d.free[i], d.free[j]);
    for (Eigen::Index j = 0; j < n; ++j) cross(i, j) = information(d.free[i], d.from + j);
  }
  const MatrixXd own = information.block(d.from, d.from, n, n);
  // Scaled, so that what is not excited at all does no harm.
  VectorXd scale(m);
  for (Eigen::Index i = 0; i < m; ++i) scale(i) = rest(i, i) > 0.0 ? 1.0 / std::sqrt(rest(i, i)) : 0.0;
  const MatrixXd scaled = scale.asDiagonal() * rest * scale.asDiagonal() + 1e-9 * MatrixXd::Identity(m, m);
  const MatrixXd projected = scale.asDiagonal() * cross;
  const MatrixXd left = own - projected.transpose() * scaled.ldlt().solve(projected);
  return std::sqrt(std::max(0.0, d.value.dot(left * d.value)) / d.inflation);
}

DrivePlan planned(const MatrixXd& known, const std::vector<MatrixXd>& adds, const std::vector<AdvisedDrive>& all,
                  const std::vector<Decision>& decisions) {
  DrivePlan plan;
  plan.times.assign(all.size(), 0);
  MatrixXd now = known;
  const auto open = [&](const MatrixXd& i) {
    double sum = 0.0;
    for (const Decision& d : decisions) sum += 1.0 - std::min(1.0, std::pow(separation(i, d) / d.needed, 2));
    return sum;
  };
  double left = open(now);
  for (int step = 0; step < kMostDrives && left > 1e-6; ++step) {
    int best = -1;
    double best_rate = 0.0;
    for (std::size_t m = 0; m < all.size(); ++m) {
      if (plan.duration_s + all[m].duration_s() > kLongestDrive_s) continue;
      const double rate = (left - open(now + adds[m])) / all[m].duration_s();
      if (rate > best_rate) best_rate = rate, best = static_cast<int>(m);
    }
    if (best < 0 || best_rate * all[best].duration_s() < 0.02) break;
    now += adds[best];
    ++plan.times[best];
    plan.duration_s += all[best].duration_s();
    plan.any = true;
    left = open(now);
  }
  for (const Decision& d : decisions) plan.reached.push_back(separation(now, d));
  return plan;
}

std::string in_words(const DrivePlan& plan, const std::vector<AdvisedDrive>& all) {
  std::string s;
  for (std::size_t m = 0; m < all.size(); ++m)
    if (plan.times[m] > 0) {
      s += (s.empty() ? "" : "; and ") + all[m].sentence;
      if (plan.times[m] > 1) s += plan.times[m] == 2 ? ", twice" : formatted(", %d times", plan.times[m]);
    }
  return s + formatted(", %.0f s in all", std::ceil(plan.duration_s));
}

std::vector<DriveLeg> legs_of(const DrivePlan& plan, const std::vector<AdvisedDrive>& all) {
  std::vector<DriveLeg> legs;
  for (std::size_t m = 0; m < all.size(); ++m)
    for (int k = 0; k < plan.times[m]; ++k) legs.insert(legs.end(), all[m].legs.begin(), all[m].legs.end());
  return legs;
}

}  // namespace odolab
