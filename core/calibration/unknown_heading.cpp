#include "core/calibration/unknown_heading.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"

namespace odolab {

UnknownHeading heading_from_shape(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                                  int first, int last) {
  constexpr double kTimes = 10.0, kLeast_rad = 0.1;
  double cosine = 0.0, sine = 0.0, travelled = 0.0, square_m2 = 0.0;
  int samples = 0;
  Pose pose;
  const Vec2 m = model.truth.axle_T_tracked.position(), start = pose * m;
  for (int t = first; t + 1 < last && !is_cut(run, t + 1); ++t) {
    pose = pose * summed.motions[t].motion;
    travelled += length(summed.motions[t].motion.position());
    if (run.set_aside[t + 1]) continue;
    const Vec2 guess = pose * m - start, truth = run.truth[t + 1].position - run.truth[first].position;
    cosine += dot(guess, truth);
    sine += cross(guess, truth);
    square_m2 += dot(guess, guess);
    ++samples;
    if (travelled > 2.0 && std::hypot(cosine, sine) > 0.5) break;
  }
  UnknownHeading heading{std::atan2(sine, cosine), 1.0};
  if (square_m2 > 0.0) {
    heading.reach_m = std::sqrt(square_m2 / samples);
    heading.stderr_rad = std::clamp(kTimes * model.noise.truth_position_m / heading.reach_m, kLeast_rad, 1.0);
  }
  return heading;
}

bool may_leave_heading_open(const InnovationRun& run) {
  constexpr std::size_t kMost = 50;
  return !run.truth_has_heading && run.truth.size() <= kMost;
}

std::vector<UnknownHeading> headings_all_around(const InnovationRun& run, const SummedRun& summed,
                                                const InnovationModel& model, int first, int last) {
  constexpr int kAround = 32;
  constexpr double kNear = 10.0;  // times the noise of a place
  if (!may_leave_heading_open(run)) return {};
  const UnknownHeading found = heading_from_shape(run, summed, model, first, last);
  if (found.reach_m > kNear * model.noise.truth_position_m) return {};
  std::vector<UnknownHeading> around;
  for (int k = 0; k < kAround; ++k)
    around.push_back({found.guess_rad + 2.0 * kPi * k / kAround, 2.0 * kPi / kAround, found.reach_m});
  return around;
}

HeadingsWeighed headings_weighed(const std::vector<double>& minus_two_log_likelihoods) {
  const double least = *std::min_element(minus_two_log_likelihoods.begin(), minus_two_log_likelihoods.end());
  HeadingsWeighed out;
  double sum = 0.0;
  for (double of_one : minus_two_log_likelihoods) {
    out.weight.push_back(std::exp(0.5 * (least - of_one)));
    sum += out.weight.back();
  }
  for (double& w : out.weight) w /= sum;
  const double mean = sum / static_cast<double>(out.weight.size());
  out.minus_two_log_likelihood = least - 2.0 * std::log(mean) - std::log(2.0 * kPi);  // as of one heading, Eq. 7
  return out;
}

}  // namespace odolab
