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

constexpr int kSamplingRounds = 4, kSamples = 40;
constexpr double kImpossible = 1e12;  // stands for a shape that cannot be

// The likelihood over the free entries of an effect's shape, in units of strides; all else is fitted anew.
struct Profile {
  const Effect& effect;
  CandidateScan scan;
  std::vector<int> free;
  VectorXd stride;

  Profile(const JointModel& joint, int accepted)
      : effect(*joint.accepted[static_cast<std::size_t>(accepted)].effect),
        scan(joint, accepted),
        free(free_shapes(effect)),
        stride(size()) {
    for (int k = 0; k < size(); ++k)
      stride(k) = first_stride(effect, free[k], joint.accepted[static_cast<std::size_t>(accepted)].shape[free[k]]);
  }
  int size() const { return static_cast<int>(free.size()); }

  std::vector<double> shape(const VectorXd& x, const std::vector<double>& about) const {
    std::vector<double> shape = about;
    for (int k = 0; k < size(); ++k) shape[free[k]] += stride(k) * x(k);
    return shape;
  }

  // Twice the log-likelihood that a shape loses against none, negative: lower is better. `value`: its amplitudes, where
  // it is one.
  double misfit(const std::vector<double>& shape, std::vector<double>* value = nullptr) const {
    for (std::size_t k = 0; k < effect.shapes.size(); ++k)
      if (shape[k] < effect.shapes[k].low || shape[k] > effect.shapes[k].high) return kImpossible;
    const CandidateTest t = scan.test(effect, shape);
    if (t.value.empty()) return kImpossible;
    for (std::size_t k = 0; k < t.value.size(); ++k)
      if (t.value[k] < effect.amplitudes[k].low || t.value[k] > effect.amplitudes[k].high) return 0.0;
    if (value) *value = t.value;
    return -t.statistic;
  }
};

// Twice, since a simplex may come to rest on a step.
std::vector<double> climbed(const Profile& profile, const std::vector<double>& start) {
  const int m = profile.size();
  std::vector<double> best = start;
  double least = profile.misfit(best);
  for (double size : {1.0, 0.3}) {
    const std::vector<double> from = best;
    const auto shape_at = [&](const std::vector<double>& x) {
      return profile.shape(Eigen::Map<const VectorXd>(x.data(), m), from);
    };
    const std::vector<double> shape =
        shape_at(minimised([&](const std::vector<double>& x) { return profile.misfit(shape_at(x)); },
                           std::vector<double>(static_cast<std::size_t>(m), 0.0), size, 0.02, 20 + 15 * m));
    if (const double value = profile.misfit(shape); value < least) least = value, best = shape;
  }
  return best;
}

// How wide it is along each entry: where it has lost about two.
VectorXd widths(const Profile& profile, const std::vector<double>& centre, double best, double inflation) {
  const int m = profile.size();
  VectorXd width(m);
  parallel_for(m, [&](int k) {
    double w = 0.1;
    const auto lost = [&](double by) {
      const VectorXd x = by * VectorXd::Unit(m, k);
      return (std::min(profile.misfit(profile.shape(x, centre)), profile.misfit(profile.shape(-x, centre))) - best) /
             inflation;
    };
    if (lost(w) < 1.0)
      while (w < 3.0 && lost(2.0 * w) < 1.0) w *= 2.0;
    else
      while (w > 1e-3 && lost(w) > 2.0) w *= 0.5;
    width(k) = w;
  });
  // A patch is also moved and widened at once, so that one rim stays where it is: what each entry loses by itself says
  // too little of that.
  constexpr double kPatchToBeginWith = 0.5;
  return is_a_patch(profile.effect) ? width.cwiseMax(kPatchToBeginWith) : width;
}

struct ShapeSample {
  VectorXd at;
  double misfit = 0.0;
  std::vector<double> value;
};

