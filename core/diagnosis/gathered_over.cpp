#include "core/diagnosis/gathered_over.h"

#include "core/odometry/prediction.h"

namespace odolab {

namespace {

// Of places alone, too, whose windows are as long as their way.
Track truth_with_any_heading(const Recording& recording) {
  Track track = truth_track(recording);
  if (track.size() < 2) {
    track.clear();
    for (const TruthSample& s : truth_samples(recording))
      track.push_back({s.time_s, {s.position.x_m, s.position.y_m, s.heading_rad.value_or(0.0)}});
  }
  return track;
}

}  // namespace

std::optional<WindowSize> gathered_over(const std::vector<Recording>& recordings, const Vehicle& vehicle) {
  std::vector<WindowSize> windows;
  for (const Recording& recording : recordings) {
    const Result<Track> track = predicted_track(recording, vehicle);
    if (!track) continue;
    const std::optional<TrackError> error = track_error(*track, truth_with_any_heading(recording));
    if (!error) continue;
    const std::vector<WindowSize> of_it = window_sizes(*track, *error);
    windows.insert(windows.end(), of_it.begin(), of_it.end());
  }
  if (windows.empty()) return std::nullopt;
  return median_of(windows);
}

}  // namespace odolab
