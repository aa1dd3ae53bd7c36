#include "core/diagnosis/quality/unheard_commands.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/calibration/wheels_at.h"
#include "core/geometry/angles.h"
#include "core/geometry/small_turn.h"

namespace odolab {

namespace {

struct MovedMeanwhile {
  double way_m = 0.0, turn_rad = 0.0;
};

// What the commands between two times add up to.
MovedMeanwhile told_between(const std::vector<WheelSample>& obeyed, const DifferentialDrive& drive, double from_s,
                            double to_s) {
  const WheelSample a = wheels_at(obeyed, from_s), b = wheels_at(obeyed, to_s);
  const double left_m = drive.wheel_radius_left_m * (b.left_rad - a.left_rad),
               right_m = drive.wheel_radius_right_m * (b.right_rad - a.right_rad);
  return {0.5 * (left_m + right_m), (right_m - left_m) / drive.wheelbase_m};
}

// The smaller of both, whichever way; none where one goes back on the other.
double at_least(double a, double b) { return a * b > 0.0 ? std::min(std::abs(a), std::abs(b)) : 0.0; }

// Where the truth is about a time, of the samples of a tenth of a second to either side; none where it has a gap.
std::optional<Pose> pose_about(const std::vector<TruthSample>& truth, double time_s) {
  constexpr double kMean_s = 0.1;
  const auto from = std::lower_bound(truth.begin(), truth.end(), time_s - kMean_s,
                                     [](const TruthSample& t, double s) { return t.time_s < s; });
  Vec2 sum;
  double turned = 0.0;
  int n = 0, headings = 0;
  std::optional<double> first;
  for (auto i = from; i != truth.end() && i->time_s <= time_s + kMean_s; ++i) {
    sum = sum + i->position;
    ++n;
    if (!i->heading_rad) continue;
    if (!first) first = i->heading_rad;
    turned += wrapped(*i->heading_rad - *first);
    ++headings;
  }
  if (n == 0) return {};
  return Pose{sum.x_m / n, sum.y_m / n, first.value_or(0.0) + turned / std::max(1, headings)};
}

// Whether it does, from half a second on, what it was told before; nothing where that is too little to tell, or the
// truth has a gap there.
std::optional<bool> goes_on_as_told(const std::vector<WheelSample>& obeyed, const DifferentialDrive& drive,
                                    const std::vector<TruthSample>& truth, double from_s, double to_s) {
  constexpr double kSooner_s = 0.5, kOff = 0.2, kOff_m = 0.03, kOff_rad = 0.1;
  from_s += std::min(kSooner_s, 0.5 * (to_s - from_s));
  const auto a = pose_about(truth, from_s), b = pose_about(truth, to_s);
  if (!a || !b) return std::nullopt;
  const MovedMeanwhile by_commands = told_between(obeyed, drive, from_s, to_s);
  const double chord_m = std::abs(by_commands.way_m * chord_share(by_commands.turn_rad));
  const bool has_headings = truth.front().heading_rad.has_value();
  if (chord_m < kOff_m && (!has_headings || std::abs(by_commands.turn_rad) < kOff_rad)) return std::nullopt;
  const double off_m = std::abs(length(b->position() - a->position()) - chord_m),
               off_rad = std::abs(wrapped(b->heading_rad - a->heading_rad - by_commands.turn_rad));
  return off_m < std::max(kOff_m, kOff * chord_m) &&
         (!has_headings || off_rad < std::max(kOff_rad, kOff * std::abs(by_commands.turn_rad)));
}

// Of intervals between commands, those in which the base was told the same as in the one before.
std::ptrdiff_t repeated(const std::vector<WheelSample>& obeyed) {
  constexpr double kSame = 1e-6;
  const auto speed = [&](std::size_t i, double WheelSample::*wheel) {
    return (obeyed[i + 1].*wheel - obeyed[i].*wheel) / (obeyed[i + 1].time_s - obeyed[i].time_s);
  };
  std::ptrdiff_t count = 0;
  for (std::size_t i = 1; i + 1 < obeyed.size(); ++i)
    count += std::abs(speed(i, &WheelSample::left_rad) - speed(i - 1, &WheelSample::left_rad)) < kSame &&
             std::abs(speed(i, &WheelSample::right_rad) - speed(i - 1, &WheelSample::right_rad)) < kSame;
  return count;
}

}  // namespace

TimeStretches holes_in_commands(const std::vector<WheelSample>& obeyed, const DifferentialDrive& drive,
                                const std::vector<TruthSample>& truth) {
  constexpr double kEven = 6.0, kNearlyAll = 0.9, kRepeats = 0.02, kTimesUsual = 5.0;
  const std::vector<std::size_t> intervals = long_intervals(obeyed, kTimesUsual);
  if (intervals.empty()) return {};
  std::vector<double> lasts_s;
  for (std::size_t i = 0; i + 1 < obeyed.size(); ++i) lasts_s.push_back(obeyed[i + 1].time_s - obeyed[i].time_s);
  if (quantile(lasts_s, kNearlyAll) > kEven * quantile(lasts_s, 0.5)) return {};
  const auto rests = [&](std::size_t i) {
    return i + 1 >= obeyed.size() ||
           (obeyed[i].left_rad == obeyed[i + 1].left_rad && obeyed[i].right_rad == obeyed[i + 1].right_rad);
  };
  TimeStretches holes;
  for (const std::size_t i : intervals)
    if (!rests(i) || !rests(i + 1)) holes.emplace_back(obeyed[i].time_s, obeyed[i + 1].time_s);
  if (truth.empty() || static_cast<double>(repeated(obeyed)) > kRepeats * static_cast<double>(obeyed.size()))
    return holes;
  int as_told = 0, otherwise = 0;
  for (const auto& [from_s, to_s] : holes)
    if (const std::optional<bool> goes_on = goes_on_as_told(obeyed, drive, truth, from_s, to_s))
      ++(*goes_on ? as_told : otherwise);
  return as_told > otherwise ? TimeStretches{} : holes;
}

TimeStretches unmoved_base(const std::vector<WheelSample>& obeyed, const DifferentialDrive& drive,
                           const std::vector<TruthSample>& truth) {
  constexpr double kLasts_s = 2.0, kStride_s = 0.25, kSooner_s = 0.5;
  constexpr double kLeast_m = 0.1, kLeast_rad = 0.5, kHardly = 0.15, kHardly_m = 0.015, kHardly_rad = 0.03;
  TimeStretches unmoved;
  if (obeyed.size() < 2 || truth.size() < 2) return unmoved;
  const bool has_headings = truth.front().heading_rad.has_value();
  int unbidden = 0, deaf = 0;
  for (double from_s = obeyed.front().time_s + kSooner_s; from_s + kLasts_s < obeyed.back().time_s;
       from_s += kStride_s) {
    const double to_s = from_s + kLasts_s;
    const auto a = pose_about(truth, from_s), b = pose_about(truth, to_s);
    if (!a || !b) continue;
    const auto moved_to = [&](const Pose& other) {
      return MovedMeanwhile{length(other.position() - a->position()),
                            std::abs(wrapped(other.heading_rad - a->heading_rad))};
    };
    const MovedMeanwhile moved = moved_to(*b);
    MovedMeanwhile furthest = moved;  // on the way: who went and came back did as he was told
    for (double time_s = from_s + kStride_s; time_s < to_s; time_s += kStride_s)
      if (const auto then = pose_about(truth, time_s)) {
        const MovedMeanwhile by = moved_to(*then);
        furthest = {std::max(furthest.way_m, by.way_m), std::max(furthest.turn_rad, by.turn_rad)};
      }
    const MovedMeanwhile now = told_between(obeyed, drive, from_s, to_s),
                         before = told_between(obeyed, drive, from_s - kSooner_s, to_s - kSooner_s);
    // Places say nothing of turns: who is told to turn on the spot stays where he is.
    const double way_m = at_least(now.way_m, before.way_m),
                 turn_rad = has_headings ? at_least(now.turn_rad, before.turn_rad) : 0.0;
    if ((way_m > kLeast_m || turn_rad > kLeast_rad) && furthest.way_m < std::max(kHardly_m, kHardly * way_m) &&
        furthest.turn_rad < std::max(kHardly_rad, kHardly * turn_rad)) {
      unmoved.emplace_back(from_s - kSooner_s, to_s);
      ++deaf;
    }
    const double most_m = std::max(std::abs(now.way_m), std::abs(before.way_m)),
                 most_rad = std::max(std::abs(now.turn_rad), std::abs(before.turn_rad));
    if ((moved.way_m > kLeast_m || moved.turn_rad > kLeast_rad) &&
        most_m < std::max(kHardly_m, kHardly * moved.way_m) &&
        most_rad < std::max(kHardly_rad, kHardly * moved.turn_rad))
      ++unbidden;
  }
  if (2 * unbidden > deaf) return {};
  return joined(std::move(unmoved));
}

}  // namespace odolab
