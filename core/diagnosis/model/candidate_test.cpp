// The efficient score of what the joint model does not hold yet.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/model/joint_model.h"
#include "core/diagnosis/model/scanned_products.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFewestToValidate = 4.0;  // batches

}  // namespace

int JointModel::batch_samples() const {
  int samples = 0;
  for (const LinearisedRun& l : now_->runs) samples += l.samples();
  return std::max(1, samples / kBatches);
}

VectorXd JointModel::inflation_of_columns() const {
  const MatrixXd cov = covariance();
  const VectorXd left = cov * zr_;  // what the last step of the fit did not take
  const int batch = batch_samples(), q = columns();
  VectorXd scatter = VectorXd::Zero(q), info = VectorXd::Zero(q), square = VectorXd::Zero(q);
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const VectorXd res = residual_[r] - now_->z[r] * now_->acting(r, left);
    MatrixXd of_acting(now_->z[r].cols(), q);
    for (Eigen::Index c = 0; c < of_acting.rows(); ++c)
      of_acting.row(c) = cov.row(now_->columns[r][static_cast<std::size_t>(c)]);
    const MatrixXd influence = now_->z[r] * of_acting;
    const int n = now_->runs[r].samples();
    for (int from = 0; from < n; from += batch) {
      const int rows = 3 * (std::min(n, from + batch) - from);
      const VectorXd u = influence.middleRows(3 * from, rows).transpose() * res.segment(3 * from, rows);
      const VectorXd i = influence.middleRows(3 * from, rows).colwise().squaredNorm().transpose();
      scatter += u.cwiseAbs2();
      info += i;
      square += i.cwiseAbs2();
    }
  }
  VectorXd inflation = VectorXd::Ones(q);
  for (int c = 0; c < q; ++c) {
    if (info(c) <= 0.0 || square(c) <= 0.0) continue;
    const double count = info(c) * info(c) / square(c);
    inflation(c) = shrunk_inflation(unbiased_scatter(scatter(c) / info(c), count), count, batches_believed_white());
  }
  return inflation;
}

MatrixXd JointModel::absorbed(const CandidateColumns& c) const { return gram_.ldlt().solve(products_of(c).with_model); }

CandidateColumns JointModel::columns_of(const Effect& effect, const std::vector<double>& shape) const {
  CandidateColumns out;
  out.amplitudes = static_cast<int>(effect.amplitudes.size());
  out.of_run.resize(runs_.size());
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (effect.of_one_recording && static_cast<int>(shape[0]) != static_cast<int>(r)) continue;
    const int n = now_->runs[r].samples();
    CandidateColumns::OfRun& of = out.of_run[r];
    if (effect.clock_rate) {
      of.acting = {static_cast<int>(effect.clock_amplitude(numbers_[r]))};
      of.stretch = {0, n};
      of.z.resize(3 * n, 1);
      now_->runs[r].of_clock_rate(of.z.data());
      continue;
    }
    const std::vector<Motions> motions = effect.motions(now_->views[r], shape);
    of.z.resize(3 * n, static_cast<Eigen::Index>(
                           std::count_if(motions.begin(), motions.end(), [](const Motions& m) { return !m.empty(); })));
    std::vector<Stretch> part;
    Stretch all{n, 0};
    for (std::size_t j = 0; j < motions.size(); ++j) {
      if (motions[j].empty()) continue;
      const Stretch p = now_->runs[r].of_motion(motions[j], of.z.col(static_cast<Eigen::Index>(part.size())).data());
      if (p.last <= p.first) continue;
      part.push_back(p);
      of.acting.push_back(static_cast<int>(j));
      all = {std::min(all.first, p.first), std::max(all.last, p.last)};
    }
    if (part.empty()) {
      of.z.resize(0, 0);
      continue;
    }
    for (std::size_t j = 0; j < part.size(); ++j) {
      auto column = of.z.col(static_cast<Eigen::Index>(j));
      column.segment(3 * all.first, 3 * (part[j].first - all.first)).setZero();
      column.segment(3 * part[j].last, 3 * (all.last - part[j].last)).setZero();
    }
    of.stretch = all;
    const auto acting = static_cast<Eigen::Index>(part.size());
    if (all.last - all.first < n || acting < of.z.cols())
      of.z = of.z.block(3 * all.first, 0, 3 * (all.last - all.first), acting).eval();
  }
  return out;
}

