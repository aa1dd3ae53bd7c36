#include "core/calibration/turned_mounting.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/calibration/run_fit.h"
#include "core/geometry/angles.h"
#include "core/odometry/differential_drive.h"

namespace odolab {

namespace {

// Where a run came to, against where its truth says, each as seen from how it stood at first: that is enough of one
// that is measured at both ends alone, if it came far. Nothing where both do not come equally far.
std::optional<double> turned_by_ends(const Recording& recording, const DifferentialDrive& drive) {
  constexpr double kFar_m = 0.5, kAsFar = 0.15;
  const std::vector<WheelSample> wheels = wheel_samples(recording, drive);
  const std::vector<TruthSample> truth = truth_samples(recording);
  if (wheels.size() < 2 || truth.size() < 2 || !truth.front().heading_rad) return std::nullopt;
  const Pose came_to = dead_reckoned(wheels, drive, Pose{}).back().pose;
  const Vec2 by_wheels{came_to.x_m, came_to.y_m},
      by_truth = rotated(truth.back().position - truth.front().position, -*truth.front().heading_rad);
  if (length(by_wheels) < kFar_m || std::abs(length(by_truth) - length(by_wheels)) > kAsFar * length(by_wheels))
    return std::nullopt;
  return wrapped(std::atan2(by_wheels.y_m, by_wheels.x_m) - std::atan2(by_truth.y_m, by_truth.x_m));
}

// As one run has it: on circles alone a point that is turned is nearly one that sits elsewhere.
struct TurnedBy {
  double by_rad = 0.0, stderr_rad = 0.0;
};

// Of angles that lie near each other, wherever the count of turns begins.
double middle_angle_rad(const std::vector<TurnedBy>& turned) {
  Vec2 sum;
  for (const TurnedBy& t : turned) sum = sum + Vec2{std::cos(t.by_rad), std::sin(t.by_rad)};
  return std::atan2(sum.y_m, sum.x_m);
}

constexpr double kFar_rad = 1.0;  // from what the file says, so that no fit finds the way there

// Those that know it about as well as the one that knows it best, or well enough; none that does not even know whether
// it is so far off.
void keep_those_that_know(std::vector<TurnedBy>& turned) {
  constexpr double kWell_rad = 0.1, kAboutAsWell = 3.0, kHardly_rad = kFar_rad / 3.0;
  std::erase_if(turned, [&](const TurnedBy& t) { return !(t.stderr_rad < kHardly_rad); });
  double best_rad = 1e300;
  for (const TurnedBy& t : turned) best_rad = std::min(best_rad, t.stderr_rad);
  std::erase_if(turned, [&](const TurnedBy& t) { return t.stderr_rad > std::max(kWell_rad, kAboutAsWell * best_rad); });
}

// Those that are alike, where two of three and more are: what a run on few arcs makes of it may be off by more than it
// says. None where they are not.
std::vector<TurnedBy> those_alike(const std::vector<TurnedBy>& turned) {
  constexpr double kAlike_rad = 0.2;
  std::vector<TurnedBy> most;
  for (const TurnedBy& one : turned) {
    std::vector<TurnedBy> alike;
    for (const TurnedBy& other : turned)
      if (std::abs(wrapped(other.by_rad - one.by_rad)) <= kAlike_rad) alike.push_back(other);
    if (alike.size() > most.size()) most = std::move(alike);
  }
  return 3 * most.size() >= 2 * turned.size() ? most : std::vector<TurnedBy>{};
}

}  // namespace

Vehicle turned_as_driven(const std::vector<Recording>& recordings, const Vehicle& nominal) {
  constexpr double kExplained = 0.9, kByEnds_rad = 0.2;
  if (!std::holds_alternative<DifferentialDrive>(nominal.kind)) return nominal;
  std::vector<std::optional<RunFit>> fits(recordings.size());
  parallel_for(static_cast<int>(fits.size()), [&](int i) {
    const auto r = static_cast<std::size_t>(i);
    if (problems_in(recordings[r]).empty()) fits[r] = run_fit(recordings[r], nominal);
  });
  std::vector<TurnedBy> turned_by;
  for (const std::optional<RunFit>& fit : fits)
    if (fit && fit->drives && fit->turns && fit->way_explained >= kExplained && fit->turn_explained >= kExplained &&
        fit->turn_ratio > 0.0)
      turned_by.push_back({fit->axle_T_tracked.heading_rad, fit->mounting_stderr.heading_rad});
  constexpr std::size_t kFewest = 2;  // measured at both ends alone, where there are no others
  const bool by_ends = turned_by.empty();
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    if (fits[r] || !problems_in(recordings[r]).empty()) continue;
    const std::optional<double> own_rad = turned_by_ends(recordings[r], std::get<DifferentialDrive>(nominal.kind));
    if (own_rad) turned_by.push_back({*own_rad, kByEnds_rad});
  }
  if (by_ends && turned_by.size() < kFewest) return nominal;
  keep_those_that_know(turned_by);
  turned_by = those_alike(turned_by);
  const double middle_rad = middle_angle_rad(turned_by);
  Vehicle turned = nominal;
  double& heading_rad = turned.truth.axle_T_tracked.heading_rad;
  if (!turned_by.empty() && std::abs(wrapped(middle_rad - heading_rad)) > kFar_rad) heading_rad = middle_rad;
  return turned;
}

}  // namespace odolab
