#include "core/diagnosis/units/traces.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/naming/material.h"
#include "core/diagnosis/units/component_names.h"
#include "core/diagnosis/units/joint_errors.h"

namespace odolab {

namespace {

// Readings that hold and then catch up are a fault only where the axle went on meanwhile: castors and trucks that stand
// may set off within a sample.
bool stood_still(const std::pair<double, double>& time_s, bool left, const Recording& recording,
                 const DifferentialDrive& drive) {
  const std::vector<WheelSample> wheels = wheel_samples(recording, drive);
  const Track truth = truth_track(recording);
  const auto rad = [&](const WheelSample& w) { return left ? w.left_rad : w.right_rad; };
  std::size_t first = 0;
  while (first < wheels.size() && wheels[first].time_s < time_s.first - 1e-9) ++first;
  std::size_t last = first;
  while (last + 1 < wheels.size() && rad(wheels[last + 1]) == rad(wheels[first])) ++last;
  if (last <= first || last + 1 >= wheels.size()) return false;
  const std::optional<Pose> from = pose_at(truth, wheels[first].time_s), to = pose_at(truth, wheels[last].time_s);
  if (!from || !to) return false;
  const Pose moved = between(*from, *to);
  const double radius_m = left ? drive.wheel_radius_left_m : drive.wheel_radius_right_m;
  const double rolled_m = moved.x_m + (left ? -0.5 : 0.5) * drive.wheelbase_m * wrapped(moved.heading_rad);
  return std::abs(rolled_m) < 0.5 * radius_m * std::abs(rad(wheels[last + 1]) - rad(wheels[last]));
}

}  // namespace

bool may_be_rounding(const Finding& f, const VehicleUnit& unit, const JointRounding& rounding) {
  const auto size = [&](const char* name) {
    for (const FoundParameter& p : f.parameters)
      if (p.name == name) return std::abs(p.value);
    return 0.0;
  };
  if (f.effect == "collision")
    return std::hypot(size("dx_m"), size("dy_m")) <= rounding.position_m &&
           size("dheading_rad") <= rounding.heading_rad;
  if (f.effect != "bump") return false;
  const bool of_both = f.component == component_of_unit(unit.name, "both_wheels");
  const double forward_m = (of_both ? 1.0 : 0.5) * size("extra_distance_m"),
               left_from_right_m = of_both ? 2.0 * size("left_more_m") : size("extra_distance_m");
  return forward_m <= rounding.position_m && left_from_right_m / unit.drive.wheelbase_m <= rounding.heading_rad;
}

JointRounding rounding_from_inside(const Vehicle& vehicle) {
  constexpr double kCounts = 1.5;  // as core/diagnosis/naming/scored_candidates.cpp asks of a drive's own
  const std::vector<VehicleUnit> units = units_of(vehicle);
  JointRounding joints, counts;
  for (std::size_t u = 0; u < units.size(); ++u) {
    const JointRounding one = rounding_of_joints(vehicle, u);
    joints = {std::max(joints.position_m, 2.0 * one.position_m), std::max(joints.heading_rad, 2.0 * one.heading_rad)};
    const DifferentialDrive& drive = units[u].drive;
    const double radius_m = std::max(drive.wheel_radius_left_m, drive.wheel_radius_right_m);
    const double count_m = 2.0 * kPi / drive.counts_per_wheel_turn() * radius_m;
    const double turn_rad = count_m / drive.wheelbase_m;
    counts = {std::max(counts.position_m, kCounts * (count_m + turn_rad * length_of_joint_m(vehicle))),
              std::max(counts.heading_rad, kCounts * turn_rad)};
  }
  if (units.size() > 2) return joints;  // several units together are what one of them is held against
  return {joints.position_m + counts.position_m, joints.heading_rad + counts.heading_rad};
}

void leave_out_standing(Diagnosis& d, const std::vector<Recording>& recordings, const DifferentialDrive& drive) {
  for (Finding& f : d.findings) {
    if (f.effect != "encoder_data_fault") continue;
    for (const Recording& r : recordings)
      if (r.name == f.where.recording)
        f.where.time_s.erase(
            std::remove_if(f.where.time_s.begin(), f.where.time_s.end(),
                           [&](const auto& t) { return stood_still(t, f.component == "left_wheel", r, drive); }),
            f.where.time_s.end());
  }
  d.findings.erase(
      std::remove_if(d.findings.begin(), d.findings.end(),
                     [](const Finding& f) { return f.effect == "encoder_data_fault" && f.where.time_s.empty(); }),
      d.findings.end());
}

namespace {
// Lengths that are wrong by 0.3 % make castors on one frame slip so that a spline takes up to a third off what is
// left (planar simulator, five sets).
constexpr double kMaterialOfCastors = 0.5;

double least_gain_of(bool castor) { return castor ? 60.0 : 15.0; }  // set on cases with nothing missing, README.md

// Of a diagnosis that has figures of runs that were left out.
bool rest_is_a_trace(const Diagnosis& d, bool castor) {
  const auto predicts = [&](const std::optional<FitFigures>& with) {
    const FitFigures& without = *d.held_out.calibrated;
    if (!with || !(without.position_rms_m > 0.0) || !(without.heading_rms_rad > 0.0)) return true;
    const double position = with->position_rms_m / without.position_rms_m,
                 heading = with->heading_rms_rad / without.heading_rms_rad;
    return 0.5 * (position * position + heading * heading) < (castor ? kMaterialOfCastors : kMaterial);
  };
  // What leaves more than twice the noise is no trace, whether a spline draws it or not.
  const auto is_small = [&] {
    constexpr double kSmall = 2.0;
    const std::optional<FitFigures>& floor = d.held_out.noise_floor;
    return !floor || (d.held_out.calibrated->position_rms_m < kSmall * floor->position_rms_m &&
                      d.held_out.calibrated->heading_rms_rad < kSmall * floor->heading_rms_rad);
  };
  return !predicts(d.held_out.spline) && is_small();
}
}  // namespace

bool has_a_name_beside_a_trace(const Diagnosis& d, bool castor) {
  constexpr double kMostOfIt = 0.6, kTimesTheLeast = 2.0;
  if (!d.held_out.calibrated || !rest_is_a_trace(d, castor)) return false;
  return std::any_of(d.findings.begin(), d.findings.end(), [&](const Finding& f) {
    return f.effect == "unknown" &&
           std::any_of(f.alternatives.begin(), f.alternatives.end(), [&](const Alternative& a) {
             return a.log_likelihood_gain >
                    std::max(kMostOfIt * f.log_likelihood_gain, kTimesTheLeast * least_gain_of(castor));
           });
  });
}

void leave_out_traces(Diagnosis& d, bool castor) {
  const double least_gain = least_gain_of(castor);
  // The truth's heading swings a unit at the end of a joint to and fro, and as one with its own heading: the likelihood
  // takes the two for independent, and sees pushes in it.
  constexpr double kLeastOfAMoment = 25.0;
  const auto least_of = [&](const Finding& f) {
    const bool of_a_moment =
        std::any_of(f.parameters.begin(), f.parameters.end(), [](const FoundParameter& p) { return p.name == "at_s"; });
    return of_a_moment ? std::max(least_gain, kLeastOfAMoment) : least_gain;
  };
  if (!d.held_out.calibrated || d.findings.empty()) return;
  const bool rest_counts = !rest_is_a_trace(d, castor);
  const std::size_t before = d.findings.size();
  d.findings.erase(std::remove_if(d.findings.begin(), d.findings.end(),
                                  [&](const Finding& f) {
                                    // An encoder that errs by more than it rounds is no trace of rounding.
                                    if (is_of_a_joint(f) && !castor) return f.log_likelihood_gain < least_gain;
                                    if (f.effect == "unknown" && !rest_counts) return true;
                                    return f.log_likelihood_gain > 0.0 && f.log_likelihood_gain < least_of(f);
                                  }),
                   d.findings.end());
  if (d.findings.size() == before) return;
  d.warnings.push_back(
      "something is left that is as small as the rounding of the joints or the slip of wheels on one "
      "frame, and that predicts no run it was not fitted on");
  const bool open =
      std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& f) { return !f.alternatives.empty(); });
  d.verdict = d.findings.empty() ? Verdict::nothing_missing : open ? Verdict::ambiguous : Verdict::found;
}

}  // namespace odolab