JointModel::Absorbing JointModel::absorbing(int without) const {
  Absorbing by;
  by.taken = VectorXd::Zero(gram_.rows());
  int at = first_amplitude();
  for (int j = 0; j < at; ++j) by.kept.push_back(j);
  for (std::size_t a = 0; a < accepted.size(); ++a)
    for (double v : accepted[a].value) {
      if (without == kAll || static_cast<int>(a) == without)
        by.taken(at) = v;
      else
        by.kept.push_back(at);
      ++at;
    }
  const VectorXd zr = zr_ + gram_ * by.taken;
  MatrixXd gram(by.kept.size(), by.kept.size());
  VectorXd zk(by.kept.size());
  for (std::size_t i = 0; i < by.kept.size(); ++i) {
    for (std::size_t j = 0; j < by.kept.size(); ++j) gram(i, j) = gram_(by.kept[i], by.kept[j]);
    zk(i) = zr(by.kept[i]);
  }
  // That only ratios show was found while an effect may have been missing: what could be the mean radius, which a
  // vehicle's file has to 3 %, is no effect.
  constexpr double kOfFile = 0.1 / 0.03;
  if (mean_radius_is_held_) gram.topLeftCorner<2, 2>() -= (kMeanRadiusHeld - kOfFile * kOfFile) * of_mean_radius();
  by.gram.compute(gram);
  by.step = by.gram.solve(zk);
  return by;
}

CandidateTest JointModel::tested(const Absorbing& by, CandidateProducts products, const AskedHow& how,
                                 MatrixXd* absorbed) {
  CandidateTest out;
  const MatrixXd& info = products.with_itself;
  const int k = static_cast<int>(info.rows());
  out.freedom = k;
  if (k == 0) return out;
  VectorXd& score = products.with_residual;
  score += products.with_model.transpose() * by.taken;
  MatrixXd b(by.kept.size(), k);
  for (std::size_t i = 0; i < by.kept.size(); ++i) b.row(i) = products.with_model.row(by.kept[i]);
  const MatrixXd beta = by.gram.solve(b);  // the part that calibration absorbs
  const MatrixXd effective = info - b.transpose() * beta;
  const VectorXd s = score - b.transpose() * by.step;
  if (absorbed) *absorbed = beta;
  if (info.trace() <= 0.0) return out;
  out.survives = 1.0;
  for (int j = 0; j < k; ++j)
    out.survives = std::min(out.survives, info(j, j) > 0.0 ? effective(j, j) / info(j, j) : 0.0);
  // Directions that do not survive are left out of the test.
  if (k == 1) {  // as below
    const double share = effective(0, 0) / info(0, 0), scale = 1.0 / std::sqrt(info(0, 0));
    const bool survives = share >= how.least_surviving;
    out.statistic = survives ? scale * s(0) * (scale * s(0)) / share : 0.0;
    out.freedom = 1;
    out.value = {survives ? scale * (scale * s(0) / share) : 0.0};
    out.stderr_value = {scale * std::sqrt(survives ? 1.0 / share : 1e6)};
    return out;
  }
  VectorXd scale(k);
  for (int j = 0; j < k; ++j) scale(j) = info(j, j) > 0.0 ? 1.0 / std::sqrt(info(j, j)) : 0.0;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(scale.asDiagonal() * effective * scale.asDiagonal());
  const VectorXd su = eig.eigenvectors().transpose() * (scale.asDiagonal() * s);
  constexpr double kMostlyLeft = 0.25, kSeen = 9.0;  // of its information; of chi-square, three standard errors
  VectorXd w = VectorXd::Zero(k), drawn = VectorXd::Zero(k), drawn_variance = VectorXd::Zero(k);
  MatrixXd cov = MatrixXd::Zero(k, k);
  int freedom = 0;
  for (int j = 0; j < k; ++j) {
    const double e = eig.eigenvalues()(j);
    if (e < how.least_surviving) {
      cov += 1e6 * eig.eigenvectors().col(j) * eig.eigenvectors().col(j).transpose();
      continue;
    }
    ++freedom;
    w += su(j) / e * eig.eigenvectors().col(j);
    cov += eig.eigenvectors().col(j) * eig.eigenvectors().col(j).transpose() / e;
    out.statistic += su(j) * su(j) / e;
    if (!how.is_drawn || (e < kMostlyLeft && su(j) * su(j) / e < kSeen)) continue;
    drawn += su(j) / e * eig.eigenvectors().col(j);
    drawn_variance += eig.eigenvectors().col(j).cwiseAbs2() / e;
  }
  out.freedom = std::max(1, freedom);
  const VectorXd value = scale.asDiagonal() * w;
  out.value.assign(value.data(), value.data() + k);
  for (int j = 0; j < k; ++j) {
    out.stderr_value.push_back(scale(j) * std::sqrt(cov(j, j)));
    if (!how.is_drawn) continue;
    out.drawn_value.push_back(scale(j) * drawn(j));
    out.drawn_stderr.push_back(scale(j) * std::sqrt(drawn_variance(j)));
  }
  return out;
}

