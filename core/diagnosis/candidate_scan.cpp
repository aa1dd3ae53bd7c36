#include "core/diagnosis/candidate_scan.h"

#include <algorithm>

#include "core/base/parallel.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kBlock = 4;  // columns that are summed together

}  // namespace

CandidateScan::CandidateScan(const JointModel& joint, int without)
    : joint_(joint), without_(without), absorbing_(joint.absorbing(without)), of_run_(joint.runs_.size()) {
  parallel_for(static_cast<int>(of_run_.size()), [&](int r) {
    OfRun& of = of_run_[static_cast<std::size_t>(r)];
    const LinearisedRun& linear = joint.now_->runs[static_cast<std::size_t>(r)];
    const MatrixXd& z = joint.now_->z[static_cast<std::size_t>(r)];
    of.tails = linear.tails();
    of.columns = joint.now_->columns[static_cast<std::size_t>(r)];
    of.wide = (of.columns.size() + 1 + kBlock - 1) / kBlock * kBlock;
    of.by_move.assign(3 * of.wide * static_cast<std::size_t>(linear.samples() - 1), 0.0);
    for (std::size_t k = 0; k <= of.columns.size(); ++k) {
      const double* column = k < of.columns.size() ? z.col(static_cast<Eigen::Index>(k)).data()
                                                   : joint.now_->residual[static_cast<std::size_t>(r)].data();
      const std::vector<double> by = linear.score_of_intervals(column);
      for (std::size_t i = 0; i < by.size(); ++i) of.by_move[of.wide * i + k] = by[i];
    }
  });
}

template <int abreast>
void CandidateScan::products_with(const OfRun& of, const LinearisedRun::Moved& moved, std::vector<double>& with) {
  const std::size_t columns = moved.columns.size(), wide = of.wide;
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t block = 0; block < wide; block += kBlock) {
      double sum[kBlock][abreast] = {};
      for (std::size_t t = 0; t < moved.any.size(); ++t) {
        if (!moved.any[t]) continue;
        const double* u = &moved.by[(t * columns + j) * 3 * abreast];
        const double* by = &of.by_move[3 * wide * (static_cast<std::size_t>(moved.first) + t) + block];
        for (std::size_t c = 0; c < kBlock; ++c)
          for (int l = 0; l < abreast; ++l)
            sum[c][l] += by[c] * u[l] + by[wide + c] * u[abreast + l] + by[2 * wide + c] * u[2 * abreast + l];
      }
      for (std::size_t c = 0; c < kBlock; ++c)
        for (int l = 0; l < abreast; ++l)
          with[(j * wide + block + c) * abreast + static_cast<std::size_t>(l)] = sum[c][l];
    }
}

void CandidateScan::test_abreast(const Effect& effect, const std::vector<double>* const* shapes, std::size_t count,
                                 CandidateTest* results, Scratch& scratch) const {
  constexpr std::size_t kAbreast = LinearisedRun::kAbreast;
  const auto k = static_cast<Eigen::Index>(effect.amplitudes.size());
  const std::size_t abreast = count == 1 ? 1 : kAbreast;
  std::array<char, kAbreast> asked{}, acts{};
  for (std::size_t l = 0; l < count; ++l)
    asked[l] = !effect.local || !effect.of_one_recording ||
               joint_.is_well_inside(static_cast<int>((*shapes[l])[0]), (*shapes[l])[1]);
  std::array<CandidateProducts, kAbreast> sums;
  for (std::size_t l = 0; l < count; ++l)
    sums[l] = {MatrixXd::Zero(k, k), MatrixXd::Zero(absorbing_.taken.size(), k), VectorXd::Zero(k)};
  LinearisedRun::Moved& moved = scratch.moved;
  for (std::size_t r = 0; r < of_run_.size(); ++r) {
    scratch.motions.assign(abreast, {});
    bool any = false;
    for (std::size_t l = 0; l < count; ++l) {
      if (!asked[l] || (effect.of_one_recording && static_cast<int>((*shapes[l])[0]) != static_cast<int>(r))) continue;
      scratch.motions[l] = effect.motions(joint_.now_->views[r], *shapes[l]);
      any = true;
    }
    if (!any) continue;
    const LinearisedRun& linear = joint_.now_->runs[r];
    linear.move(scratch.motions, moved);
    if (moved.columns.empty()) continue;
    const OfRun& of = of_run_[r];
    const std::size_t columns = moved.columns.size(), wide = of.wide;
    scratch.with.assign(columns * wide * abreast, 0.0);
    if (abreast == 1)
      products_with<1>(of, moved, scratch.with);
    else
      products_with<static_cast<int>(kAbreast)>(of, moved, scratch.with);
    linear.products_of(moved, of.tails, scratch.products);
    for (std::size_t l = 0; l < count; ++l) {
      if (scratch.motions[l].empty()) continue;
      CandidateProducts& sum = sums[l];
      for (std::size_t i = 0; i < columns; ++i) {
        const auto row = static_cast<Eigen::Index>(moved.columns[i]);
        if (scratch.motions[l][moved.columns[i]].empty()) continue;
        acts[l] = 1;
        const auto with = [&](std::size_t c) { return scratch.with[(i * wide + c) * abreast + l]; };
        for (std::size_t c = 0; c < of.columns.size(); ++c) sum.with_model(of.columns[c], row) += with(c);
        sum.with_residual(row) += with(of.columns.size());
        for (std::size_t j = 0; j < columns; ++j)
          sum.with_itself(row, static_cast<Eigen::Index>(moved.columns[j])) +=
              scratch.products[(i * columns + j) * abreast + l];
      }
    }
  }
  for (std::size_t l = 0; l < count; ++l)
    if (acts[l])
      results[l] = JointModel::tested(absorbing_, std::move(sums[l]), CandidateColumns{}.least_surviving, nullptr);
}

CandidateTest CandidateScan::test(const Effect& effect, const std::vector<double>& shape) const {
  return std::move(tests(effect, {shape}).front());
}

std::vector<CandidateTest> CandidateScan::tests(const Effect& effect,
                                                const std::vector<std::vector<double>>& shapes) const {
  std::vector<CandidateTest> results(shapes.size());
  Scratch scratch;
  for (std::size_t i = 0; i < shapes.size();) {
    if (effect.clock_rate) {
      results[i] = joint_.test(joint_.columns_of(effect, shapes[i]), without_);
      ++i;
      continue;
    }
    const std::size_t count = std::min(LinearisedRun::kAbreast, shapes.size() - i);
    const std::vector<double>* abreast[LinearisedRun::kAbreast] = {};
    for (std::size_t l = 0; l < count; ++l) abreast[l] = &shapes[i + l];
    test_abreast(effect, abreast, count, &results[i], scratch);
    i += count;
  }
  return results;
}

}  // namespace odolab