MatrixXd amplitudes_of(const std::vector<ShapeSample>& samples, const std::vector<double>& weight, Eigen::Index n) {
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

// A normal density by its mean and the lower Cholesky factor of its covariance.
struct Proposal {
  VectorXd mean;
  MatrixXd root;

  // Up to a factor.
  double log_density(const VectorXd& x) const {
    const VectorXd z = root.triangularView<Eigen::Lower>().solve(x - mean);
    return -0.5 * z.squaredNorm() - root.diagonal().array().log().sum();
  }
};

void put_to_one(std::vector<double>& weight) {
  double sum = 0.0;
  for (double w : weight) sum += w;
  for (double& w : weight) w /= sum;
}

// Against the mixture of all that was proposed; tempered until several samples count. `best`: the least misfit.
std::vector<double> weights_of(const std::vector<ShapeSample>& samples, const std::vector<Proposal>& proposals,
                               double best, double inflation) {
  std::vector<double> log_proposed(samples.size()), weight(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double sum = 0.0;
    for (const Proposal& p : proposals) sum += std::exp(p.log_density(samples[i].at));
    log_proposed[i] = std::log(std::max(sum, 1e-300));
  }
  const auto weigh = [&](double temper) {
    double most = -1e300;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      weight[i] = temper * (-0.5 * (samples[i].misfit - best) / inflation) - log_proposed[i];
      if (samples[i].misfit >= kImpossible) weight[i] = -1e300;
      most = std::max(most, weight[i]);
    }
    for (double& w : weight) w = std::exp(w - most);
    put_to_one(weight);
  };
  const auto several_count = [&] {
    double squares = 0.0;
    for (double w : weight) squares += w * w;
    return 1.0 > 6.0 * (static_cast<double>(samples.front().at.size()) + 1.0) * squares;
  };
  double temper = 1.0;
  for (weigh(temper); !several_count() && temper > 0.03; weigh(temper)) temper *= 0.6;
  if (several_count()) return weight;
  // Where none is wide enough one sample far out, where hardly any were proposed, lies on the same step: it may not
  // count for many (truncated importance sampling: E. L. Ionides, J. Comput. Graph. Stat. 17 (2008) 295).
  weigh(1.0);
  const double largest = 1.0 / std::sqrt(static_cast<double>(weight.size()));
  for (double& w : weight) w = std::min(w, largest);
  put_to_one(weight);
  return weight;
}

}  // namespace

double first_stride(const Effect& e, int entry, double value) {
  const std::string &unit = e.shapes[entry].unit, &name = e.shapes[entry].name;
  if (name == "lasts_s") return 0.05;
  if (unit == "s") return e.local ? 0.1 : 3.0;
  if (is_extent(e.shapes[entry])) return 0.25 * std::abs(value);
  if (name == "direction_rad") return 0.2;
  if (unit == "m") return 0.2;
  return std::max(0.15 * std::abs(value), 1e-6);
}

ShapeLikelihood shape_likelihood(const JointModel& joint, int accepted, double inflation) {
  const AcceptedEffect& a = joint.accepted[static_cast<std::size_t>(accepted)];
  const Profile profile(joint, accepted);
  const int m = profile.size();
  ShapeLikelihood out;
  const std::vector<double> centre = out.best = climbed(profile, a.shape);
  double best = profile.misfit(centre);

  MatrixXd root = widths(profile, centre, best, inflation).asDiagonal();
  VectorXd mean = VectorXd::Zero(m);
  MatrixXd covariance = MatrixXd::Zero(m, m);
  std::vector<ShapeSample> samples;
  std::vector<Proposal> proposals;
  Random random(20240601);
  for (int round = 0; round < kSamplingRounds; ++round) {
    proposals.push_back({mean, root});
    const std::size_t from = samples.size();
    for (int i = 0; i < kSamples; ++i) {
      VectorXd z(m);
      for (int k = 0; k < m; ++k) z(k) = random.normal();
      samples.push_back({mean + root * z, 0.0, {}});
    }
    parallel_for(kSamples, [&](int i) {
      ShapeSample& s = samples[from + static_cast<std::size_t>(i)];
      s.misfit = profile.misfit(profile.shape(s.at, centre), &s.value);
    });
    for (std::size_t i = from; i < samples.size(); ++i)
      if (samples[i].misfit < best) best = samples[i].misfit, out.best = profile.shape(samples[i].at, centre);

    const std::vector<double> weight = weights_of(samples, proposals, best, inflation);
    mean.setZero();
    for (std::size_t i = 0; i < samples.size(); ++i) mean += weight[i] * samples[i].at;
    covariance.setZero();
    for (std::size_t i = 0; i < samples.size(); ++i)
      covariance += weight[i] * (samples[i].at - mean) * (samples[i].at - mean).transpose();
    out.of_amplitudes = amplitudes_of(samples, weight, static_cast<Eigen::Index>(a.value.size()));
    const MatrixXd wider = 1.5 * covariance + 1e-8 * MatrixXd::Identity(m, m);
    root = wider.llt().matrixL();
  }
  out.mean = profile.shape(mean, centre);
  out.covariance = profile.stride.asDiagonal() * covariance * profile.stride.asDiagonal();
  out.lost = profile.misfit(out.mean) - best;
  return out;
}

}  // namespace odolab
