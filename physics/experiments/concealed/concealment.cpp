#include "physics/experiments/concealed/concealment.h"

#include <algorithm>
#include <cmath>

#include "core/odometry/prediction.h"
#include "physics/experiments/concealed/oracle.h"

namespace odolab::concealed {

namespace {

constexpr double kFitsAsWell = 1.05, kPredictsWorse = 1.2;  // ratios of root mean squares
constexpr double kHalfTheNoise = 0.25;                      // of mean squares
constexpr double kActs = 0.05, kSeldom = 0.1, kCancels = 0.25;

std::vector<double> ones(const Run& run) { return std::vector<double>(run.known.extra.size(), 1.0); }

// Share of the time in which an effect does more than a twentieth of its most, by the way of the wheels' contacts.
double share_of_time(const std::vector<Run>& runs, std::size_t effect, double arm_m) {
  double most = 0.0;
  std::vector<double> all;
  for (const Run& run : runs)
    for (const BodyMotion& m : run.known.extra[effect].per_step) {
      all.push_back(std::hypot(m.forward_m, m.sideways_m, arm_m * m.turn_rad));
      most = std::max(most, all.back());
    }
  const auto acting = std::count_if(all.begin(), all.end(), [&](double a) { return a > kActs * most; });
  return all.empty() ? 0.0 : static_cast<double>(acting) / static_cast<double>(all.size());
}

// How far the end of a run is moved by effects of these sizes, as dead reckoning with the true drive sees it.
Vec2 end_of(const Run& run, const InnovationModel& truth, const std::vector<double>& size) {
  return oracle_track(run.known, truth, size).back().pose.position();
}

bool cancels(const DrawnCase& c) {
  if (c.effects.size() < 2) return false;
  const InnovationModel truth = c.truth();
  for (const Run& run : c.given) {
    const Vec2 none = end_of(run, truth, {0.0, 0.0});
    const double both = length(end_of(run, truth, {1.0, 1.0}) - none);
    const double each =
        std::min(length(end_of(run, truth, {1.0, 0.0}) - none), length(end_of(run, truth, {0.0, 1.0}) - none));
    if (each > 0.002 && both < kCancels * each) return true;
  }
  return false;
}

}  // namespace

void SquaredError::add(const Track& estimate, const Track& reference, double arm_m) {
  const std::optional<TrackError> e = track_error(estimate, reference);
  if (!e || e->windows == 0) return;
  const double turned_m = arm_m * e->heading_rms_rad;
  sum_m2 += e->windows * (e->position_rms_m * e->position_rms_m + turned_m * turned_m);
  windows += e->windows;
}

Track true_tracked(const Run& run) {
  Track track;
  for (std::size_t i = 0; i < run.driven.true_axle.size(); i += 10)
    track.push_back({run.driven.true_axle[i].time_s,
                     run.driven.true_axle[i].pose * run.plan.robot.scenario.vehicle.truth.axle_T_tracked});
  return track;
}

Concealment concealment(const DrawnCase& c, const FittedModel& calibrated) {
  Concealment out;
  if (c.effects.empty()) return out;
  const double arm_m = 0.5 * c.robot.scenario.actual.wheelbase_m;
  const InnovationModel truth = c.truth();
  SquaredError given, given_best, held, held_best;
  const auto add = [&](const Run& run, SquaredError& by_calibration, SquaredError& by_truth) {
    const Track measured = truth_track(run.driven.recording);
    const Result<Track> track = predicted_track(run.driven.recording, calibrated.vehicle_in(run.driven.recording.name));
    if (track) by_calibration.add(*track, measured, arm_m);
    by_truth.add(oracle_track(run.known, truth, ones(run)), measured, arm_m);
  };
  for (const Run& run : c.given) add(run, given, given_best);
  for (const Run& run : c.held_out) add(run, held, held_best);
  const double fit = given.mean() / given_best.mean(), prediction = held.mean() / held_best.mean();
  out.absorbed = fit < kFitsAsWell * kFitsAsWell && prediction > kPredictsWorse * kPredictsWorse;
  out.under_noise = fit < 1.0 + kHalfTheNoise;
  out.seldom = true;
  for (std::size_t k = 0; k < c.effects.size(); ++k)
    out.seldom = out.seldom && share_of_time(c.given, k, arm_m) < kSeldom;
  out.cancels = cancels(c);
  return out;
}

}  // namespace odolab::concealed
