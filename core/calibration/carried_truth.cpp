#include "core/calibration/carried_truth.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/formatted.h"
#include "core/base/quantile.h"
#include "core/geometry/small_turn.h"
#include "core/recording/truth_left_out.h"

namespace odolab {

namespace {

// What each step goes sideways at its mean heading, beyond the share of its way, its turn and both together that a
// tracked point beside the axle, and odometry that goes by its first heading, add to most steps.
class SidewaysSteps {
 public:
  explicit SidewaysSteps(const std::vector<TruthSample>& truth) {
    const auto n = static_cast<Eigen::Index>(truth.size()) - 1;
    by_.resize(n, 3);
    sideways_m_.resize(n);
    step_m_ = 1.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const TruthSample &a = truth[static_cast<std::size_t>(i)], &b = truth[static_cast<std::size_t>(i) + 1];
      const double turn = wrapped(*b.heading_rad - *a.heading_rad), mean = *a.heading_rad + 0.5 * turn;
      const Vec2 by = b.position - a.position;
      const double ahead_m = by.x_m * std::cos(mean) + by.y_m * std::sin(mean);
      by_.row(i) << ahead_m, turn, ahead_m * turn;
      sideways_m_(i) = by.y_m * std::cos(mean) - by.x_m * std::sin(mean);
      if (by.x_m != 0.0) step_m_ = std::min(step_m_, std::abs(by.x_m));
    }
    off_m_ = without_what_most_share();
  }

  bool are_computed() const {
    constexpr double kLeastMeasured_m = 1e-5;  // cameras on a bench err by more
    constexpr int kFewest = 100;
    int moving = 0;
    for (Eigen::Index i = 0; i < off_m_.size(); ++i) moving += std::abs(by_(i, 0)) > kLeastMeasured_m;
    return moving >= kFewest && step_m_ <= kLeastMeasured_m && root_mean_square_m() <= kLeastMeasured_m;
  }

  // Of each step, beyond chance; none of a truth that is measured.
  std::optional<std::vector<char>> corrections() const {
    constexpr double kNothing = 0.02;    // of the root mean square; 2 in 100 steps of a measured truth are less
    constexpr double kByRounding = 1.5;  // steps of its numbers
    constexpr double kBeyond = 3.0;      // that a usual correction is larger than that
    constexpr double kMost = 0.6, kAlone = 0.8;
    constexpr std::ptrdiff_t kFewest = 10;
    const double nothing_m = std::max(kNothing * root_mean_square_m(), kByRounding * step_m_);
    const auto n = static_cast<std::size_t>(off_m_.size());
    std::vector<char> corrected(n);
    std::ptrdiff_t moving = 0, carried = 0, alone = 0;
    std::vector<double> corrections_m;
    for (std::size_t i = 0; i < n; ++i) {
      const double off_m = std::abs(off_m_(static_cast<Eigen::Index>(i)));
      corrected[i] = off_m > nothing_m;
      if (corrected[i]) corrections_m.push_back(off_m);
      if (std::abs(by_(static_cast<Eigen::Index>(i), 0)) <= kByRounding * step_m_) continue;
      ++moving;
      carried += !corrected[i];
    }
    for (std::size_t i = 0; i < n; ++i)
      alone += corrected[i] && (i == 0 || !corrected[i - 1]) && (i + 1 == n || !corrected[i + 1]);
    const std::ptrdiff_t count = std::ssize(corrections_m);
    if (count < kFewest || static_cast<double>(carried) < kMost * static_cast<double>(moving) ||
        static_cast<double>(alone) < kAlone * static_cast<double>(count) ||
        quantile(corrections_m, 0.5) < kBeyond * nothing_m)
      return std::nullopt;
    return corrected;
  }

 private:
  double root_mean_square_m() const { return std::sqrt(off_m_.squaredNorm() / static_cast<double>(off_m_.size())); }

  // Least absolute deviations, by least squares with weights.
  Eigen::VectorXd without_what_most_share() const {
    constexpr int kRounds = 20;
    constexpr double kLeast_m = 1e-9;
    Eigen::VectorXd off_m = sideways_m_;
    for (int round = 0; round < kRounds; ++round) {
      const Eigen::VectorXd weight = (off_m.cwiseAbs().array() + kLeast_m).inverse();
      const Eigen::Matrix3d normal = by_.transpose() * weight.asDiagonal() * by_;
      const Eigen::Vector3d share = normal.ldlt().solve(by_.transpose() * weight.cwiseProduct(sideways_m_));
      if (!share.allFinite()) return sideways_m_;
      off_m = sideways_m_ - by_ * share;
    }
    return off_m;
  }

  Eigen::Matrix<double, Eigen::Dynamic, 3> by_;  // metres ahead, radians, their product
  Eigen::VectorXd sideways_m_, off_m_;
  double step_m_ = 0.0;  // of the numbers
};

// Of a truth that is long enough and has headings.
std::optional<SidewaysSteps> steps_of(const std::vector<TruthSample>& truth) {
  constexpr std::size_t kFewest = 100;
  if (truth.size() < kFewest ||
      !std::all_of(truth.begin(), truth.end(), [](const TruthSample& s) { return s.heading_rad.has_value(); }))
    return std::nullopt;
  return SidewaysSteps(truth);
}

std::string name_to_blame(const Recording& recording) {
  return recording.name.empty() ? "the recording" : recording.name;
}

}  // namespace

std::optional<std::string> warning_of_computed_truth(const Recording& recording) {
  const std::optional<SidewaysSteps> steps = steps_of(truth_samples(recording));
  if (!steps || !steps->are_computed()) return std::nullopt;
  return name_to_blame(recording) +
         ": the truth never errs sideways, not by a hundredth of a millimetre: it is computed, as a robot's own "
         "odometry is, or simulated without noise, and tells of the floor only what that knows";
}

std::optional<MeasuredRecording> without_carried_truth(const Recording& recording) {
  const std::vector<TruthSample> truth = truth_samples(recording);
  const std::optional<SidewaysSteps> steps = steps_of(truth);
  if (!steps) return std::nullopt;
  const std::optional<std::vector<char>> corrected = steps->corrections();
  if (!corrected) return std::nullopt;
  std::vector<double> carried_s;
  for (std::size_t i = 0; i < corrected->size(); ++i)
    if (!(*corrected)[i]) carried_s.push_back(truth[i + 1].time_s);
  MeasuredRecording out{recording, name_to_blame(recording)};
  std::vector<char> carried;
  for (const double t : recording.time_s) carried.push_back(std::binary_search(carried_s.begin(), carried_s.end(), t));
  leave_truth_out(out.recording, carried);
  const std::string text = formatted(
      ": %.0f %% of the truth's samples go on from the one before along a circle, to a hundredth of what the "
      "others are off: it is no measurement but odometry that is put right now and then, as by a map or a "
      "filter; only the %zu corrections are used",
      100.0 * static_cast<double>(carried_s.size()) / static_cast<double>(truth.size()),
      truth.size() - carried_s.size());
  out.said += text;
  return out;
}

}  // namespace odolab
