#include "core/diagnosis/units/heading_of_way.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/geometry/angles.h"

namespace odolab {

namespace {

constexpr double kWayStretch_m = 1.0, kShortestWay_m = 0.3;
constexpr double kMostTurned_rad = 0.5;
constexpr std::size_t kFewestWayStretches = 10;
constexpr double kWayHuber = 3.0;

struct WayStretch {
  double off_rad = 0.0;   // of the way as it was seen, from the way as the tracked headings look along it
  double swung_pm = 0.0;  // by how much a point ahead of the axle, by a metre, swings that out
  double weight = 0.0;    // inverse variance by noise of the positions
};

Vec2 direction_of(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad)}; }

// The way from one sample to another, seen and by its headings, the one laid on the other about their means.
std::optional<WayStretch> way_stretch(const Track& track, std::size_t first, std::size_t last) {
  std::vector<Vec2> seen, looked, ahead;
  Vec2 way, mean_seen, mean_looked, mean_ahead;
  const double n = static_cast<double>(last - first + 1);
  for (std::size_t i = first; i <= last; ++i) {
    if (i > first) {
      const Vec2 ahead_now = direction_of(0.5 * (track[i - 1].pose.heading_rad + track[i].pose.heading_rad));
      way = way + dot(track[i].pose.position() - track[i - 1].pose.position(), ahead_now) * ahead_now;
    }
    seen.push_back(track[i].pose.position());
    looked.push_back(way);
    ahead.push_back(direction_of(track[i].pose.heading_rad));
    mean_seen = mean_seen + (1.0 / n) * seen.back();
    mean_looked = mean_looked + (1.0 / n) * looked.back();
    mean_ahead = mean_ahead + (1.0 / n) * ahead.back();
  }
  if (length(way) < kShortestWay_m) return std::nullopt;
  double off = 0.0, swung = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const Vec2 by = looked[k] - mean_looked;
    off += cross(by, seen[k] - mean_seen);
    swung += cross(by, ahead[k] - mean_ahead);
    squares += dot(by, by);
  }
  return WayStretch{off / squares, swung / squares, squares};
}

std::vector<WayStretch> way_stretches(const Track& track) {
  std::vector<WayStretch> all;
  std::size_t first = 0;
  for (std::size_t i = 1; i < track.size(); ++i) {
    const Vec2 way = track[i].pose.position() - track[first].pose.position();
    const double turn = track[i].pose.heading_rad - track[first].pose.heading_rad;
    if (length(way) < kWayStretch_m && std::abs(turn) < kMostTurned_rad) continue;
    if (const std::optional<WayStretch> s = way_stretch(track, first, i)) all.push_back(*s);
    first = i;
  }
  return all;
}

}  // namespace

std::optional<HeadingOfWay> heading_of_way(const std::vector<Track>& tracked) {
  std::vector<WayStretch> all;
  for (const Track& track : tracked) {
    const std::vector<WayStretch> of_run = way_stretches(track);
    all.insert(all.end(), of_run.begin(), of_run.end());
  }
  if (all.size() < kFewestWayStretches) return std::nullopt;
  // off = -mounting + (how far ahead of the axle) * swung, robust against what was pushed aside.
  double mounting_rad = 0.0, ahead_m = 0.0, deviation = 0.0, stderr_rad = 0.0;
  const auto rest = [&](const WayStretch& s) { return s.off_rad + mounting_rad - ahead_m * s.swung_pm; };
  for (int iteration = 0; iteration < 10; ++iteration) {
    std::vector<double> rests;
    for (const WayStretch& s : all) rests.push_back(std::sqrt(s.weight) * rest(s));
    deviation = std::max(scatter_about_zero(std::move(rests)), 1e-6);
    double w = 0.0, c = 0.0, cc = 1e-9, r = 0.0, cr = 0.0;
    for (const WayStretch& s : all) {
      const double e = rest(s), size = std::sqrt(s.weight) * std::abs(e);
      const double weight = s.weight * std::min(1.0, kWayHuber * deviation / std::max(size, 1e-12));
      w += weight, c += weight * s.swung_pm, cc += weight * s.swung_pm * s.swung_pm;
      r += weight * e, cr += weight * s.swung_pm * e;
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
