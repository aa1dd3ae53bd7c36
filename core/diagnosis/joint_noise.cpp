// Noise and outliers of the joint model: what the calibration and the effects leave is random, and how large it is.
#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/calibration/minimise.h"
#include "core/calibration/thinned_truth.h"
#include "core/diagnosis/joint_model.h"

namespace odolab {

namespace {

constexpr int kNoiseSamples = 5000;

}  // namespace

void JointModel::fit_noise() {
  constexpr double kUsual[5] = {0.003, 0.002, 0.0005, 0.0005, 0.005};
  // A model is not trusted to be truer sideways than this share of the wheels' noise.
  constexpr double kLeastSideways = 0.05;
  constexpr double kWay_m = 0.1;
  constexpr double kUsualWithin = 2.3, kSampledWithin = 0.5;  // of logarithms: a factor of ten, and of 1.6
  bool any_heading = false;
  for (const InnovationRun& run : runs_) any_heading = any_heading || run.truth_has_heading;
  std::vector<double> logs = {std::log(model.noise.wheel_m_per_sqrt_m), std::log(model.noise.truth_position_m),
                              std::log(model.noise.body_m_per_sqrt_m), std::log(model.noise.sideways_m_per_sqrt_m)};
  if (any_heading) logs.push_back(std::log(model.noise.truth_heading_rad));
  const auto noise_of = [&](const std::vector<double>& at) {
    return as_large_as_any_real({std::exp(at[0]), std::exp(at[1]),
                                 any_heading ? std::exp(at[4]) : model.noise.truth_heading_rad, std::exp(at[2]),
                                 std::max(std::exp(at[3]), kLeastSideways * std::exp(at[0]))});
  };
  // Twice the negative log-likelihood of the noise on these runs, of which every so many stretches are used; `scales`:
  // those of the logarithms that are free.
  const auto fitted = [&](const std::vector<const InnovationRun*>& runs, const std::vector<int>& scales,
                          const std::vector<double>& usual, double within) {
    std::vector<SummedRun> summed;
    int samples = 0;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      summed.push_back(summed_up(*runs[r], model_of(static_cast<int>(r))));
      samples += static_cast<int>(runs[r]->truth.size());
    }
    const int every = std::max(1, samples / kNoiseSamples), stretch = 250;
    const double parameters = columns();
    const auto value = [&](const std::vector<double>& free) {
      std::vector<double> at = logs;
      for (std::size_t k = 0; k < scales.size(); ++k) at[static_cast<std::size_t>(scales[k])] = free[k];
      std::vector<double> sum_of(runs.size(), 0.0);
      std::vector<int> scalars_of(runs.size(), 0);
      const auto of_run = [&](int r) {
        InnovationModel m = model_of(r);
        m.noise = noise_of(at);
        FilterOptions options;
        options.derivatives = false;
        const int n = static_cast<int>(runs[r]->truth.size());
        for (int first = 0, number = r; first + 1 < n; first += every == 1 ? n : stretch, ++number) {
          if (number % every != 0) continue;
          options.first = first;
          options.last = every == 1 ? n : std::min(n, first + stretch);
          const InnovationSums s = filtered(*runs[r], summed[r], m, options);
          sum_of[r] += s.chi2 + s.log_determinant;
          scalars_of[r] += s.scalars;
        }
      };
      if (samples > kNoiseSamples)
        parallel_for(static_cast<int>(runs.size()), of_run);
      else  // not worth starting threads for
        for (std::size_t r = 0; r < runs.size(); ++r) of_run(static_cast<int>(r));
      double sum = 0.0;
      int scalars = 0;
      for (std::size_t r = 0; r < runs.size(); ++r) sum += sum_of[r], scalars += scalars_of[r];
      // The freedom that the parameters took, as an average: exact where all scales move together.
      if (every == 1 && scalars > 2 * parameters) sum -= parameters * (free[0] + free[1]);
      for (std::size_t k = 0; k < scales.size(); ++k)
        sum += std::pow((free[k] - usual[static_cast<std::size_t>(scales[k])]) / within, 2);
      return sum;
    };
    std::vector<double> start;
    for (int k : scales) start.push_back(logs[static_cast<std::size_t>(k)]);
    const std::vector<double> best = minimised(value, start, 0.2, 0.05, 110);
    for (std::size_t k = 0; k < scales.size(); ++k) logs[static_cast<std::size_t>(scales[k])] = best[k];
  };
  std::vector<const InnovationRun*> whole;
  for (const LinearisedRun& l : now_->runs) whole.push_back(&l.run());
  std::vector<double> usual;
  for (double size : kUsual) usual.push_back(std::log(size));
  fitted(whole, any_heading ? std::vector<int>{0, 1, 2, 3, 4} : std::vector<int>{0, 1, 2, 3}, usual, kUsualWithin);
  // The truth's noise shows from sample to sample; the floor's in what it adds up to, as far as that is more than the
  // samples say: of a small sideways noise it says nothing.
  std::vector<InnovationRun> thin;
  for (std::size_t r = 0; r < whole.size(); ++r)
    thin.push_back(thinned_truth(*whole[r], model_of(static_cast<int>(r)), kWay_m));
  std::vector<const InnovationRun*> thinned;
  int left = 0;
  for (const InnovationRun& run : thin)
    if (run.truth.size() >= 2) thinned.push_back(&run), left += static_cast<int>(run.truth.size());
  if (thinned.size() == whole.size() && left > 3 * columns()) fitted(thinned, {0, 2, 3}, logs, kSampledWithin);
  model.noise = noise_of(logs);
}

void JointModel::gate() {
  FilterOptions options;
  options.derivatives = false;
  options.gate = 30.0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const InnovationModel m = model_of(static_cast<int>(r));
    const InnovationRun run = prepared(static_cast<int>(r));
    std::vector<char> aside = filtered(run, summed_up(run, m), m, options).set_aside;
    // More than a few in a row are no outliers: something happened there that is to be explained.
    for (std::size_t i = 0; i < aside.size();) {
      std::size_t j = i;
      while (j < aside.size() && aside[j]) ++j;
      if (j - i > 4) std::fill(aside.begin() + i, aside.begin() + j, 0);
      i = std::max(j, i + 1);
    }
    for (std::size_t i = 0; i < aside.size(); ++i) aside[i] = std::max(aside[i] ? char{1} : char{0}, masked_[r][i]);
    runs_[r].set_aside = std::move(aside);
  }
}
}  // namespace odolab
