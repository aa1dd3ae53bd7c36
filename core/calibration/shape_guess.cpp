#include "core/calibration/shape_guess.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/minimise.h"
#include "core/calibration/wheels_at.h"

namespace odolab {

namespace {

constexpr double kStretch_s = 8.0, kSamplesApart_s = 0.15;  // of a stretch, and of its samples
constexpr std::size_t kFewestShapeSamples = 12;             // samples
constexpr double kShortestAcross_m = 0.1;                   // what a stretch must be across
constexpr double kWorstOfShape = 0.1;                       // share of the stretches that may be at fault
constexpr std::size_t kMostStretches = 60;

struct Sample {
  double left_rad = 0.0, right_rad = 0.0;  // by how much the wheels turned since the one before
  Vec2 truth;
};
using ShapeStretch = std::vector<Sample>;

ShapeStretch stretch_between(const InnovationRun& run, double from_s, double to_s, double late_s) {
  ShapeStretch stretch;
  double next_s = from_s;
  WheelSample before;
  const auto first = std::lower_bound(run.truth.begin(), run.truth.end(), from_s,
                                      [](const TruthSample& t, double time_s) { return t.time_s < time_s; });
  for (auto i = static_cast<std::size_t>(first - run.truth.begin()); i < run.truth.size(); ++i) {
    const TruthSample& t = run.truth[i];
    if (t.time_s < next_s || run.set_aside[i]) continue;
    if (t.time_s > to_s) break;
    const double at_s = t.time_s - late_s;
    if (at_s < run.wheels.front().time_s || at_s > run.wheels.back().time_s) continue;
    const WheelSample now = wheels_at(run.wheels, at_s);
    if (stretch.empty()) before = now;
    stretch.push_back({now.left_rad - before.left_rad, now.right_rad - before.right_rad, t.position});
    before = now;
    next_s = t.time_s + kSamplesApart_s;
  }
  return stretch;
}

double size2(const ShapeStretch& stretch) {
  Vec2 mean{};
  for (const Sample& s : stretch) mean = mean + s.truth;
  mean = (1.0 / static_cast<double>(stretch.size())) * mean;
  double sum = 0.0;
  for (const Sample& s : stretch) sum += dot(s.truth - mean, s.truth - mean);
  return sum / static_cast<double>(stretch.size());
}

struct Drive {
  double left_m, right_m, wheelbase_m;
  Vec2 tracked;
};

// Mean square distance of the dead-reckoned stretch from the truth, laid onto it as well as turning and shifting can.
double misfit_of_stretch(const ShapeStretch& stretch, const Drive& drive) {
  Pose pose;
  Vec2 mean_guess{}, mean_truth{};
  std::vector<Vec2> guess;
  guess.reserve(stretch.size());
  for (const Sample& s : stretch) {
    const double left = drive.left_m * s.left_rad, right = drive.right_m * s.right_rad;
    const double forward = 0.5 * (left + right), turn = (right - left) / drive.wheelbase_m;
    const double heading = pose.heading_rad + 0.5 * turn;
    pose = {pose.x_m + forward * std::cos(heading), pose.y_m + forward * std::sin(heading), pose.heading_rad + turn};
    guess.push_back(pose * drive.tracked);
    mean_guess = mean_guess + guess.back();
    mean_truth = mean_truth + s.truth;
  }
  const double n = static_cast<double>(stretch.size());
  mean_guess = (1.0 / n) * mean_guess;
  mean_truth = (1.0 / n) * mean_truth;
  double cosine = 0.0, sine = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < stretch.size(); ++i) {
    const Vec2 g = guess[i] - mean_guess, t = stretch[i].truth - mean_truth;
    cosine += dot(g, t);
    sine += cross(g, t);
    squares += dot(g, g) + dot(t, t);
  }
  return std::max(0.0, squares - 2.0 * std::hypot(cosine, sine)) / n;
}

}  // namespace

std::optional<ShapeGuess> shape_guess(const std::vector<InnovationRun>& runs, const DifferentialDrive& nominal,
                                      const TruthMounting& mounting) {
  std::vector<ShapeStretch> stretches;
  double sizes = 0.0;
  for (const InnovationRun& run : runs) {
    if (run.truth_has_heading || run.truth.size() < kFewestShapeSamples || run.wheels.size() < 2) return std::nullopt;
    for (double from_s = run.truth.front().time_s; from_s < run.truth.back().time_s; from_s += kStretch_s) {
      ShapeStretch stretch = stretch_between(run, from_s, from_s + kStretch_s, mounting.time_offset_s);
      if (stretch.size() < kFewestShapeSamples || size2(stretch) < kShortestAcross_m * kShortestAcross_m) continue;
      stretches.push_back(std::move(stretch));
    }
  }
  if (stretches.empty()) return std::nullopt;
  if (stretches.size() > kMostStretches) {  // evenly over all
    std::vector<ShapeStretch> fewer;
    for (std::size_t k = 0; k < kMostStretches; ++k) fewer.push_back(stretches[k * stretches.size() / kMostStretches]);
    stretches = std::move(fewer);
  }
  for (const ShapeStretch& s : stretches) sizes += size2(s);
  const std::size_t kept = std::max<std::size_t>(1, static_cast<std::size_t>((1.0 - kWorstOfShape) * stretches.size()));

  // By the logarithm of each size, and the tracked point in parts of the wheelbase.
  const Pose& m = mounting.axle_T_tracked;
  const auto drive_of = [&](const std::vector<double>& v) {
    return Drive{nominal.wheel_radius_left_m * std::exp(v[0] + v[1]),
                 nominal.wheel_radius_right_m * std::exp(v[0] - v[1]),
                 nominal.wheelbase_m * std::exp(v[2]),
                 {m.x_m + v[3] * nominal.wheelbase_m, m.y_m + v[4] * nominal.wheelbase_m}};
  };
  const auto worst_left_out = [&](const std::vector<double>& v) {
    const Drive drive = drive_of(v);
    std::vector<double> each;
    for (const ShapeStretch& s : stretches) each.push_back(misfit_of_stretch(s, drive));
    std::nth_element(each.begin(), each.begin() + static_cast<std::ptrdiff_t>(kept - 1), each.end());
    double sum = 0.0;
    for (std::size_t k = 0; k < kept; ++k) sum += each[k];
    // Drives that cannot tell stay where they were: a tenth is worth a millimetre.
    for (double x : v) sum += 1e-6 * static_cast<double>(kept) * 100.0 * x * x;
    return sum;
  };
  const double least = 1e-9 * static_cast<double>(kept);
  std::vector<double> at = minimised(worst_left_out, std::vector<double>(5, 0.0), 0.05, least, 500);
  at = minimised(worst_left_out, at, 0.01, least, 500);
  const double fraction =
      worst_left_out(at) / (sizes * static_cast<double>(kept) / static_cast<double>(stretches.size()));
  constexpr double kTwentieth = 0.05 * 0.05;
  if (fraction > kTwentieth) return std::nullopt;
  const Drive found = drive_of(at);
  ShapeGuess guess{nominal, found.tracked};
  guess.drive.wheel_radius_left_m = found.left_m;
  guess.drive.wheel_radius_right_m = found.right_m;
  guess.drive.wheelbase_m = found.wheelbase_m;
  return guess;
}

}  // namespace odolab
