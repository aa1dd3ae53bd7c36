#include "core/calibration/first_guess.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"
#include "core/base/quantile.h"
#include "core/calibration/late_truth.h"
#include "core/calibration/left_out.h"
#include "core/calibration/wheels_at.h"

namespace odolab {

namespace {

// A stretch between two truth samples: rotation of the wheels, and the truth's turn and way along its middle heading.
struct TurningStretch {
  double left_rad = 0.0, right_rad = 0.0;
  double turn_rad = 0.0, way_m = 0.0;
};

// Long enough that clocks apart by a tenth of a second matter little, short enough that a turn is not taken for
// another.
constexpr double kShortestGuess_s = 0.5, kLongestGuess_s = 5.0;
constexpr double kLargestTurn_rad = 1.2;

std::vector<TurningStretch> turning_stretches(const std::vector<InnovationRun>& runs) {
  std::vector<TurningStretch> stretches;
  for (const InnovationRun& run : runs) {
    if (!run.truth_has_heading) continue;
    std::size_t from = 0;
    for (std::size_t i = 1; i < run.truth.size(); ++i) {
      if (is_cut(run, i)) from = i;
      const TruthSample &a = run.truth[from], &b = run.truth[i];
      const double span_s = b.time_s - a.time_s;
      if (span_s < kShortestGuess_s) continue;
      from = i;
      if (span_s > kLongestGuess_s || !a.heading_rad || !b.heading_rad) continue;
      TurningStretch s;
      s.turn_rad = wrapped(*b.heading_rad - *a.heading_rad);
      if (std::abs(s.turn_rad) > kLargestTurn_rad) continue;
      const double middle_rad = *a.heading_rad + 0.5 * s.turn_rad;
      s.way_m = dot(b.position - a.position, {std::cos(middle_rad), std::sin(middle_rad)});
      const WheelSample wa = wheels_at(run.wheels, a.time_s), wb = wheels_at(run.wheels, b.time_s);
      s.left_rad = wb.left_rad - wa.left_rad;
      s.right_rad = wb.right_rad - wa.right_rad;
      if (std::abs(s.left_rad) + std::abs(s.right_rad) > 0.0) stretches.push_back(s);
    }
  }
  // A robot that crawls is lost in the truth's noise; a single jump of a counter would outweigh all the rest.
  constexpr double kCrawls = 0.02, kJumps = 20.0;
  const auto size = [](const TurningStretch& s) { return std::abs(s.left_rad) + std::abs(s.right_rad); };
  const auto at_share = [&](double share) {
    std::vector<double> sizes;
    for (const TurningStretch& s : stretches) sizes.push_back(size(s));
    return quantile(std::move(sizes), share);
  };
  if (stretches.empty()) return stretches;
  const double least = kCrawls * at_share(0.9);
  std::erase_if(stretches, [&](const TurningStretch& s) { return size(s) < least; });
  const double largest = kJumps * at_share(0.5);
  std::erase_if(stretches, [&](const TurningStretch& s) { return size(s) > largest; });
  return stretches;
}

// How many times further the truth turns than the wheels say, from half-second to half-second in which a wheel turns:
// noise of the truth's headings adds up while it stands, for hours if need be.
double turning_ratio(const std::vector<InnovationRun>& runs, const DifferentialDrive& drive) {
  double truth_rad = 0.0, wheels_rad = 0.0;
  for (const InnovationRun& run : runs) {
    std::size_t from = 0;
    const auto stands = [&](double from_s, double to_s) {
      const WheelSample a = wheels_at(run.wheels, from_s), b = wheels_at(run.wheels, to_s);
      return a.left_rad == b.left_rad && a.right_rad == b.right_rad;
    };
    for (std::size_t i = 1; i < run.truth.size(); ++i) {
      if (run.truth[i].time_s - run.truth[from].time_s < kShortestGuess_s) continue;
      if (run.truth[i].heading_rad && run.truth[from].heading_rad &&
          !stands(run.truth[from].time_s, run.truth[i].time_s))
        truth_rad += std::abs(*run.truth[i].heading_rad - *run.truth[from].heading_rad);
      from = i;
    }
    for (std::size_t i = 1; i < run.wheels.size(); ++i)
      wheels_rad += std::abs(drive.wheel_radius_right_m * (run.wheels[i].right_rad - run.wheels[i - 1].right_rad) -
                             drive.wheel_radius_left_m * (run.wheels[i].left_rad - run.wheels[i - 1].left_rad)) /
                    drive.wheelbase_m;
  }
  return wheels_rad > 1.0 ? truth_rad / wheels_rad : 1.0;
}

// y = p left + q right over all stretches, and which share of y's squares it explains. Three rounds, each without the
// stretches that contradict the one before by three times the median.
struct Plane {
  double left = 0.0, right = 0.0, explained = 0.0;
};

Plane weighted_plane(const std::vector<TurningStretch>& stretches, double TurningStretch::*y,
                     const std::vector<double>& weights) {
  Plane plane;
  double ll = 1e-12, lr = 0.0, rr = 1e-12, ly = 0.0, ry = 0.0;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const TurningStretch& s = stretches[i];
    const double w = weights[i];
    ll += w * s.left_rad * s.left_rad, lr += w * s.left_rad * s.right_rad, rr += w * s.right_rad * s.right_rad;
    ly += w * s.left_rad * s.*y, ry += w * s.right_rad * s.*y;
  }
  // A little stiffness for drives on which both wheels always do the same.
  const double ridge = 1e-9 * (ll + rr), determinant = (ll + ridge) * (rr + ridge) - lr * lr;
  plane.left = ((rr + ridge) * ly - lr * ry) / determinant;
  plane.right = ((ll + ridge) * ry - lr * ly) / determinant;
  return plane;
}

Plane fitted_plane(const std::vector<TurningStretch>& stretches, double TurningStretch::*y) {
  // By least absolute deviations first, which a truth that is once metres away does not turn aside: each round weighs a
  // stretch by how little it contradicts the one before.
  constexpr int kAbsoluteRounds = 15, kSquareRounds = 3;
  Plane plane;
  std::vector<double> weights(stretches.size(), 1.0), misses(stretches.size());
  for (int round = 0; round < kAbsoluteRounds + kSquareRounds; ++round) {
    plane = weighted_plane(stretches, y, weights);
    double left_over = 0.0, total = 1e-12;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const TurningStretch& s = stretches[i];
      misses[i] = std::abs(s.*y - plane.left * s.left_rad - plane.right * s.right_rad);
      if (weights[i] > 0.0) left_over += misses[i] * misses[i], total += s.*y * s.*y;
    }
    plane.explained = 1.0 - left_over / total;
    const double scatter = scatter_about_zero(misses), gate = 3.0 * scatter + 1e-9;
    for (std::size_t i = 0; i < stretches.size(); ++i)
      weights[i] = round + 1 < kAbsoluteRounds ? 1.0 / std::max(misses[i], 0.1 * scatter + 1e-9)
                                               : (misses[i] <= gate ? 1.0 : 0.0);
  }
  return plane;
}

