#include "core/diagnosis/units/together/joined_model.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/diagnosis/naming/select.h"
#include "core/diagnosis/units/outside_truth.h"
#include "core/diagnosis/units/unit_models.h"

namespace odolab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWheelPrior = 0.1, kClockPrior_s = 0.2, kScaleHeld = 1e-5;
constexpr double kLeastSurviving = 0.01;
constexpr double kWorthAskingBySpread = 10.0;  // how it scatters: less says nothing anyway

// By how much a number of the joints grows where all lengths do by one: what a link is longer than it reads is taken
// off.
double grows_m(const JointParameter& p, Vehicle vehicle) {
  if (p.unit != "m" || p.component == "truth") return 0.0;
  return p.effect == "link_length_bias" ? -length_of_joint_m(vehicle) : p.of(vehicle);
}

std::string aside_name(std::size_t castor) { return "castor[" + std::to_string(castor + 1) + "].aside_m"; }

}  // namespace

bool JoinedTest::lasts_throughout() const {
  constexpr double kUneven = 2.5;  // what acts in a few places scatters, unless it says so much
  return cross_validated > 0.0 && (inflation < kUneven || judged() > kDecisive);
}

JoinedModel::JoinedModel(std::vector<JoinedRun> runs, const Vehicle& vehicle, std::vector<double> clock_s,
                         std::vector<std::string> names)
    : given_(std::move(runs)), vehicle_(vehicle), clock_s_(std::move(clock_s)), names_(std::move(names)) {
  clock_s_.resize(given_.size(), 0.0);
  for (const JoinedRun& run : given_) {
    has_truth_ = has_truth_ || !run.tracked.empty();
    follows_truth_ = follows_truth_ && comes_often(run.tracked);
    has_headings_ = has_headings_ || (!run.tracked.empty() && run.has_headings);
  }
  for (JointParameter& p : joint_parameters(vehicle_))
    if (p.component != "truth" || has_headings_ || (follows_truth_ && p.unit == "m"))
      lengths_.push_back({p.name, p.prior, [of = p.of](Vehicle& v, double by) { of(v) += by; }, grows_m(p, vehicle_)});
  if (const auto* platform = std::get_if<MultiCastor>(&vehicle_.kind))
    for (std::size_t i = 0; i < platform->castors.size(); ++i)  // where the pivot's line meets the axle
      lengths_.push_back({aside_name(i), kAsidePrior_m, [i](Vehicle& v, double by) { move_aside(v, i, by); }});
  for (const VehicleUnit& u : units_of(vehicle_)) drives_of_file_.push_back(u.drive);
  make_filters();
  linearise();
}

void JoinedModel::make_filters() {
  std::vector<std::optional<JoinedFilter>> made(given_.size());
  parallel_for(static_cast<int>(given_.size()), [&](int r) {
    const auto k = static_cast<std::size_t>(r);
    made[k].emplace(given_[k], vehicle_, clock_s_[k]);
  });
  filters_.clear();
  for (auto& one : made) filters_.push_back(std::move(*one));
  for (std::size_t r = 0; r < filters_.size(); ++r)
    for (const Acting& a : acting_) {
      const std::vector<JoinedColumn> columns =
          moved_by(r, a.motions, static_cast<std::size_t>(a.value.size()), a.units);
      for (std::size_t k = 0; k < columns.size(); ++k) filters_[r].put_in(columns[k], a.value[static_cast<Index>(k)]);
    }
}

double JoinedModel::minus_two_log_likelihood(const JoinedNoise& noise, JoinedFilter::Wanted wanted) {
  std::vector<double> of_run(filters_.size());
  parallel_for(static_cast<int>(filters_.size()), [&](int r) {
    of_run[static_cast<std::size_t>(r)] = filters_[static_cast<std::size_t>(r)].run(noise, wanted);
  });
  double sum = 0.0;
  for (double one : of_run) sum += one;
  return sum;
}

