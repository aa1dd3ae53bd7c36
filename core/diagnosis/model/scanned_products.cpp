#include "core/diagnosis/model/scanned_products.h"

#include <algorithm>
#include <array>

#include "core/base/parallel.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kBlock = 4;  // columns that are summed together

}  // namespace

ScannedProducts::ScannedProducts(const std::vector<DriveView>& views, const std::vector<LinearisedRun>& runs,
                                 const std::vector<std::vector<int>>& columns, const std::vector<MatrixXd>& z,
                                 const std::vector<VectorXd>& residual, int model_columns)
    : views_(views), runs_(runs), columns_(columns), model_columns_(model_columns), of_run_(runs.size()) {
  parallel_for(static_cast<int>(of_run_.size()), [&](int run) {
    const auto r = static_cast<std::size_t>(run);
    OfRun& of = of_run_[r];
    const std::size_t acting = columns[r].size();
    of.tails = runs[r].tails();
    of.wide = (acting + 1 + kBlock - 1) / kBlock * kBlock;
    of.by_move.assign(3 * of.wide * static_cast<std::size_t>(runs[r].samples() - 1), 0.0);
    for (std::size_t k = 0; k <= acting; ++k) {
      const double* column = k < acting ? z[r].col(static_cast<Eigen::Index>(k)).data() : residual[r].data();
      const std::vector<double> by = runs[r].score_of_intervals(column);
      for (std::size_t i = 0; i < by.size(); ++i) of.by_move[of.wide * i + k] = by[i];
    }
  });
}

template <int abreast>
void ScannedProducts::products_with(const OfRun& of, const LinearisedRun::Moved& moved, std::vector<double>& with) {
  using Lanes = Eigen::Array<double, abreast, 1>;
  const std::size_t columns = moved.columns.size(), wide = of.wide;
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t block = 0; block < wide; block += kBlock) {
      Lanes sum[kBlock];
      std::fill(sum, sum + kBlock, Lanes::Zero());
      for (const LinearisedRun::Moved::Part& part : moved.parts)
        for (int t = part.first; t < part.end; ++t) {
          const std::size_t n = part.held_before + static_cast<std::size_t>(t - part.first);
          if (!moved.any[n]) continue;
          const double* u = &moved.by[(n * columns + j) * 3 * abreast];
          const Eigen::Map<const Lanes> x(u), y(u + abreast), h(u + 2 * abreast);
          const double* by = &of.by_move[3 * wide * static_cast<std::size_t>(t) + block];
          for (std::size_t c = 0; c < kBlock; ++c) sum[c] += by[c] * x + by[wide + c] * y + by[2 * wide + c] * h;
        }
      for (std::size_t c = 0; c < kBlock; ++c)
        std::copy(sum[c].data(), sum[c].data() + abreast, &with[(j * wide + block + c) * abreast]);
    }
}

void ScannedProducts::work_out(const Effect& effect, const std::vector<double>* const* shapes, std::size_t count,
                               OfShape* const* results, Scratch& scratch) const {
  constexpr std::size_t kAbreast = LinearisedRun::kAbreast;
  const auto k = static_cast<Eigen::Index>(effect.amplitudes.size());
  const std::size_t abreast = count == 1 ? 1 : kAbreast;
  for (std::size_t l = 0; l < count; ++l)
    results[l]->products = {MatrixXd::Zero(k, k), MatrixXd::Zero(model_columns_, k), VectorXd::Zero(k)};
  LinearisedRun::Moved& moved = scratch.moved;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    scratch.motions.assign(abreast, {});
    bool any = false;
    for (std::size_t l = 0; l < count; ++l) {
      if (effect.of_one_recording && static_cast<int>((*shapes[l])[0]) != static_cast<int>(r)) continue;
      scratch.motions[l] = effect.motions(views_[r], *shapes[l]);
      any = true;
    }
    if (!any) continue;
    runs_[r].move(scratch.motions, moved);
    if (moved.columns.empty()) continue;
    const OfRun& of = of_run_[r];
    const std::size_t columns = moved.columns.size(), wide = of.wide, acting = columns_[r].size();
    scratch.with.assign(columns * wide * abreast, 0.0);
    if (abreast == 1)
      products_with<1>(of, moved, scratch.with);
    else
      products_with<static_cast<int>(kAbreast)>(of, moved, scratch.with);
    runs_[r].products_of(moved, of.tails, scratch.products);
    for (std::size_t l = 0; l < count; ++l) {
      if (scratch.motions[l].empty()) continue;
      CandidateProducts& sum = results[l]->products;
      for (std::size_t i = 0; i < columns; ++i) {
        const auto row = static_cast<Eigen::Index>(moved.columns[i]);
        if (scratch.motions[l][moved.columns[i]].empty()) continue;
        results[l]->acts = true;
        const auto with = [&](std::size_t c) { return scratch.with[(i * wide + c) * abreast + l]; };
        for (std::size_t c = 0; c < acting; ++c) sum.with_model(columns_[r][c], row) += with(c);
        sum.with_residual(row) += with(acting);
        for (std::size_t j = 0; j < columns; ++j)
          sum.with_itself(row, static_cast<Eigen::Index>(moved.columns[j])) +=
              scratch.products[(i * columns + j) * abreast + l];
      }
    }
  }
}

std::vector<ScannedProducts::OfShape> ScannedProducts::of(const Effect& effect,
                                                          const std::vector<const std::vector<double>*>& shapes) {
  constexpr std::size_t kAbreast = LinearisedRun::kAbreast;
  std::vector<OfShape> found(shapes.size());
  std::vector<std::size_t> missing;
  {
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    for (std::size_t i = 0; i < shapes.size(); ++i)
      if (const auto at = known_.find({&effect, *shapes[i]}); at != known_.end())
        found[i] = at->second;
      else
        missing.push_back(i);
  }
  const auto groups = static_cast<int>((missing.size() + kAbreast - 1) / kAbreast);
  parallel_for(groups, [&](int group) {
    Scratch scratch;
    const std::size_t i = kAbreast * static_cast<std::size_t>(group), count = std::min(kAbreast, missing.size() - i);
    std::array<const std::vector<double>*, kAbreast> abreast{};
    std::array<OfShape*, kAbreast> results{};
    for (std::size_t l = 0; l < count; ++l) {
      abreast[l] = shapes[missing[i + l]];
      results[l] = &found[missing[i + l]];
    }
    work_out(effect, abreast.data(), count, results.data(), scratch);
  });
  const std::lock_guard<std::mutex> lock(one_at_a_time_);
  for (const std::size_t i : missing) known_.try_emplace({&effect, *shapes[i]}, found[i]);
  return found;
}

}  // namespace odolab