struct Planes {
  Plane turn, way;
  bool enough = false;  // both wheels were driven apart and together, and not always in one proportion
};

Planes planes_of(const std::vector<TurningStretch>& stretches) {
  Planes planes;
  // On a circle one wheel is as good as the other, and which of them moves the robot is told by noise alone.
  constexpr double kNotInProportion = 2e-3;
  double left2 = 0.0, right2 = 0.0, both = 0.0;
  for (const TurningStretch& s : stretches) {
    left2 += s.left_rad * s.left_rad;
    right2 += s.right_rad * s.right_rad;
    both += s.left_rad * s.right_rad;
  }
  const double together = left2 + right2 + 2.0 * both, apart = left2 + right2 - 2.0 * both;
  planes.enough = stretches.size() >= 8 && together > 0.01 * apart && apart > 0.01 * together &&
                  left2 * right2 - both * both > kNotInProportion * left2 * right2;
  if (!planes.enough) return planes;
  planes.turn = fitted_plane(stretches, &TurningStretch::turn_rad);
  planes.way = fitted_plane(stretches, &TurningStretch::way_m);
  return planes;
}

constexpr double kExplained = 0.8;

// Whether both turn a good deal in half a second, far beyond what a heading errs by, in many stretches.
bool turn_apart(const std::vector<TurningStretch>& stretches, const DifferentialDrive& drive) {
  constexpr double kTurns_rad = 0.15;
  constexpr std::size_t kFewest = 30;
  double truth2 = 0.0, wheels2 = 0.0;
  for (const TurningStretch& s : stretches) {
    const double by_wheels =
        (drive.wheel_radius_right_m * s.right_rad - drive.wheel_radius_left_m * s.left_rad) / drive.wheelbase_m;
    truth2 += s.turn_rad * s.turn_rad, wheels2 += by_wheels * by_wheels;
  }
  return stretches.size() >= kFewest &&
         std::min(truth2, wheels2) > kTurns_rad * kTurns_rad * static_cast<double>(stretches.size());
}

}  // namespace

FirstGuess first_guess(const std::vector<InnovationRun>& runs, const DifferentialDrive& nominal) {
  FirstGuess guess{nominal, false};
  const Planes p = planes_of(turning_stretches(runs));
  if (!p.enough || p.turn.explained < kExplained || p.way.explained < kExplained) return guess;
  // way = (r_L left + r_R right) / 2, turn = (r_R right - r_L left) / b
  const double mean_radius_m = p.way.left + p.way.right, slope = 0.5 * (p.turn.right - p.turn.left);
  if (mean_radius_m <= 0.0 || slope <= 0.0) return guess;
  guess.drive.wheel_radius_left_m = guess.drive.wheel_radius_right_m = mean_radius_m;
  guess.drive.wheelbase_m = mean_radius_m / slope;
  guess.trusted = problems_in(guess.drive).empty();
  if (!guess.trusted) guess.drive = nominal;
  return guess;
}

