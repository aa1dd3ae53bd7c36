#include "core/diagnosis/units/heading_of_way.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/geometry/angles.h"

namespace odolab {

namespace {

constexpr double kStretch_m = 1.0;
constexpr double kStraight_rad = 0.1;
constexpr std::size_t kFewest = 10;
constexpr double kHuber = 3.0;

struct Stretch {
  double off_rad = 0.0;    // of the way, from the tracked heading; the same forward and in reverse
  double curved_pm = 0.0;  // a point ahead of the axle swings out in a curve
};

// The line through the positions from one sample to another, by least squares.
std::optional<Stretch> stretch_of(const Track& track, std::size_t first, std::size_t last) {
  const double n = static_cast<double>(last - first + 1);
  Vec2 mean;
  double heading = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    mean = mean + (1.0 / n) * track[i].pose.position();
    heading += track[i].pose.heading_rad / n;
  }
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const Vec2 d = rotated(track[i].pose.position() - mean, -heading);
    xx += d.x_m * d.x_m, xy += d.x_m * d.y_m, yy += d.y_m * d.y_m;
  }
  const Vec2 way = rotated(track[last].pose.position() - track[first].pose.position(), -heading);
  const double turn = track[last].pose.heading_rad - track[first].pose.heading_rad;
  if (std::abs(turn) > kStraight_rad || std::abs(way.x_m) < 0.5 * kStretch_m) return std::nullopt;
  return Stretch{0.5 * std::atan2(2.0 * xy, xx - yy), turn / way.x_m};
}

std::vector<Stretch> stretches_of(const Track& track) {
  std::vector<Stretch> all;
  std::size_t first = 0;
  for (std::size_t i = 1; i < track.size(); ++i) {
    const Vec2 way = track[i].pose.position() - track[first].pose.position();
    if (std::abs(track[i].pose.heading_rad - track[first].pose.heading_rad) > kStraight_rad) {
      first = i;
    } else if (length(way) >= kStretch_m) {
      if (const std::optional<Stretch> s = stretch_of(track, first, i)) all.push_back(*s);
      first = i;
    }
  }
  return all;
}

}  // namespace

std::optional<HeadingOfWay> heading_of_way(const std::vector<Track>& tracked) {
  std::vector<Stretch> all;
  for (const Track& track : tracked) {
    const std::vector<Stretch> of_run = stretches_of(track);
    all.insert(all.end(), of_run.begin(), of_run.end());
  }
  if (all.size() < kFewest) return std::nullopt;
  // off = -mounting + (how far ahead of the axle) * curvature, robust against what was pushed aside.
  double mounting_rad = 0.0, ahead_m = 0.0, deviation = 0.0, stderr_rad = 0.0;
  const auto rest = [&](const Stretch& s) { return s.off_rad + mounting_rad - ahead_m * s.curved_pm; };
  for (int iteration = 0; iteration < 10; ++iteration) {
    std::vector<double> sizes;
    for (const Stretch& s : all) sizes.push_back(std::abs(rest(s)));
    deviation = std::max(1.4826 * median(std::move(sizes)), 1e-6);
    double w = 0.0, c = 0.0, cc = 1e-9, r = 0.0, cr = 0.0;
    for (const Stretch& s : all) {
      const double e = rest(s), weight = std::min(1.0, kHuber * deviation / std::max(std::abs(e), 1e-12));
      w += weight, c += weight * s.curved_pm, cc += weight * s.curved_pm * s.curved_pm;
      r += weight * e, cr += weight * s.curved_pm * e;
    }
    const double det = w * cc - c * c;
    if (!(det > 1e-12 * w * cc)) return std::nullopt;
    mounting_rad -= (cc * r - c * cr) / det;
    ahead_m += (w * cr - c * r) / det;
    stderr_rad = deviation * std::sqrt(cc / det);
  }
  return HeadingOfWay{wrapped(mounting_rad), stderr_rad};
}

}  // namespace odolab
