#include "core/diagnosis/units/together/joined_errors.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/naming/intervals.h"

namespace odolab {

namespace {

// By how much a time can be another until that says less by one, in the mean of both sides.
double stderr_of_time(const JoinedModel& others, const ScoredTogether& s, std::size_t shape, double believed_white) {
  constexpr double kLeast_s = 0.05, kMost_s = 3.2;
  double sum_s = 0.0;
  for (double side : {-1.0, 1.0}) {
    double by_s = kLeast_s;
    for (; by_s < kMost_s; by_s *= 2.0) {
      std::vector<double> moved = s.shape;
      moved[shape] += side * by_s;
      const JoinedTest test = others.test(columns_at(others, s.candidate, moved), believed_white);
      const double less = s.test.judged() - test.statistic / s.test.inflation;
      if (less < 1.0) continue;
      by_s /= std::sqrt(less);
      break;
    }
    sum_s += 0.5 * std::max(by_s, kLeast_s);
  }
  return sum_s;
}

}  // namespace

Eigen::MatrixXd joined_covariance(const JoinedModel& others, const ScoredTogether& s, double believed_white) {
  constexpr double kForm = 0.03, kOneOfSeveral = 0.05;
  const Effect& e = *s.candidate.effect;
  Eigen::MatrixXd covariance = s.test.inflation * s.test.covariance;
  const double size = s.test.value.norm();
  covariance.diagonal().array() += std::pow((e.forms.size() > 1 ? kOneOfSeveral : kForm) * size, 2);
  const std::vector<int> free = free_shapes(e);
  const Eigen::Index amplitudes = covariance.rows(), shapes = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(amplitudes + shapes, amplitudes + shapes);
  all.topLeftCorner(amplitudes, amplitudes) = covariance;
  // The scanned shapes that the likelihood does not tell apart say how well a shape is known.
  const std::vector<std::vector<double>> shapes_tried = shapes_of(e, others.views(s.candidate.units.front()));
  for (Eigen::Index f = 0; f < shapes; ++f) {
    double nearest = 1e300;
    const auto k = static_cast<std::size_t>(free[static_cast<std::size_t>(f)]);
    if (e.shapes[k].name == "at_s") {
      all(amplitudes + f, amplitudes + f) = std::pow(stderr_of_time(others, s, k, believed_white), 2);
      continue;
    }
    for (const std::vector<double>& shape : shapes_tried)
      if (std::abs(shape[k] - s.shape[k]) > 1e-9) nearest = std::min(nearest, std::abs(shape[k] - s.shape[k]));
    if (nearest < 1e300) all(amplitudes + f, amplitudes + f) = nearest * nearest;
  }
  return all;
}

}  // namespace odolab