std::vector<std::string> counter_jumps_in(const std::vector<InnovationRun>& runs) {
  std::vector<std::string> sentences;
  for (const InnovationRun& run : runs) {
    for (double WheelSample::*wheel : {&WheelSample::left_rad, &WheelSample::right_rad}) {
      std::vector<double> steps;
      for (std::size_t i = 1; i < run.wheels.size(); ++i)
        steps.push_back(leaves_out(run, run.wheels[i - 1].time_s, run.wheels[i].time_s)
                            ? 0.0
                            : std::abs(run.wheels[i].*wheel - run.wheels[i - 1].*wheel));
      if (steps.empty()) continue;
      const std::size_t largest =
          static_cast<std::size_t>(std::max_element(steps.begin(), steps.end()) - steps.begin());
      const double jump_rad = steps[largest];
      std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() * 9 / 10), steps.end());
      if (jump_rad < 10.0 || jump_rad < 100.0 * steps[steps.size() * 9 / 10]) continue;
      const std::string text = formatted(
          "%s: the %s wheel's reading jumps by %.4g rad at %.2f s: an encoder fault, or a counter that wraps "
          "(counter_bits)",
          run.name.c_str(), wheel == &WheelSample::left_rad ? "left" : "right", jump_rad, run.wheels[largest].time_s);
      sentences.push_back(text);
    }
  }
  return sentences;
}

Contradiction contradiction_in(const std::vector<InnovationRun>& runs, const DifferentialDrive& nominal) {
  // A degree taken for a radian makes 57 of one.
  const std::vector<TurningStretch> stretches = turning_stretches(runs);
  const Planes p = planes_of(stretches);
  const double turning = turning_ratio(runs, nominal);
  if (turning > 20.0)
    return {formatted("headings that turn %.0f times as far as the wheels turn the robot: headings in degrees?",
                      turning)};
  if (!p.enough) return {};
  const double way_sum = p.way.left + p.way.right, turn_difference = p.turn.right - p.turn.left;
  if (p.way.explained > kExplained && p.way.left > 0.0 && p.way.right > 0.0 && p.turn.explained > kExplained &&
      turn_difference < 0.0)
    return {"wheels that turn the robot the other way than the truth: the left and the right wheel are exchanged, or "
            "headings run clockwise"};
  if (p.way.explained > kExplained && way_sum < 0.0)
    return {"wheels that roll backward while the truth goes forward: the sign of the wheels' rotation is wrong, or the "
            "truth's heading points backward"};
  // One reversed wheel: what should be the way is in the difference of the wheels.
  if (p.way.explained > kExplained && p.way.left * p.way.right < 0.0 &&
      std::abs(way_sum) < 0.3 * std::abs(p.way.left - p.way.right))
    return {"one wheel that rolls backward while the other rolls forward on straights: the sign of one wheel's "
            "rotation is wrong"};
  const double radius_ratio = way_sum / (nominal.wheel_radius_left_m + nominal.wheel_radius_right_m) * 2.0;
  if (p.way.explained > kExplained && (radius_ratio > 5.0 || radius_ratio < 0.2))
    return {formatted(
        "%.3g times the way that the vehicle file's wheels roll: lengths in other units, other counts per "
        "turn, or counts that are not cumulative",
        radius_ratio)};
  if (p.turn.explained < 0.3 || p.way.explained < 0.3)
    if (const std::optional<double> late_s = late_truth_s(runs))
      return {formatted("a truth whose stamps are %.1f s %s than the wheels' by what both do", std::abs(*late_s),
                        *late_s > 0.0 ? "later" : "earlier"),
              formatted("both by one clock, or truth_mounting.time_offset_s = %.1f in the vehicle's file", *late_s)};
  if (p.turn.explained < 0.3 && p.way.explained < 0.3)
    return {"a motion that the wheels do not explain at all: headings in degrees, times in other units, counts that "
            "are not cumulative, or another robot's truth"};
  if (p.way.explained > kExplained && p.turn.explained < 0.3)
    return {"headings that do not follow the wheels, while the way does: headings in degrees, or another run's truth"};
  // A way that goes on forward is like any other; turns tell one drive from another.
  if (p.turn.explained < 0.3 && turn_apart(stretches, nominal))
    return {"turns that do not follow the wheels': another run's truth, or another robot's"};
  return {};
}

}  // namespace odolab
