// Noise and outliers of the joint model: what the calibration and the effects leave is random, and how large it is.
#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/calibration/noise_fit.h"
#include "core/calibration/thinned_truth.h"
#include "core/diagnosis/model/joint_model.h"
#include "core/diagnosis/model/outlying.h"

namespace odolab {

namespace {

constexpr int kNoiseSamples = 5000;

}  // namespace

void JointModel::fit_noise() {
  cut();
  constexpr double kWay_m = 0.1;
  constexpr double kSampledWithin = 0.5;  // of logarithms: a factor of 1.6
  struct Part {
    const InnovationRun* run;
    const SummedRun* summed;
  };
  // The noise that is likely on these runs, of which every so many stretches are used.
  const auto fitted = [&](const std::vector<Part>& parts, const NoiseFit& fit) {
    int samples = 0;
    for (const Part& part : parts) samples += static_cast<int>(part.run->truth.size());
    const int every = std::max(1, samples / kNoiseSamples), stretch = 250;
    const double parameters = columns();
    const auto likelihood = [&](const FittedNoise& noise) {
      std::vector<NoiseSlopes> of_run(parts.size());
      const auto sum_run = [&](int r) {
        const InnovationRun& run = *parts[r].run;
        InnovationModel m = model_of(r);
        m.noise = noise;
        const int n = static_cast<int>(run.truth.size());
        for (int first = 0, number = r; first + 1 < n; first += every == 1 ? n : stretch, ++number) {
          if (number % every != 0) continue;
          of_run[r].add(noise_slopes(run, *parts[r].summed, m, first, every == 1 ? n : std::min(n, first + stretch)));
        }
      };
      if (samples > kNoiseSamples)
        parallel_for(static_cast<int>(parts.size()), sum_run);
      else  // not worth starting threads for
        for (std::size_t r = 0; r < parts.size(); ++r) sum_run(static_cast<int>(r));
      NoiseSlopes sum;
      for (const NoiseSlopes& s : of_run) sum.add(s);
      // The freedom that the parameters took, as an average: exact where all sizes move together.
      if (every == 1 && sum.scalars > 2 * parameters)
        for (int k = 0; k < 2; ++k) {
          FittedNoise at = noise;
          sum.value -= parameters * std::log(size_of(at, fit.free[k]));
          sum.slope[fit.free[k]] -= parameters;
        }
      return sum;
    };
    return most_likely_noise(likelihood, model.noise, fit);
  };
  bool any_heading = false, any_commands = false;
  std::vector<Part> whole;
  for (const LinearisedRun& l : now_->runs) {
    whole.push_back({&l.run(), &l.summed()});
    any_heading = any_heading || l.run().truth_has_heading;
    any_commands = any_commands || l.run().speeds_are_held;
  }
  NoiseFit of_samples{{noise_size::wheel, noise_size::position}, kUsualNoise};
  of_samples.add_body();
  of_samples.add_wander(any_heading);
  if (any_commands) of_samples.add_timing();
  if (any_heading) of_samples.free.push_back(noise_size::heading);
  model.noise = fitted(whole, of_samples);
  // The truth's noise shows from sample to sample; the floor's in what it adds up to, as far as that is more than the
  // samples say: of a small sideways noise it says nothing.
  std::vector<ThinnedTruth> thin(whole.size());
  std::vector<Part> thinned;
  int left = 0;
  for (std::size_t r = 0; r < whole.size(); ++r) {
    thin[r] = thinned_truth(*whole[r].run, *whole[r].summed, model_of(static_cast<int>(r)), kWay_m);
    if (thin[r].run.truth.size() < 2) return;
    thinned.push_back({&thin[r].run, &thin[r].summed});
    left += static_cast<int>(thin[r].run.truth.size());
  }
  if (left <= 3 * columns()) return;
  NoiseFit of_ways{{noise_size::wheel}, model.noise, kSampledWithin};
  of_ways.add_body();
  of_ways.add_wander(any_heading);
  if (any_commands) of_ways.add_timing();
  of_ways.usual_of_body = 0.0;  // what is usual is what the samples said
  model.noise = fitted(thinned, of_ways);
}

void JointModel::gate() {
  std::vector<std::vector<char>> aside(runs_.size());
  parallel_for(static_cast<int>(runs_.size()), [&](int run) {
    const auto r = static_cast<std::size_t>(run);
    aside[r] = outlying(prepared(run), model_of(run));
    for (std::size_t i = 0; i < aside[r].size(); ++i) aside[r][i] = std::max(aside[r][i], masked_[r][i]);
  });
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (aside[r] == runs_[r].set_aside) continue;
    runs_[r].set_aside = std::move(aside[r]);
    linearised_at_.reset();
  }
}

void JointModel::readmit(int run, double time_s) {
  constexpr std::ptrdiff_t kFew = 5;  // one more than are set aside in a row
  const auto r = static_cast<std::size_t>(run);
  InnovationRun& of = runs_[r];
  const auto behind = std::lower_bound(of.truth.begin(), of.truth.end(), time_s + clock_s[r],
                                       [](const TruthSample& t, double s) { return t.time_s < s; }) -
                      of.truth.begin();
  const auto n = static_cast<std::ptrdiff_t>(of.truth.size());
  for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, behind - kFew); i < std::min(n, behind + kFew); ++i) {
    char& aside = of.set_aside[static_cast<std::size_t>(i)];
    if (aside == masked_[r][static_cast<std::size_t>(i)]) continue;
    aside = masked_[r][static_cast<std::size_t>(i)];
    linearised_at_.reset();
  }
}

void JointModel::leave_out(int run, double from_s, double to_s) {
  const auto r = static_cast<std::size_t>(run);
  const auto set_aside = [&](InnovationRun& of) {
    for (std::size_t i = 0; i < of.truth.size(); ++i) {
      const double at_s = of.truth[i].time_s - clock_s[r];
      if (at_s >= from_s && at_s <= to_s) of.set_aside[i] = 1;
    }
  };
  set_aside(runs_[r]);
  masked_[r] = runs_[r].set_aside;
  if (runs_[r].as_recorded) {
    InnovationRun all = *runs_[r].as_recorded;
    set_aside(all);
    runs_[r].as_recorded = std::make_shared<const InnovationRun>(std::move(all));
  }
  linearised_at_.reset();
}

}  // namespace odolab
