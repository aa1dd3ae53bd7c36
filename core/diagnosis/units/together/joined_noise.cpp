// How large the random errors are, and whether the truth's frame wanders: by the likelihood of all recordings.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/units/together/joined_model.h"

namespace odolab {

double JoinedModel::fit_sizes(const std::vector<NoiseSize>& sizes) {
  constexpr double kStep = 1.15;  // a size is known no better
  constexpr int kMostRounds = 5;  // of each size, beside the others as they are then
  double here = minus_two_log_likelihood(noise_);
  const auto goes_downhill = [&](const NoiseSize& one, double factor) {
    JoinedNoise other = noise_;
    other.*one.of = std::clamp(other.*one.of * factor, one.least, one.most);
    const double there = minus_two_log_likelihood(other);
    if (there >= here) return false;
    noise_ = other, here = there;
    return true;
  };
  bool moved = true;
  for (int round = 0; round < kMostRounds && moved; ++round) {
    moved = false;
    for (const NoiseSize& one : sizes) {
      bool up = false, down = false;
      for (double factor = kStep; goes_downhill(one, factor); factor *= factor) up = true;
      for (double factor = kStep; !up && goes_downhill(one, 1.0 / factor); factor *= factor) down = true;
      moved = moved || up || down;
    }
  }
  return here;
}

void JoinedModel::fit_noise() {
  std::vector<NoiseSize> all = {{&JoinedNoise::wheel_m_per_sqrt_m, 2e-5, 2e-2},
                                {&JoinedNoise::joint_steps, 0.29, 20.0},
                                {&JoinedNoise::apart_m, 2e-5, 5e-3},
                                {&JoinedNoise::sideways_m_per_sqrt_m, 2e-5, 1e-2}};
  const std::vector<NoiseSize> of_truth = sizes_of_truth();
  all.insert(all.end(), of_truth.begin(), of_truth.end());
  fit_sizes(all);
  linearise();
  if (!has_truth_ || follows_truth_) return;
  const double left = share_of_ends_left();
  noise_.truth_position_m /= left;
  noise_.truth_heading_rad /= left;
  linearise();
}

// Poses at both ends are few: what the model took of them to fit itself makes what is left small.
double JoinedModel::share_of_ends_left() const {
  constexpr double kLeastLeft = 3.0;
  const Eigen::Index reading = filters_.front().rows();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(z_.cols(), z_.cols());
  double numbers = 0.0;
  for (Eigen::Index of_truth = reading - 3; of_truth < z_.rows(); of_truth += reading) {
    if ((residual_.segment<3>(of_truth).array() == 0.0).all()) continue;  // no sample of it
    const auto rows = z_.middleRows<3>(of_truth);
    information += rows.transpose() * rows;
    numbers += static_cast<double>((residual_.segment<3>(of_truth).array() != 0.0).count());
  }
  numbers -= 3.0 * static_cast<double>(filters_.size());  // where each run begins says nothing
  const double taken = gram_.solve(information).trace();
  return std::sqrt(std::max(numbers - taken, kLeastLeft) / std::max(numbers, kLeastLeft));
}

std::vector<JoinedModel::NoiseSize> JoinedModel::sizes_of_truth() const {
  std::vector<NoiseSize> sizes;
  if (!has_truth_) return sizes;
  const bool wanders = noise_.wander_m_per_sqrt_s > 0.0;
  // A few poses, put down by hand, are fewer than what they calibrate: that they err by less they cannot say.
  const double least_m = follows_truth_ ? 1e-4 : 3e-3, least_rad = least_m;
  sizes.push_back({&JoinedNoise::truth_position_m, least_m, 0.5});
  if (wanders) sizes.push_back({&JoinedNoise::wander_m_per_sqrt_s, 1e-5, 0.5});
  if (has_headings_) sizes.push_back({&JoinedNoise::truth_heading_rad, least_rad, 0.5});
  if (has_headings_ && wanders) sizes.push_back({&JoinedNoise::wander_rad_per_sqrt_s, 1e-6, 0.5});
  if (noise_.wander_lasts_s > 0.0) sizes.push_back({&JoinedNoise::wander_lasts_s, 0.2, 60.0});
  return sizes;
}

// Satellites, beacons and maps: where that is beyond doubt, since a frame that wanders tells less of all that lasts.
bool JoinedModel::let_frame_wander() {
  constexpr double kWorthFitting = 10.0, kSurelyBetter = 20.0;  // in twice the log-likelihood
  const double still = minus_two_log_likelihood(noise_);
  const JoinedNoise as_it_stands = noise_;
  JoinedNoise best = noise_;
  double least = still - kSurelyBetter;
  for (const double lasts_s : {0.0, 1.5}) {  // on and on, or back again
    JoinedNoise from = as_it_stands;
    double of_from = still - kWorthFitting;
    for (const double rate : {5e-4, 2e-3, 8e-3}) {
      noise_ = as_it_stands;
      noise_.wander_m_per_sqrt_s = rate;
      if (has_headings_) noise_.wander_rad_per_sqrt_s = 0.3 * rate;
      noise_.wander_lasts_s = lasts_s;
      const double here = minus_two_log_likelihood(noise_);
      if (here < of_from) of_from = here, from = noise_;
    }
    if (from.wander_m_per_sqrt_s == 0.0) continue;
    noise_ = from;
    const double here = fit_sizes(sizes_of_truth());
    if (here < least) least = here, best = noise_;
  }
  noise_ = best;
  return best.wander_m_per_sqrt_s > 0.0;
}

}  // namespace odolab
