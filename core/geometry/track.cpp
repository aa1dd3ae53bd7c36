#include "core/geometry/track.h"

#include <algorithm>

namespace odolab {

namespace {

Pose interpolated(const TimedPose& a, const TimedPose& b, double time_s) {
  const double span = b.time_s - a.time_s;
  const double u = span > 0.0 ? (time_s - a.time_s) / span : 0.0;
  return {a.pose.x_m + u * (b.pose.x_m - a.pose.x_m), a.pose.y_m + u * (b.pose.y_m - a.pose.y_m),
          a.pose.heading_rad + u * (b.pose.heading_rad - a.pose.heading_rad)};
}

}  // namespace

std::optional<Pose> pose_at(const Track& track, double time_s) {
  if (track.empty() || time_s < track.front().time_s || time_s > track.back().time_s) return std::nullopt;
  const auto after =
      std::lower_bound(track.begin(), track.end(), time_s, [](const TimedPose& p, double t) { return p.time_s < t; });
  if (after == track.begin()) return after->pose;
  return interpolated(*(after - 1), *after, time_s);
}

void unwrap_headings(Track& track) {
  for (std::size_t i = 1; i < track.size(); ++i)
    track[i].pose.heading_rad = unwrapped(track[i].pose.heading_rad, track[i - 1].pose.heading_rad);
}

double travelled_m(const Track& track) {
  double sum = 0.0;
  for (std::size_t i = 1; i < track.size(); ++i) sum += length(track[i].pose.position() - track[i - 1].pose.position());
  return sum;
}

std::optional<TrackError> track_error(const Track& estimate, const Track& reference, const std::vector<char>& anew) {
  Track truth, guess;
  std::vector<char> starts;
  std::size_t k = 1;  // both are in order of time, so one walk suffices
  if (estimate.size() < 2) return std::nullopt;
  for (std::size_t n = 0; n < reference.size(); ++n) {
    const TimedPose& r = reference[n];
    if (r.time_s < estimate.front().time_s || r.time_s > estimate.back().time_s) continue;
    while (k + 1 < estimate.size() && estimate[k].time_s < r.time_s) ++k;
    truth.push_back(r);
    starts.push_back(!anew.empty() && anew[n]);
    guess.push_back({r.time_s, interpolated(estimate[k - 1], estimate[k], r.time_s)});
  }
  if (truth.size() < 2) return std::nullopt;

  const auto error_since = [&](std::size_t from, std::size_t to) {
    return between(between(truth[from].pose, truth[to].pose), between(guess[from].pose, guess[to].pose));
  };
  TrackError error;
  double position_sum = 0.0, heading_sum = 0.0;
  double travel_m = 0.0, turn_rad = 0.0;
  std::size_t start = 0, first = 0;
  Pose counted = truth[0].pose;  // travel is counted in strides, so that a noisy truth at rest does not travel
  for (std::size_t i = 1; i < truth.size(); ++i) {
    if (starts[i]) {
      start = first = i;
      counted = truth[i].pose;
      travel_m = turn_rad = 0.0;
      continue;
    }
    const double stride_m = length(truth[i].pose.position() - counted.position());
    const double stride_rad = std::abs(wrapped(truth[i].pose.heading_rad - counted.heading_rad));
    if (stride_m > 0.01 || stride_rad > 0.03) {
      travel_m += stride_m;
      turn_rad += stride_rad;
      counted = truth[i].pose;
    }
    if (travel_m >= 1.0 || turn_rad >= 1.0 || (i + 1 == truth.size() && error.windows == 0)) {
      Pose e = error_since(start, i);
      e.heading_rad = wrapped(e.heading_rad);
      position_sum += dot(e.position(), e.position());
      heading_sum += e.heading_rad * e.heading_rad;
      ++error.windows;
      error.window_error.push_back(e);
      error.window_s.emplace_back(truth[start].time_s, truth[i].time_s);
      start = i;
      travel_m = turn_rad = 0.0;
    }
    const Pose e = error_since(first, i);
    error.largest_position_m = std::max(error.largest_position_m, length(e.position()));
    error.end_position_m = length(e.position());
    error.end_heading_rad = wrapped(e.heading_rad);
  }
  if (error.windows == 0) return std::nullopt;
  error.position_rms_m = std::sqrt(position_sum / error.windows);
  error.heading_rms_rad = std::sqrt(heading_sum / error.windows);
  return error;
}

}  // namespace odolab