CandidateProducts JointModel::products_of(const CandidateColumns& c) const {
  const Eigen::Index k = c.amplitudes, q = gram_.rows();
  CandidateProducts products{MatrixXd::Zero(k, k), MatrixXd::Zero(q, k), VectorXd::Zero(k)};
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const auto& [acting, z, stretch] = c.of_run[r];
    if (acting.empty()) continue;
    const Eigen::Index from = 3 * stretch.first;
    const MatrixXd with_itself = z.transpose() * z;
    const MatrixXd with_model = now_->z[r].middleRows(from, z.rows()).transpose() * z;
    const VectorXd with_residual = z.transpose() * residual_[r].segment(from, z.rows());
    for (std::size_t i = 0; i < acting.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      for (std::size_t j = 0; j < acting.size(); ++j)
        products.with_itself(acting[i], acting[j]) += with_itself(at, static_cast<Eigen::Index>(j));
      for (std::size_t m = 0; m < now_->columns[r].size(); ++m)
        products.with_model(now_->columns[r][m], acting[i]) += with_model(static_cast<Eigen::Index>(m), at);
      products.with_residual(acting[i]) += with_residual(at);
    }
  }
  return products;
}

class JointModel::Asked {
 public:
  Absorbing by;
  std::vector<VectorXd> residual;  // of each run, with all that is kept at its best
};

std::shared_ptr<const JointModel::Asked> JointModel::asked(int without) const {
  const auto out = std::make_shared<Asked>();
  out->by = absorbing(without);
  VectorXd gone = -out->by.taken;
  for (std::size_t i = 0; i < out->by.kept.size(); ++i)
    gone(out->by.kept[i]) += out->by.step(static_cast<Eigen::Index>(i));
  for (std::size_t r = 0; r < runs_.size(); ++r)
    out->residual.push_back(residual_[r] - now_->z[r] * now_->acting(r, gone));
  return out;
}

CandidateTest JointModel::test(const CandidateColumns& c, int without, bool thorough) const {
  if (thorough) return tested_thoroughly(*asked(without), products_of(c), c);
  return tested(absorbing(without), products_of(c), c.how, nullptr);
}

std::vector<CandidateTest> JointModel::tests(const CandidateColumns& c,
                                             const std::vector<std::shared_ptr<const Asked>>& against) const {
  const CandidateProducts products = products_of(c);
  std::vector<CandidateTest> out;
  for (const std::shared_ptr<const Asked>& by : against) out.push_back(tested_thoroughly(*by, products, c));
  return out;
}