void JoinedModel::fit_all() {
  for (int rounds = 0; rounds < 2; ++rounds) {
    fit(2);
    fit_noise();
  }
  if (!follows_truth_) return;
  const bool wanders = let_frame_wander();
  linearise();
  if (!wanders) return believe_what_contradicts();
  fit(2);
  fit_noise();
}

void JoinedModel::believe_what_contradicts() {
  constexpr double kSettled_s = 5.0;    // a filter that has hardly begun is lost by itself
  constexpr double kComesBack_s = 5.0;  // a tracker that took another marker for its own is no push
  for (std::size_t r = 0; r < filters_.size(); ++r) {
    const Track& tracked = given_[r].tracked;
    const std::vector<std::vector<std::size_t>>& all = filters_[r].contradicting();
    const auto begins_s = [&](std::size_t k) { return tracked[all[k].front()].time_s; };
    for (std::size_t k = 0; k < all.size(); ++k) {
      const bool comes_back = (k > 0 && begins_s(k) < begins_s(k - 1) + kComesBack_s) ||
                              (k + 1 < all.size() && begins_s(k + 1) < begins_s(k) + kComesBack_s);
      if (begins_s(k) > tracked.front().time_s + kSettled_s && !comes_back)
        given_[r].believed.insert(given_[r].believed.end(), all[k].begin(), all[k].end());
    }
  }
  if (!believes_what_contradicts()) return;
  make_filters();
  linearise();
}

bool JoinedModel::believes_what_contradicts() const {
  return std::any_of(given_.begin(), given_.end(), [](const JoinedRun& run) { return !run.believed.empty(); });
}

void JoinedModel::doubt_what_contradicts() {
  for (JoinedRun& run : given_) run.believed.clear();
  make_filters();
  linearise();
}

void JoinedModel::fit(int iterations) {
  for (int i = 0; i < iterations; ++i) {
    Index c = 0;
    const VectorXd step = at_best_;
    for (Length& length : lengths_) {
      length.add(vehicle_, step[c]);
      length.moved += step[c++];
    }
    for (std::size_t u = 0; u < units(); ++u) {
      DifferentialDrive drive = units_of(vehicle_)[u].drive;
      drive.wheel_radius_left_m *= 1.0 + step[c++];
      drive.wheel_radius_right_m *= 1.0 + step[c++];
      drive.wheelbase_m *= 1.0 + step[c++];
      vehicle_ = with_drive(vehicle_, u, drive);
    }
    if (follows_truth_)
      for (double& clock : clock_s_) clock += step[c++];
    make_filters();
    linearise();
  }
}

void JoinedModel::solve() {
  gram_.compute(z_.transpose() * z_ + prior_);
  at_best_ = gram_.solve(z_.transpose() * residual_ + toward_file_);
}

