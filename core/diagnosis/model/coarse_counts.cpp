#include "core/diagnosis/model/coarse_counts.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect_motions.h"

namespace odolab {

double largest_count_rad(const JointModel& joint) {
  double count = 0.0;
  for (const InnovationRun& run : joint.runs()) count = std::max(count, count_rad(run, joint.model.drive));
  return count;
}

double largest_count_m(const JointModel& joint) {
  const DifferentialDrive& drive = joint.model.drive;
  return largest_count_rad(joint) * std::max(drive.wheel_radius_left_m, drive.wheel_radius_right_m);
}

namespace {

struct StepSquares {
  double forward_m2 = 0.0, sideways_m2 = 0.0, turn_rad2 = 0.0;
};

// Whether a term is no more than the share by which rounded readings draw what goes with them towards nothing: the
// derivatives are taken from readings that are smoothed over half a second, of whose errors a fifth is the reading's
// own (errors in variables: Fuller, Measurement Error Models, 1987, section 1.1).
bool is_within_attenuation(const JointModel& joint, const Effect& term, const std::vector<double>& value,
                           const std::vector<double>& shape) {
  constexpr double kOfItsOwn = 0.2;
  StepSquares moved, went, rounded;
  for (std::size_t r = 0; r < joint.runs().size(); ++r) {
    const DriveView& view = joint.views()[r];
    const double count_m = count_rad(joint.runs()[r], joint.model.drive) *
                           std::max(view.drive.wheel_radius_left_m, view.drive.wheel_radius_right_m);
    const Motions by = motion_of(term, view, shape, value);
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const BodyMotion m = by.at(i);
      moved.forward_m2 += m.forward_m * m.forward_m;
      moved.sideways_m2 += m.sideways_m * m.sideways_m;
      moved.turn_rad2 += m.turn_rad * m.turn_rad;
      went.forward_m2 += std::pow(view.steps[i].forward_m(), 2);
      went.turn_rad2 += std::pow(view.steps[i].turn_rad, 2);
      rounded.forward_m2 += count_m * count_m / 12.0;
      rounded.turn_rad2 += count_m * count_m / (3.0 * view.drive.wheelbase_m * view.drive.wheelbase_m);
    }
  }
  const auto share2 = [](double of_rounding, double of_way) {
    return of_way > 0.0 ? std::pow(kOfItsOwn * of_rounding / of_way, 2) : 1.0;
  };
  const double of_forward = share2(rounded.forward_m2, went.forward_m2),
               of_turn = share2(rounded.turn_rad2, went.turn_rad2);
  return moved.forward_m2 <= std::max(of_forward, of_turn) * went.forward_m2 &&
         moved.turn_rad2 <= of_turn * went.turn_rad2 && moved.sideways_m2 <= of_turn * went.forward_m2;
}

// Root mean square of what both wheels turn from reading to reading, in counts.
double counts_of_a_reading(const JointModel& joint) {
  double squares_m2 = 0.0, n = 0.0;
  for (const DriveView& view : joint.views())
    for (const EffectStep& s : view.steps) squares_m2 += s.left_m * s.left_m + s.right_m * s.right_m, n += 2.0;
  const double count_m = largest_count_rad(joint) * joint.model.drive.wheel_radius_left_m;
  return n > 0.0 && count_m > 0.0 ? std::sqrt(squares_m2 / n) / count_m : 1e300;
}

bool err_by_more(const JointModel& joint, double times, double counts_from_reading_to_reading) {
  const double of_a_wheel_m = largest_count_m(joint) / std::sqrt(12.0),
               of_heading_rad = std::sqrt(2.0) * of_a_wheel_m / joint.model.drive.wheelbase_m;
  const FittedNoise& noise = joint.model.noise;
  const bool are_beyond_truth = of_a_wheel_m > times * noise.truth_position_m ||
                                (noise.truth_heading_rad > 0.0 && of_heading_rad > times * noise.truth_heading_rad);
  return are_beyond_truth && counts_of_a_reading(joint) < counts_from_reading_to_reading;
}

}  // namespace

bool counts_are_coarse(const JointModel& joint) { return err_by_more(joint, 2.0, 8.0); }

bool counts_may_feign(const JointModel& joint) { return err_by_more(joint, 0.5, 16.0); }

// Both ends of a change are rounded, each by up to a count.
bool is_within_counts(const JointModel& joint, const Effect& term, const std::vector<double>& value,
                      const std::vector<double>& shape) {
  const double displaced_m =
      displaces_m(joint.views(), [&](const DriveView& view) { return motion_of(term, view, shape, value); });
  constexpr double kCoarse = 2.5;  // times as far
  if (!counts_are_coarse(joint)) return !is_more_than_counts(displaced_m, largest_count_rad(joint), joint.views());
  return !is_more_than_counts(displaced_m / kCoarse, largest_count_rad(joint), joint.views()) ||
         is_within_attenuation(joint, term, value, shape);
}

}  // namespace odolab
