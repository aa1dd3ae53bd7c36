// Noise and outliers of the joint model: what the calibration and the effects leave is random, and how large it is.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "core/base/parallel.h"
#include "core/calibration/noise_fit.h"
#include "core/calibration/thinned_truth.h"
#include "core/diagnosis/model/joint_model.h"
#include "core/diagnosis/model/outlying.h"

namespace odolab {

namespace {

constexpr int kNoiseSamplesOfAll = 5000;

// Whether the place that the truth's frame is off by is no small part of a sample's error. `recorded`: what a sample
// errs by, in times the white noise.
bool is_off_by_much(const FittedNoise& noise, double recorded) {
  constexpr double kNoSmallPart = 0.7;
  const double off_m = noise.wander_m_per_sqrt_s * std::sqrt(0.5 * noise.wander_lasts_s);
  return off_m > kNoSmallPart * recorded * noise.truth_position_m;
}

// The noise with the time after which the truth's frame comes back, where it does: where that is far likelier than that
// it never does, and the frame is off by much: less may be something that sways, and is asked later; a heading alone
// that is off for a while may be the vehicle's.
FittedNoise with_its_time(const FittedNoise& never, double recorded,
                          const std::function<FittedNoise(const FittedNoise&)>& fitted,
                          const std::function<double(const FittedNoise&)>& minus_two_log_likelihood) {
  constexpr double kTimes_s[] = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
  constexpr int kFirst = 3, kLast = static_cast<int>(std::size(kTimes_s)) - 1;
  constexpr double kFarLikelier = 20.0;
  const double of_never = minus_two_log_likelihood(never);
  FittedNoise still = never;
  still.wander_m_per_sqrt_s = still.heading_wander_rad_per_sqrt_s = 0.0;
  if (minus_two_log_likelihood(as_large_as_any_real(still)) < of_never + kFarLikelier) return never;
  struct Lasting {
    FittedNoise noise;
    double value;
  };
  // From next to nothing a fit would not come back.
  const auto lasting = [&](FittedNoise from, double time_s) {
    from.wander_lasts_s = time_s;
    const double half = 0.5 * std::sqrt(2.0 / time_s);
    from.wander_m_per_sqrt_s = std::max(from.wander_m_per_sqrt_s, half * from.truth_position_m);
    from.heading_wander_rad_per_sqrt_s = std::max(from.heading_wander_rad_per_sqrt_s, half * from.truth_heading_rad);
    const FittedNoise noise = fitted(from);
    return Lasting{noise, minus_two_log_likelihood(noise)};
  };
  Lasting best = lasting(never, kTimes_s[kFirst]);
  int at = kFirst;
  for (const int by : {-1, 1}) {
    while (at + by >= 0 && at + by <= kLast) {
      const Lasting next = lasting(best.noise, kTimes_s[at + by]);
      if (next.value >= best.value) break;
      best = next;
      at += by;
    }
    if (at != kFirst) break;
  }
  return is_off_by_much(best.noise, recorded) && best.value < of_never - kFarLikelier ? best.noise : never;
}

}  // namespace

void JointModel::fit_noise() {
  cut();
  constexpr double kWay_m = 0.1;
  constexpr double kSampledWithin = 0.5;  // of logarithms: a factor of 1.6
  struct Part {
    int of;  // which run
    const InnovationRun* run;
    const SummedRun* summed;
  };
  // On these runs, of which every so many stretches are used.
  const auto likelihood_of = [&](const std::vector<Part>& parts, const NoiseFit& fit, const FittedNoise& noise) {
    constexpr int kStretch = 250;
    int samples = 0;
    std::vector<const InnovationRun*> all;
    for (const Part& part : parts) {
      samples += static_cast<int>(part.run->truth.size());
      all.push_back(part.run);
    }
    const int every = std::max(1, samples / kNoiseSamplesOfAll);
    const double parameters = columns_fitted();
    const std::vector<NoiseStretch> stretches = noise_stretches(all, every, kStretch);
    std::vector<NoiseSlopes> of_stretch(stretches.size());
    const auto add_up = [&](int i) {
      const NoiseStretch& s = stretches[static_cast<std::size_t>(i)];
      const Part& part = parts[static_cast<std::size_t>(s.run)];
      InnovationModel m = model_of(part.of);
      m.noise = noise;
      of_stretch[static_cast<std::size_t>(i)] = noise_slopes(*part.run, *part.summed, m, s.first, s.last);
    };
    if (samples > kNoiseSamplesOfAll || noise.wander_lasts_s > 0.0)
      parallel_for(static_cast<int>(stretches.size()), add_up);
    else  // not worth starting threads for
      for (std::size_t i = 0; i < stretches.size(); ++i) add_up(static_cast<int>(i));
    NoiseSlopes sum;
    for (const NoiseSlopes& s : of_stretch) sum.add(s);
    // The freedom that the parameters took, as an average: exact where all sizes move together.
    if (every == 1 && sum.scalars > 2 * parameters)
      for (int k = 0; k < 2; ++k) {
        FittedNoise at = noise;
        sum.value -= parameters * std::log(size_of(at, fit.free[k]));
        sum.slope[fit.free[k]] -= parameters;
      }
    return sum;
  };
  const auto fitted = [&](const std::vector<Part>& parts, const NoiseFit& fit, const FittedNoise& from) {
    return most_likely_noise([&](const FittedNoise& noise) { return likelihood_of(parts, fit, noise); }, from, fit);
  };
  bool any_heading = false, any_commands = false;
  int truth_samples = 0;
  std::vector<Part> whole;
  for (const LinearisedRun& l : now_->runs) {
    whole.push_back({static_cast<int>(whole.size()), &l.run(), &l.summed()});
    truth_samples += static_cast<int>(l.run().truth.size());
    any_heading = any_heading || l.run().truth_has_heading;
    any_commands = any_commands || l.run().speeds_are_held;
  }
  NoiseFit of_samples{{noise_size::wheel, noise_size::position}, kUsualNoise};
  of_samples.expect_usual_truth_of(truth_samples);
  of_samples.add_body();
  of_samples.add_wander(any_heading);
  if (any_commands) of_samples.add_timing();
  if (any_heading) of_samples.free.push_back(noise_size::heading);
  model.noise = fitted(whole, of_samples, model.noise);
  const double recorded = noise_as_recorded().truth_position_m / model.noise.truth_position_m;
  if (std::exchange(truth_may_come_back, false))
    model.noise = with_its_time(
        model.noise, recorded, [&](const FittedNoise& from) { return fitted(whole, of_samples, from); },
        [&](const FittedNoise& noise) { return likelihood_of(whole, of_samples, noise).value; });
  if (model.noise.wander_lasts_s > 0.0 && !is_off_by_much(model.noise, recorded)) {  // it was what has a name now
    model.noise.wander_lasts_s = 0.0;
    model.noise = fitted(whole, of_samples, model.noise);
  }
  // The truth's noise shows from sample to sample; the floor's in what it adds up to, as far as that is more than the
  // samples say: of a small sideways noise it says nothing.
  std::vector<ThinnedTruth> thin(whole.size());
  std::vector<Part> thinned;
  int left = 0;
  for (std::size_t r = 0; r < whole.size(); ++r) {
    thin[r] = thinned_truth(*whole[r].run, *whole[r].summed, model_of(static_cast<int>(r)), kWay_m);
    if (thin[r].run.truth.size() < 2) continue;  // it hardly moved
    thinned.push_back({static_cast<int>(r), &thin[r].run, &thin[r].summed});
    left += static_cast<int>(thin[r].run.truth.size());
  }
  if (left <= 3 * columns()) return;
  NoiseFit of_ways{{noise_size::wheel}, model.noise, kSampledWithin};
  of_ways.add_body();
  of_ways.add_wander(any_heading);
  if (any_commands) of_ways.add_timing();
  of_ways.usual_of_body = 0.0;  // what is usual is what the samples said
  model.noise = fitted(thinned, of_ways, model.noise);
}

int JointModel::scalars_on_the_way() const {
  constexpr double kRolls_m = 0.02;
  int sum = 0;
  for (std::size_t r = 0; r < now_->runs.size(); ++r) {
    const LinearisedRun& l = now_->runs[r];
    const ThinnedTruth thin = thinned_truth(l.run(), l.summed(), model_of(static_cast<int>(r)), kRolls_m);
    const int each = l.run().truth_has_heading ? 3 : 2;
    sum += each * std::max(0, static_cast<int>(thin.run.truth.size()) - 1);
  }
  return sum;
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
  const auto behind = std::lower_bound(of.truth.begin(), of.truth.end(), clocks(run).truth_stamp_s(time_s),
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
  const TwoClocks own = clocks(run);
  const auto set_aside = [&](InnovationRun& of) {
    for (std::size_t i = 0; i < of.truth.size(); ++i) {
      const double at_s = own.wheels_stamp_s(of.truth[i].time_s);
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