CandidateTest JointModel::tested_thoroughly(const Asked& asked, CandidateProducts products,
                                            const CandidateColumns& c) const {
  MatrixXd absorbed;
  CandidateTest out = tested(asked.by, std::move(products), c.how, &absorbed);
  if (out.statistic <= 0.0) return out;
  const ScoreByBatches by_batches = score_by_batches(asked, c, out, absorbed);
  if (by_batches.u.empty()) return out;
  const double prior = c.how.scatters_as_its_like ? batches_believed_white() : kFewestBatchesBelieved;
  out.inflation = by_batches.inflation(prior);
  out.batches = prior + by_batches.count;
  // A single kick of a castor is not fitted on one half and tried on the other.
  out.cross_validated = by_batches.count < kFewestToValidate ? out.statistic : by_batches.cross_validated();
  return out;
}

ScoreByBatches JointModel::score_by_batches(const Asked& asked, const CandidateColumns& c, const CandidateTest& test,
                                            const MatrixXd& absorbed) const {
  const VectorXd value = Eigen::Map<const VectorXd>(test.value.data(), c.amplitudes), of_kept = absorbed * value;
  VectorXd of_model = VectorXd::Zero(gram_.rows());
  for (std::size_t i = 0; i < asked.by.kept.size(); ++i)
    of_model(asked.by.kept[i]) = of_kept(static_cast<Eigen::Index>(i));
  ScoreByBatches out;
  const int batch = batch_samples();
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const VectorXd column = beside_model(static_cast<int>(r), c, value, of_model);
    const int n = now_->runs[r].samples();
    for (int from = 0; from < n; from += batch) {
      const int rows = 3 * (std::min(n, from + batch) - from);
      out.add(column.segment(3 * from, rows).dot(asked.residual[r].segment(3 * from, rows)),
              column.segment(3 * from, rows).squaredNorm());
    }
  }
  out.finish();
  return out;
}

double JointModel::batches_believed_white() const {
  std::call_once(white_->once, [&] {
    std::vector<ScoreByBatches> scores;
    const std::shared_ptr<const Asked> asked_now = asked();
    for (const Effect& e : catalogue()) {
      if (e.local || e.only_commands || e.scan || e.forms.size() > 1) continue;
      const CandidateColumns c = columns_of(e, {});
      MatrixXd absorbed;
      const CandidateTest test = tested(asked_now->by, products_of(c), c.how, &absorbed);
      if (test.statistic > 0.0) scores.push_back(score_by_batches(*asked_now, c, test, absorbed));
    }
    white_->batches = batches_of_prior(scores);
  });
  return white_->batches;
}

VectorXd JointModel::beside_model(int run, const CandidateColumns& c, const VectorXd& value,
                                  const VectorXd& of_model) const {
  const auto r = static_cast<std::size_t>(run);
  VectorXd column = -(now_->z[r] * now_->acting(r, of_model));
  const auto& [acting, z, stretch] = c.of_run[r];
  if (!acting.empty()) column.segment(3 * stretch.first, z.rows()).noalias() += z * value(acting);
  return column;
}

VectorXd JointModel::beside_all_else(int accepted) const {
  const Absorbing by = absorbing(accepted);
  const VectorXd with_all = gram_ * by.taken;
  VectorXd with_kept(by.kept.size());
  for (std::size_t i = 0; i < by.kept.size(); ++i) with_kept(static_cast<Eigen::Index>(i)) = with_all(by.kept[i]);
  const VectorXd absorbed = by.gram.solve(with_kept);
  VectorXd out = by.taken;
  for (std::size_t i = 0; i < by.kept.size(); ++i) out(by.kept[i]) -= absorbed(static_cast<Eigen::Index>(i));
  return out;
}

std::vector<std::vector<SampleEvidence>> JointModel::evidence_of(int accepted_effect) const {
  const VectorXd alone = beside_all_else(accepted_effect), to_best = gram_.ldlt().solve(zr_);
  std::vector<std::vector<SampleEvidence>> all;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const VectorXd trace = now_->z[r] * now_->acting(r, alone);
    const VectorXd left = residual_[r] - now_->z[r] * now_->acting(r, to_best);
    const std::vector<FilterStep>& steps = now_->runs[r].steps();
    const TwoClocks own = clocks(static_cast<int>(r));
    std::vector<SampleEvidence>& of_run = all.emplace_back();
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (!steps[i].used || steps[i].truth_index < 0) continue;
      const auto of = trace.segment<3>(3 * static_cast<Eigen::Index>(i));
      of_run.push_back({own.wheels_stamp_s(runs_[r].truth[steps[i].truth_index].time_s),
                        of.dot(left.segment<3>(3 * static_cast<Eigen::Index>(i))), of.squaredNorm()});
    }
  }
  return all;
}

