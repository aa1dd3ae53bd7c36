#include "core/diagnosis/naming/shape_likelihood.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/calibration/minimise.h"
#include "core/diagnosis/model/candidate_scan.h"
#include "core/diagnosis/naming/intervals.h"
#include "core/diagnosis/naming/shape_search.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRounds = 4, kSamples = 40;
constexpr double kWorst = 1e12;  // stands for a shape that cannot be

// Twice the log-likelihood that a shape loses against none, negative: lower is better. `value`: its amplitudes, where
// it is one.
double misfit(const CandidateScan& scan, const Effect& e, const std::vector<double>& shape,
              std::vector<double>* value = nullptr) {
  for (std::size_t k = 0; k < e.shapes.size(); ++k)
    if (shape[k] < e.shapes[k].low || shape[k] > e.shapes[k].high) return kWorst;
  const CandidateTest t = scan.test(e, shape);
  if (t.value.empty()) return kWorst;
  for (std::size_t k = 0; k < t.value.size(); ++k)
    if (t.value[k] < e.amplitudes[k].low || t.value[k] > e.amplitudes[k].high) return 0.0;
  if (value) *value = t.value;
  return -t.statistic;
}

struct Sample {
  VectorXd at;
  double misfit = 0.0;
  std::vector<double> value;
};

MatrixXd amplitudes_of(const std::vector<Sample>& samples, const std::vector<double>& weight, Eigen::Index n) {
  VectorXd mean = VectorXd::Zero(n);
  MatrixXd square = MatrixXd::Zero(n, n);
  double sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (static_cast<Eigen::Index>(samples[i].value.size()) != n) continue;
    const VectorXd value = Eigen::Map<const VectorXd>(samples[i].value.data(), n);
    sum += weight[i];
    mean += weight[i] * value;
    square += weight[i] * value * value.transpose();
  }
  if (sum <= 0.0) return MatrixXd::Zero(n, n);
  mean /= sum;
  return square / sum - mean * mean.transpose();
}

// Normal density up to a factor, with the lower Cholesky factor of its covariance.
double log_density(const VectorXd& x, const VectorXd& mean, const MatrixXd& root) {
  const VectorXd z = root.triangularView<Eigen::Lower>().solve(x - mean);
  return -0.5 * z.squaredNorm() - root.diagonal().array().log().sum();
}

}  // namespace

double first_stride(const Effect& e, int entry, double value) {
  const std::string &unit = e.shapes[entry].unit, &name = e.shapes[entry].name;
  if (name == "lasts_s") return 0.05;
  if (unit == "s") return e.local ? 0.1 : 3.0;
  if (name == "radius_m") return 0.25 * std::abs(value);
  if (unit == "m") return 0.2;
  return std::max(0.15 * std::abs(value), 1e-6);
}