void JoinedModel::linearise() {
  minus_two_log_likelihood(noise_, JoinedFilter::Wanted::columns);
  const Index columns = static_cast<Index>(lengths_.size() + 3 * units() + (follows_truth_ ? given_.size() : 0));
  std::vector<MatrixXd> z(filters_.size());
  std::vector<std::vector<Track>> smoothed(filters_.size());
  parallel_for(static_cast<int>(filters_.size()), [&](int r) {
    const auto k = static_cast<std::size_t>(r);
    const JoinedFilter& run = filters_[k];
    smoothed[k] = run.smoothed();
    std::vector<JoinedColumn> own;
    for (const Length& length : lengths_) own.push_back(run.by_length(length.add));
    for (std::size_t u = 0; u < units(); ++u)
      for (int which = 0; which < 3; ++which) own.push_back(run.by_wheels(u, which));
    if (follows_truth_)
      for (std::size_t other = 0; other < given_.size(); ++other)
        own.push_back(other == k ? run.by_clock() : run.nothing());
    z[k] = run.carried(own);
  });
  Index rows = 0;
  for (const MatrixXd& one : z) rows += one.rows();
  z_.resize(rows, columns);
  residual_.resize(rows);
  batch_ends_.clear();
  Index at = 0;
  const Index reading = filters_.front().rows();
  for (std::size_t r = 0; r < z.size(); ++r) {
    z_.middleRows(at, z[r].rows()) = z[r];
    residual_.segment(at, z[r].rows()) = filters_[r].residual();
    at += z[r].rows();
  }
  if (has_truth_) let_joints_say_nothing_of_scale();
  const Index readings = rows / reading;
  for (Index b = 1; b <= kBatches; ++b) batch_ends_.push_back(reading * (readings * b / kBatches));

  VectorXd weight(columns), from_file = VectorXd::Zero(columns), scale = VectorXd::Zero(columns);
  Index c = 0;
  for (const Length& length : lengths_) {
    weight[c] = 1.0 / (length.prior * length.prior);
    from_file[c++] = -length.moved;
  }
  for (std::size_t u = 0; u < units(); ++u) {
    const DifferentialDrive now = units_of(vehicle_)[u].drive, &then = drives_of_file_[u];
    scale[c] = scale[c + 1] = 0.5 / static_cast<double>(units());
    for (double share : {then.wheel_radius_left_m / now.wheel_radius_left_m,
                         then.wheel_radius_right_m / now.wheel_radius_right_m, then.wheelbase_m / now.wheelbase_m}) {
      weight[c] = 1.0 / (kWheelPrior * kWheelPrior);
      from_file[c++] = share - 1.0;
    }
  }
  for (; c < columns; ++c) weight[c] = 1.0 / (kClockPrior_s * kClockPrior_s);
  prior_ = weight.asDiagonal();
  hold_the_body(prior_);
  // Between the units nothing shows how large they all are: were they smaller, they would contradict each other less.
  if (!has_truth_) prior_ += scale * scale.transpose() / (kScaleHeld * kScaleHeld);
  toward_file_ = prior_ * from_file;
  solve();

  views_.assign(units(), {});
  for (std::size_t r = 0; r < given_.size(); ++r) {
    for (std::size_t u = 0; u < units(); ++u) {
      InnovationRun seen = run_of_wheels(given_[r].samples, u);
      seen.name = names_[r];
      views_[u].push_back(
          drive_view(static_cast<int>(r), seen, units_of(vehicle_)[u].drive, false, smoothed[r][u], Way::smoothed));
    }
  }
}

// By how much they contradict each other units seem to tell how large they all are: what a wheel slips on the way to a
// reading is in what it reads, and in how far the units are apart then, which all shrinks with them. It is the noise
// that is as large as it is, and nothing: without this a radio of 0.1 m had all wheels too small by 0.8 %, eight
// standard errors.
void JoinedModel::let_joints_say_nothing_of_scale() {
  const auto wheels = static_cast<Index>(lengths_.size()), count = static_cast<Index>(3 * units());
  VectorXd grow = VectorXd::Zero(z_.cols());
  for (std::size_t k = 0; k < lengths_.size(); ++k) grow[static_cast<Index>(k)] = lengths_[k].grows_m;
  grow.segment(wheels, count).setOnes();
  const VectorXd all = z_ * grow;
  const Index reading = filters_.front().rows();
  for (Index first = 0; first < z_.rows(); first += reading)
    z_.block(first, wheels, reading - 3, count).colwise() -=
        all.segment(first, reading - 3) / static_cast<double>(count);
}

// The body of a platform is where its pivots are: were all of them elsewhere, or turned, its own axes would be.
void JoinedModel::hold_the_body(MatrixXd& prior) const {
  const auto* platform = std::get_if<MultiCastor>(&vehicle_.kind);
  if (!platform) return;
  constexpr double kHeld_m = 1e-6;
  std::vector<std::string> names;
  for (const Length& length : lengths_) names.push_back(length.name);
  MatrixXd held = MatrixXd::Zero(3, prior.cols());  // along x and y, turned
  held.leftCols(static_cast<Index>(names.size())) = moved_bodies(*platform, names).topRows(3);
  prior += held.transpose() * held / (kHeld_m * kHeld_m);
}

