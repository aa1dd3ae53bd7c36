#include "core/diagnosis/generic/counted.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/model/coarse_counts.h"

namespace odolab {

namespace {

constexpr double kHidden = 0.5;       // counts
constexpr double kTeeth = 3.0;        // a turn: more is no shape of a wheel
constexpr double kEvenlyMoved = 0.2;  // of a term's motion; twice what chance makes of a term of twenty readings

// From the lowest to the highest of some numbers, zero among them.
struct Extent {
  double low = 0.0, high = 0.0;
  void take(double v) { low = std::min(low, v), high = std::max(high, v); }
  double half() const { return 0.5 * (high - low); }
};

// How much a term moves a wheel, and how much of that while the wheel turned by nearly a whole number of counts from
// reading to reading, or to the next but one, two or three: only then do remainders take as long to come back as the
// term does.
constexpr int kApart = 4;
struct MovedInAll {
  double all_m = 0.0;
  std::array<double, kApart> evenly_m{};  // by how many readings lie between, the fewest first
  void add(const DriveView& view, double EffectStep::*by_rad, double count_rad, const std::vector<double>& moved_m) {
    constexpr double kFaster = 1.5;  // that the remainder may come back
    for (std::size_t first = 0; first < moved_m.size();) {
      std::size_t end = first;
      double way_m = 0.0, counts = 0.0;
      for (; end < moved_m.size() && !(moved_m[end] * way_m < 0.0); ++end) {
        way_m += moved_m[end];
        counts += view.steps[end].*by_rad / count_rad;
      }
      const auto readings = static_cast<double>(end - first);
      const auto turns_of_remainder = [&](int apart) {  // within this half of the term's period
        const double each = apart * counts / readings;
        return std::abs(each - std::round(each)) * readings / apart;
      };
      all_m += std::abs(way_m);
      for (int apart = 1; apart <= kApart; ++apart)
        if (turns_of_remainder(apart) < 0.5 * kFaster) {
          evenly_m[static_cast<std::size_t>(apart - 1)] += std::abs(way_m);
          break;
        }
      first = end;
    }
  }
};

// A heading that is rounded goes aside, and back, with what is driven: coarse counts alone do so.
bool is_aside_by_rounding(const JointModel& joint, const std::vector<Motions>& motions) {
  const DifferentialDrive& drive = joint.model.drive;
  double aside_m2 = 0.0, way_m2 = 0.0, count = 0.0;
  for (std::size_t r = 0; r < joint.runs().size(); ++r) {
    count = std::max(count, count_rad(joint.runs()[r], drive));
    const std::vector<EffectStep>& steps = joint.views()[r].steps;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      aside_m2 += std::pow(motions[r].at(i).sideways_m, 2);
      way_m2 += std::pow(steps[i].forward_m(), 2);
    }
  }
  const double of_heading_rad = kHidden * count * drive.wheel_radius_left_m / drive.wheelbase_m;
  return counts_are_coarse(joint) && aside_m2 < of_heading_rad * of_heading_rad * way_m2;
}

bool is_hidden(const JointModel& joint, const Effect& term, const std::vector<double>& value, double times_a_turn) {
  const DifferentialDrive& drive = joint.model.drive;
  std::vector<Motions> motions;
  for (const DriveView& view : joint.views()) motions.push_back(motion_of(term, view, {}, value));
  MovedInAll moved;
  double furthest = 0.0;  // counts
  for (std::size_t r = 0; r < joint.runs().size(); ++r) {
    const DriveView& view = joint.views()[r];
    const Motions& motion = motions[r];
    const double count = count_rad(joint.runs()[r], drive);
    std::vector<double> left_by_m, right_by_m;
    Extent left_m, right_m;
    double left_way_m = 0.0, right_way_m = 0.0;
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const BodyMotion m = motion.at(i);
      if (m.sideways_m != 0.0) return is_aside_by_rounding(joint, motions);  // no wheel that is counted goes sideways
      const double across_m = 0.5 * drive.wheelbase_m * m.turn_rad;
      left_by_m.push_back(m.forward_m - across_m);
      right_by_m.push_back(m.forward_m + across_m);
      left_m.take(left_way_m += left_by_m.back());
      right_m.take(right_way_m += right_by_m.back());
    }
    moved.add(view, &EffectStep::left_by_rad, count, left_by_m);
    moved.add(view, &EffectStep::right_by_rad, count, right_by_m);
    furthest = std::max({furthest, left_m.half() / (count * drive.wheel_radius_left_m),
                         right_m.half() / (count * drive.wheel_radius_right_m)});
  }
  // Teeth that move a rim by less than the wheel's counts can show carry it nowhere, at whatever speeds it was driven.
  if (times_a_turn > kTeeth && furthest <= kHidden) return true;
  // Remainders of readings that come back after so many share their turn evenly: what all hide is that much less.
  double evenly_m = 0.0;
  for (int apart = 1; apart <= kApart; ++apart)
    if (furthest <= kHidden * std::min(1.0, 2.0 / apart))
      evenly_m += moved.evenly_m[static_cast<std::size_t>(apart - 1)];
  return evenly_m > kEvenlyMoved * moved.all_m;
}

}  // namespace

void leave_to_counting(GenericTest& t, const JointModel& joint) {
  for (CandidateTest* of : {&t.test, &t.instead})
    if (!of->value.empty() && t.p_value_of(*of) < 1.0 && is_hidden(joint, *t.as_effect, of->value, t.times_a_turn))
      of->statistic = 0.0;
  t.p_value = t.p_value_of(t.test);
}

void leave_displaced_to_counting(GenericTest& t, const JointModel& joint) {
  for (CandidateTest* of : {&t.test, &t.instead})
    if (!of->value.empty() && is_within_counts(joint, *t.as_effect, of->value, {})) of->statistic = 0.0;
  t.p_value = t.p_value_of(t.test);
}

}  // namespace odolab