ShapeLikelihood shape_likelihood(const JointModel& joint, int accepted, double inflation) {
  const AcceptedEffect& a = joint.accepted[static_cast<std::size_t>(accepted)];
  const CandidateScan scan(joint, accepted);
  const std::vector<int> free = free_shapes(*a.effect);
  const int m = static_cast<int>(free.size());
  ShapeLikelihood out;
  out.best = out.mean = a.shape;
  out.covariance = MatrixXd::Zero(m, m);
  VectorXd stride(m);
  for (int k = 0; k < m; ++k) stride(k) = first_stride(*a.effect, free[k], a.shape[free[k]]);
  const auto shape_at = [&](const VectorXd& x, const std::vector<double>& about) {
    std::vector<double> shape = about;
    for (int k = 0; k < m; ++k) shape[free[k]] += stride(k) * x(k);
    return shape;
  };

  // Climb, in units of the strides; twice, since a simplex may come to rest on a step.
  double best = misfit(scan, *a.effect, a.shape);
  for (double size : {1.0, 0.3}) {
    const std::vector<double> from = out.best;
    const std::vector<double> at = minimised(
        [&](const std::vector<double>& x) {
          return misfit(scan, *a.effect, shape_at(Eigen::Map<const VectorXd>(x.data(), m), from));
        },
        std::vector<double>(m, 0.0), size, 0.02, 20 + 15 * m);
    const std::vector<double> shape = shape_at(Eigen::Map<const VectorXd>(at.data(), m), from);
    if (const double value = misfit(scan, *a.effect, shape); value < best) best = value, out.best = shape;
  }

  // How wide it is along each entry: where it has lost about two.
  const std::vector<double> centre = out.best;
  MatrixXd root = MatrixXd::Zero(m, m);
  std::vector<double> width(m);
  parallel_for(m, [&](int k) {
    double w = 0.1;
    const auto lost = [&](double by) {
      VectorXd x = VectorXd::Zero(m);
      x(k) = by;
      const double up = misfit(scan, *a.effect, shape_at(x, centre)) - best;
      x(k) = -by;
      return std::min(up, misfit(scan, *a.effect, shape_at(x, centre)) - best) / inflation;
    };
    if (lost(w) < 1.0)
      while (w < 3.0 && lost(2.0 * w) < 1.0) w *= 2.0;
    else
      while (w > 1e-3 && lost(w) > 2.0) w *= 0.5;
    width[k] = w;
  });
  // A patch is also moved and widened at once, so that one rim stays where it is: what each entry loses by itself says
  // too little of that.
  constexpr double kPatchToBeginWith = 0.5;
  for (int k = 0; k < m; ++k) root(k, k) = is_a_patch(*a.effect) ? std::max(width[k], kPatchToBeginWith) : width[k];

  std::vector<Sample> samples;
  std::vector<std::pair<VectorXd, MatrixXd>> proposals;  // mean and root
  VectorXd mean = VectorXd::Zero(m);
  Random random(20240601);
  MatrixXd covariance = MatrixXd::Zero(m, m);
  for (int round = 0; round < kRounds; ++round) {
    proposals.emplace_back(mean, root);
    const std::size_t from = samples.size();
    for (int i = 0; i < kSamples; ++i) {
      VectorXd z(m);
      for (int k = 0; k < m; ++k) z(k) = random.normal();
      samples.push_back({mean + root * z, 0.0, {}});
    }
    parallel_for(kSamples, [&](int i) {
      Sample& s = samples[from + static_cast<std::size_t>(i)];
      s.misfit = misfit(scan, *a.effect, shape_at(s.at, centre), &s.value);
    });
    for (std::size_t i = from; i < samples.size(); ++i)
      if (samples[i].misfit < best) best = samples[i].misfit, out.best = shape_at(samples[i].at, centre);
    // Weights against the mixture of all that was proposed; tempered until several samples count.
    std::vector<double> log_proposed(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      double sum = 0.0;
      for (const auto& [middle, r] : proposals) sum += std::exp(log_density(samples[i].at, middle, r));
      log_proposed[i] = std::log(std::max(sum, 1e-300));
    }
    std::vector<double> weight(samples.size());
    const auto weigh = [&](double temper) {
      double most = -1e300, sum = 0.0;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        weight[i] = temper * (-0.5 * (samples[i].misfit - best) / inflation) - log_proposed[i];
        if (samples[i].misfit >= kWorst) weight[i] = -1e300;
        most = std::max(most, weight[i]);
      }
      for (double& w : weight) sum += w = std::exp(w - most);
      for (double& w : weight) w /= sum;
    };
    const auto several_count = [&] {
      double squares = 0.0;
      for (double w : weight) squares += w * w;
      return 1.0 > 6.0 * (m + 1) * squares;
    };
    double temper = 1.0;
    for (weigh(temper); !several_count() && temper > 0.03; weigh(temper)) temper *= 0.6;
    // Where none is wide enough one sample far out, where hardly any were proposed, lies on the same step: it may not
    // count for many (truncated importance sampling: E. L. Ionides, J. Comput. Graph. Stat. 17 (2008) 295).
    if (!several_count()) {
      weigh(1.0);
      const double largest = 1.0 / std::sqrt(static_cast<double>(weight.size()));
      double sum = 0.0;
      for (double& w : weight) sum += w = std::min(w, largest);
      for (double& w : weight) w /= sum;
    }
    mean.setZero();
    for (std::size_t i = 0; i < samples.size(); ++i) mean += weight[i] * samples[i].at;
    covariance.setZero();
    for (std::size_t i = 0; i < samples.size(); ++i)
      covariance += weight[i] * (samples[i].at - mean) * (samples[i].at - mean).transpose();
    out.of_amplitudes = amplitudes_of(samples, weight, static_cast<Eigen::Index>(a.value.size()));
    const MatrixXd wider = 1.5 * covariance + 1e-8 * MatrixXd::Identity(m, m);
    root = wider.llt().matrixL();
  }
  out.mean = shape_at(mean, centre);
  out.covariance = stride.asDiagonal() * covariance * stride.asDiagonal();
  out.lost = misfit(scan, *a.effect, out.mean) - best;
  return out;
}

}  // namespace odolab