namespace {

// (sum |a| |b|)^2 / sum a^2, of samples of three innovations each.
class Leak {
 public:
  void add(const VectorXd& a, const VectorXd& b) {
    for (Eigen::Index i = 0; i + 3 <= a.size(); i += 3) {
      both_ += a.segment<3>(i).norm() * b.segment<3>(i).norm();
      a2_ += a.segment<3>(i).squaredNorm();
    }
  }
  double value() const { return a2_ > 0.0 ? both_ * both_ / a2_ : 0.0; }

 private:
  double both_ = 0.0, a2_ = 0.0;
};

}  // namespace

double JointModel::can_look_like(const CandidateColumns& candidate, const std::vector<double>& value,
                                 int accepted) const {
  const VectorXd amplitudes = Eigen::Map<const VectorXd>(value.data(), candidate.amplitudes);
  const VectorXd of_model = absorbed(candidate) * amplitudes, own = absorbing(accepted).taken;
  Leak leak;
  for (std::size_t r = 0; r < runs_.size(); ++r)
    leak.add(beside_model(static_cast<int>(r), candidate, amplitudes, of_model), now_->z[r] * now_->acting(r, own));
  return leak.value();
}

double JointModel::can_look_like(int other_accepted, int accepted) const {
  const VectorXd other = beside_all_else(other_accepted), own = absorbing(accepted).taken;
  Leak leak;
  for (std::size_t r = 0; r < runs_.size(); ++r)
    leak.add(now_->z[r] * now_->acting(r, other), now_->z[r] * now_->acting(r, own));
  return leak.value();
}

double JointModel::scatter_about(int run, double time_s, const CandidateColumns& candidate,
                                 const std::vector<double>& value) const {
  constexpr double kAbout_s = 1.0, kWhereItHappens_s = 0.3;
  constexpr double kChance = 3.0;  // standard deviations of a mean of squares
  constexpr int kFewest = 12;      // scalars
  const auto r = static_cast<std::size_t>(run);
  const VectorXd amplitudes = Eigen::Map<const VectorXd>(value.data(), candidate.amplitudes);
  const VectorXd left = residual_[r] - beside_model(run, candidate, amplitudes, absorbed(candidate) * amplitudes);
  const std::vector<FilterStep>& steps = now_->runs[r].steps();
  const TwoClocks own = clocks(run);
  double sum = 0.0;
  int scalars = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!steps[i].used || steps[i].truth_index < 0) continue;
    const double away_s = std::abs(own.wheels_stamp_s(runs_[r].truth[steps[i].truth_index].time_s) - time_s);
    if (away_s > kAbout_s || away_s < kWhereItHappens_s) continue;
    sum += left.segment<3>(3 * static_cast<Eigen::Index>(i)).squaredNorm();
    scalars += runs_[r].truth_has_heading ? 3 : 2;
  }
  if (scalars < kFewest) return 1.0;
  const double scatter = sum / scalars;
  return scatter > 1.0 + kChance * std::sqrt(2.0 / scalars) ? scatter : 1.0;
}

std::shared_ptr<ScannedProducts> JointModel::scanned_products() const {
  if (!scanned_)
    scanned_ = std::make_shared<ScannedProducts>(now_->views, now_->runs, now_->columns, now_->z, residual_,
                                                 static_cast<int>(gram_.rows()));
  return scanned_;
}

std::vector<BodyMotion> JointModel::score_of_motions(int run) const {
  const VectorXd left =
      residual_[run] - now_->z[run] * now_->acting(static_cast<std::size_t>(run), gram_.ldlt().solve(zr_));
  return now_->runs[run].score_of_motions(left.data());
}

}  // namespace odolab
