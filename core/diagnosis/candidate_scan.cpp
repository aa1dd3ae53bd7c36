#include "core/diagnosis/candidate_scan.h"

#include "core/base/parallel.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

CandidateScan::CandidateScan(const JointModel& joint, int without)
    : joint_(joint), without_(without), absorbing_(joint.absorbing(without)), of_run_(joint.runs_.size()) {
  parallel_for(static_cast<int>(of_run_.size()), [&](int r) {
    OfRun& of = of_run_[static_cast<std::size_t>(r)];
    const LinearisedRun& linear = joint.now_->runs[static_cast<std::size_t>(r)];
    const MatrixXd& z = joint.now_->z[static_cast<std::size_t>(r)];
    of.tails = linear.tails();
    of.columns = joint.now_->columns[static_cast<std::size_t>(r)];
    const std::size_t wide = of.columns.size() + 1, steps = linear.run().wheels.size() - 1;
    of.per_motion.resize(3 * wide * steps);
    for (std::size_t k = 0; k < wide; ++k) {
      const double* column = k + 1 < wide ? z.col(static_cast<Eigen::Index>(k)).data()
                                          : joint.now_->residual[static_cast<std::size_t>(r)].data();
      const std::vector<BodyMotion> by = linear.score_of_motions(column);
      for (std::size_t i = 0; i < steps; ++i) {
        double* to = &of.per_motion[3 * wide * i + k];
        to[0] = by[i].forward_m;
        to[wide] = by[i].sideways_m;
        to[2 * wide] = by[i].turn_rad;
      }
    }
  });
}

CandidateTest CandidateScan::test(const Effect& effect, const std::vector<double>& shape) const {
  if (effect.local && effect.of_one_recording && !joint_.is_well_inside(static_cast<int>(shape[0]), shape[1]))
    return {};
  if (effect.clock_rate) return joint_.test(joint_.columns_of(effect, shape), without_);
  const auto k = static_cast<Eigen::Index>(effect.amplitudes.size());
  CandidateProducts sum{MatrixXd::Zero(k, k), MatrixXd::Zero(absorbing_.taken.size(), k), VectorXd::Zero(k)};
  std::vector<double> products, with;
  bool acts = false;
  for (std::size_t r = 0; r < of_run_.size(); ++r) {
    if (effect.of_one_recording && static_cast<int>(shape[0]) != static_cast<int>(r)) continue;
    const OfRun& of = of_run_[r];
    const std::vector<Motions> motions = effect.motions(joint_.now_->views[r], shape);
    const std::size_t wide = of.columns.size() + 1;
    for (std::size_t j = 0; j < motions.size(); ++j) {
      const Motions& m = motions[j];
      if (m.empty()) continue;
      acts = true;
      with.assign(wide, 0.0);
      for (std::size_t i = m.first(); i < m.end(); ++i) {
        const double f = m[i].forward_m, l = m[i].sideways_m, w = m[i].turn_rad;
        const double* by = &of.per_motion[3 * wide * i];
        for (std::size_t c = 0; c < wide; ++c) with[c] += f * by[c] + l * by[wide + c] + w * by[2 * wide + c];
      }
      const auto column = static_cast<Eigen::Index>(j);
      for (std::size_t c = 0; c + 1 < wide; ++c) sum.with_model(of.columns[c], column) += with[c];
      sum.with_residual(column) += with[wide - 1];
    }
    products.resize(motions.size() * motions.size());
    joint_.now_->runs[r].products_of_motions(motions, of.tails, products.data());
    sum.with_itself += Eigen::Map<const MatrixXd>(products.data(), k, k);
  }
  if (!acts) return {};
  return JointModel::tested(absorbing_, std::move(sum), CandidateColumns{}.least_surviving, nullptr);
}

}  // namespace odolab
