#include "core/diagnosis/units/outside_truth.h"

#include <algorithm>

#include "core/diagnosis/quality/drawn_truth.h"

namespace odolab {

namespace {

Track tracked(const Recording& recording, bool with_headings) {
  Track track;
  const std::vector<TruthSample> truth = truth_samples(recording);
  const TimeStretches drawn = drawn_truth(truth);
  for (const TruthSample& t : truth) {
    if (with_headings && !t.heading_rad) continue;
    if (std::any_of(drawn.begin(), drawn.end(),
                    [&](const auto& gap) { return t.time_s > gap.first && t.time_s < gap.second; }))
      continue;
    const Pose pose{t.position.x_m, t.position.y_m, with_headings ? *t.heading_rad : 0.0};
    const bool repeats = !track.empty() && pose.x_m == track.back().pose.x_m && pose.y_m == track.back().pose.y_m &&
                         pose.heading_rad == track.back().pose.heading_rad;
    const bool later = track.empty() || t.time_s > track.back().time_s;
    if (later && !repeats) track.push_back({t.time_s, pose});
  }
  return track;
}

bool all_of(const std::vector<Recording>& recordings, bool (*is_so)(const Recording&)) {
  return std::all_of(recordings.begin(), recordings.end(), is_so);
}

bool has_poses(const Recording& r) { return comes_often(tracked_poses(r)); }
bool has_positions(const Recording& r) { return comes_often(tracked_positions(r)); }
bool has_ends(const Recording& r) { return tracked_poses(r).size() > 1; }

}  // namespace

Track tracked_poses(const Recording& recording) { return tracked(recording, true); }

Track tracked_positions(const Recording& recording) { return tracked(recording, false); }

Track at_least_apart(const Track& tracked, double step_s) {
  Track fewer;
  for (const TimedPose& t : tracked)
    if (fewer.empty() || t.time_s >= fewer.back().time_s + step_s) fewer.push_back(t);
  return fewer;
}

bool comes_often(const Track& t) {
  constexpr double kLongest_s = 1.0;
  return t.size() > 1 && t.back().time_s - t.front().time_s <= kLongest_s * static_cast<double>(t.size() - 1);
}

Track few_poses(Track tracked, const std::vector<UnitSample>& samples, double late_s) {
  constexpr double kStanding_s = 0.5;
  for (TimedPose& t : tracked) {
    const double first_s = samples.front().time_s + late_s, last_s = samples.back().time_s + late_s;
    if (t.time_s < first_s && t.time_s > first_s - kStanding_s) t.time_s = first_s;
    if (t.time_s > last_s && t.time_s < last_s + kStanding_s) t.time_s = last_s;
  }
  return tracked;
}

OutsideTruth outside_truth(const std::vector<Recording>& train, const std::vector<Recording>& held_out) {
  if (all_of(train, has_poses)) return OutsideTruth::poses;
  if (all_of(train, has_positions) && all_of(held_out, has_positions)) return OutsideTruth::positions;
  if (all_of(train, has_ends) && all_of(held_out, has_ends)) return OutsideTruth::ends;
  return OutsideTruth::nothing;
}

}  // namespace odolab