std::optional<JoinedModel::Known> JoinedModel::length(const std::string& name) const {
  for (std::size_t k = 0; k < lengths_.size(); ++k) {
    if (lengths_[k].name != name) continue;
    const auto c = static_cast<Index>(k);
    return Known{lengths_[k].moved + at_best_[c], stderr_of(VectorXd::Unit(z_.cols(), c))};
  }
  return std::nullopt;
}

MatrixXd JoinedModel::covariance_of(const std::vector<std::string>& lengths) const {
  const auto n = static_cast<Index>(lengths.size());
  MatrixXd picked = MatrixXd::Zero(z_.cols(), n);
  VectorXd error = VectorXd::Zero(n);
  for (Index k = 0; k < n; ++k)
    for (std::size_t l = 0; l < lengths_.size(); ++l)
      if (lengths_[l].name == lengths[static_cast<std::size_t>(k)]) {
        picked(static_cast<Index>(l), k) = 1.0;
        error[k] = stderr_of(picked.col(k));
      }
  const MatrixXd white = picked.transpose() * gram_.solve(picked);
  const VectorXd wider = error.cwiseQuotient(white.diagonal().cwiseMax(1e-300).cwiseSqrt());
  return wider.asDiagonal() * white * wider.asDiagonal();
}

double JoinedModel::stderr_of_aside_m(std::size_t castor) const {
  const std::optional<Known> known = length(aside_name(castor));
  return known ? known->stderr_value : kAsidePrior_m;
}

VectorXd JoinedModel::mean_of_radii() const {
  VectorXd mean = VectorXd::Zero(z_.cols());
  for (std::size_t u = 0; u < units(); ++u)
    mean.segment<2>(static_cast<Index>(lengths_.size() + 3 * u)).setConstant(0.5 / static_cast<double>(units()));
  return mean;
}

double JoinedModel::stderr_of_scale() const { return stderr_of(mean_of_radii()); }

double JoinedModel::stderr_of_clock_s(std::size_t run) const {
  if (!follows_truth_) return 0.0;
  return stderr_of(VectorXd::Unit(z_.cols(), static_cast<Index>(lengths_.size() + 3 * units() + run)));
}

double JoinedModel::expected_stderr_of_scale() const {
  const VectorXd mean = mean_of_radii();
  return std::sqrt(mean.dot(gram_.solve(mean)));
}

double JoinedModel::stderr_of(const VectorXd& sum) const {
  const VectorXd of = gram_.solve(sum);
  const ScoreByBatches score = score_along(z_ * of);  // what this sum alone moves
  const double wider = score.u.empty() ? 1.0 : score.inflation(kFewestBatchesBelieved);
  return std::sqrt(wider * sum.dot(of));
}

std::vector<JoinedColumn> JoinedModel::moved_by(std::size_t run, const MotionsOf& motions, std::size_t amplitudes,
                                                const std::vector<std::size_t>& units) const {
  std::vector<JoinedColumn> columns(amplitudes, filters_[run].nothing());
  for (std::size_t u : units) {
    const std::vector<Motions> of_unit = motions(views_[u][run]);
    for (std::size_t a = 0; a < of_unit.size() && a < amplitudes; ++a)
      if (!of_unit[a].empty()) filters_[run].add_motions(of_unit[a], u, columns[a]);
  }
  return columns;
}

JoinedColumns JoinedModel::columns_of(const MotionsOf& motions, std::size_t amplitudes,
                                      const std::vector<std::size_t>& units) const {
  return columns_of_each({motions}, amplitudes, units);
}

JoinedColumns JoinedModel::columns_of_each(const std::vector<MotionsOf>& each, std::size_t amplitudes,
                                           const std::vector<std::size_t>& units) const {
  JoinedColumns all(z_.rows(), static_cast<Index>(each.size() * amplitudes));
  Index first = 0;
  for (std::size_t r = 0; r < filters_.size(); ++r) {
    const Index count = filters_[r].residual().size();
    std::vector<JoinedColumn> moved;
    for (const MotionsOf& motions : each)
      for (JoinedColumn& column : moved_by(r, motions, amplitudes, units)) moved.push_back(std::move(column));
    all.middleRows(first, count) = filters_[r].carried(moved);
    first += count;
  }
  return all;
}

void JoinedModel::fit_noise_beside(const std::vector<Acting>& acting) {
  acting_ = acting;
  make_filters();
  fit_noise();
  acting_.clear();
  make_filters();
  linearise();
}

void JoinedModel::put_in(const std::vector<Acting>& acting) {
  acting_ = acting;
  make_filters();
  linearise();
  fit(2);
  acting_.clear();  // what it was fitted beside stays in the filters
}

std::vector<std::optional<JoinedModel::Known>> JoinedModel::fit_all_beside(std::vector<Acting> acting) {
  constexpr int kRounds = 2;  // the first finds how much, under the noise that too little of it leaves
  const auto column_of = [&](const Acting& a) { return columns_of(a.motions, 1, a.units); };
  std::vector<bool> acts;
  for (const Acting& a : acting) acts.push_back(column_of(a).squaredNorm() > 0.0);
  for (int round = 0; round < kRounds; ++round) {
    acting_ = acting;
    make_filters();
    linearise();
    fit_all();
    Index c = z_.cols();
    for (std::size_t k = 0; k < acting.size(); ++k)
      if (acts[k]) let_in(column_of(acting[k]));
    for (std::size_t k = 0; k < acting.size(); ++k)
      if (acts[k]) acting[k].value[0] += at_best_[c++];
  }
  acting_.clear();
  std::vector<std::optional<Known>> fitted(acting.size());
  Index c = z_.cols() - std::count(acts.begin(), acts.end(), true);
  for (std::size_t k = 0; k < acting.size(); ++k)
    if (acts[k]) fitted[k] = Known{acting[k].value[0], stderr_of(VectorXd::Unit(z_.cols(), c++))};
  return fitted;
}

std::vector<JoinedFilter::Impact> JoinedModel::impacts(std::size_t run) const {
  Index first = 0;
  for (std::size_t r = 0; r < run; ++r) first += filters_[r].residual().size();
  const Index count = filters_[run].residual().size();
  return filters_[run].impacts(residual_.segment(first, count) - z_.middleRows(first, count) * at_best_);
}

ScoreByBatches JoinedModel::score_by_batches(const JoinedColumns& columns) const {
  const JoinedTest by = test(columns, -1.0);
  return by.statistic > 0.0 ? score_along(trace_of(columns, by.value)) : ScoreByBatches{};
}

VectorXd JoinedModel::trace_of(const JoinedColumns& columns, const VectorXd& value) const {
  const VectorXd motion = columns * value;
  return motion - z_ * gram_.solve(z_.transpose() * motion);
}

std::vector<std::vector<SampleEvidence>> JoinedModel::evidence_of(const JoinedColumns& columns,
                                                                  const VectorXd& value) const {
  const VectorXd trace = trace_of(columns, value);
  const VectorXd left = residual_ - z_ * at_best_ - trace;
  std::vector<std::vector<SampleEvidence>> all;
  Index first = 0;
  for (const JoinedFilter& run : filters_) {
    std::vector<SampleEvidence>& of_run = all.emplace_back();
    for (std::size_t k = 0; k < run.readings(); ++k, first += run.rows()) {
      const auto of = trace.segment(first, run.rows());
      of_run.push_back({run.time_s(k), of.dot(left.segment(first, run.rows())), of.squaredNorm()});
    }
  }
  return all;
}

ScoreByBatches JoinedModel::score_along(const VectorXd& direction) const {
  ScoreByBatches score;
  Index from = 0;
  for (Index to : batch_ends_) {
    const auto d = direction.segment(from, to - from);
    score.add(d.dot(residual_.segment(from, to - from)), d.squaredNorm());
    from = to;
  }
  score.finish();
  return score;
}

JoinedTest JoinedModel::test(const JoinedColumns& columns, double batches_believed_white) const {
  return test_of(columns, z_.transpose() * columns, batches_believed_white);
}

std::vector<JoinedTest> JoinedModel::tests(const JoinedColumns& all, std::size_t amplitudes,
                                           double batches_believed_white) const {
  const MatrixXd cross = z_.transpose() * all;
  const auto each = static_cast<Index>(amplitudes);
  std::vector<JoinedTest> tests;
  for (Index k = 0; k + each <= all.cols(); k += each)
    tests.push_back(test_of(all.middleCols(k, each), cross.middleCols(k, each), batches_believed_white));
  return tests;
}

JoinedTest JoinedModel::test_of(const Eigen::Ref<const MatrixXd>& columns, const MatrixXd& cross,
                                double batches_believed_white) const {
  JoinedTest t;
  const MatrixXd own = columns.transpose() * columns;
  const MatrixXd information = own - cross.transpose() * gram_.solve(cross);
  const VectorXd score = columns.transpose() * residual_ - cross.transpose() * at_best_;
  // In units in which each amplitude by itself has information one.
  VectorXd size = own.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const MatrixXd scaled = size.cwiseInverse().asDiagonal() * information * size.cwiseInverse().asDiagonal();
  const MatrixXd scaled_own = size.cwiseInverse().asDiagonal() * own * size.cwiseInverse().asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(
      scaled, scaled_own + 1e-9 * MatrixXd::Identity(own.rows(), own.cols()));
  const VectorXd s = size.cwiseInverse().cwiseProduct(score);
  t.value = VectorXd::Zero(columns.cols());
  t.covariance = MatrixXd::Zero(columns.cols(), columns.cols());
  for (Index k = 0; k < eigen.eigenvalues().size(); ++k) {
    const double survives = eigen.eigenvalues()[k];
    t.survives = std::max(t.survives, survives);
    if (survives < kLeastSurviving) continue;
    const VectorXd v = eigen.eigenvectors().col(k);
    const double along = v.dot(s);
    t.statistic += along * along / survives;
    t.value += v * (along / survives);
    t.covariance += v * v.transpose() / survives;
    ++t.freedom;
  }
  t.value = size.cwiseInverse().cwiseProduct(t.value);
  t.covariance = size.cwiseInverse().asDiagonal() * t.covariance * size.cwiseInverse().asDiagonal();
  if (batches_believed_white >= 0.0 && t.statistic > kWorthAskingBySpread) {
    const ScoreByBatches by = score_along(trace_of(columns, t.value));
    t.inflation = by.u.empty() ? 1.0 : by.inflation(batches_believed_white);
    t.cross_validated = by.cross_validated();
  }
  return t;
}

void JoinedModel::let_in(const JoinedColumns& columns) {
  const Index c = columns.cols();
  MatrixXd more(z_.rows(), z_.cols() + c);
  more << z_, columns;
  z_ = std::move(more);
  MatrixXd prior = MatrixXd::Zero(z_.cols(), z_.cols());
  prior.topLeftCorner(prior_.rows(), prior_.cols()) = prior_;
  prior_ = std::move(prior);
  VectorXd toward = VectorXd::Zero(z_.cols());
  toward.head(toward_file_.size()) = toward_file_;
  toward_file_ = std::move(toward);
  solve();
}

}  // namespace odolab
