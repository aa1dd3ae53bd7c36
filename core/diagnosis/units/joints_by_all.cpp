#include "core/diagnosis/units/joints_by_all.h"

#include <cmath>

#include "core/diagnosis/units/mended_counts.h"
#include "core/diagnosis/units/others_way.h"
#include "core/diagnosis/units/outside_truth.h"
#include "core/diagnosis/units/together/joined_unnamed.h"
#include "core/diagnosis/units/told_geometry.h"

namespace odolab {

namespace {

constexpr double kTruthApart_s = 0.1;  // samples of the truth: wheels err by less than it does meanwhile

// When a unit was at a place, on the encoders' clock.
TimeStretches times_at(const WhereFound::Zone& zone, const JoinedRun& run, const Vehicle& vehicle, double late_s,
                       std::size_t unit) {
  constexpr double kBeside_m = 0.2;
  TimeStretches times;
  for (const TimedPose& t : run.tracked) {
    const double at_s = t.time_s - late_s;
    const Pose axle = t.pose * tracked_T_axle(vehicle, unit, joints_at(run.samples, at_s));
    if (std::hypot(axle.x_m - zone.x_m, axle.y_m - zone.y_m) < zone.radius_m + kBeside_m)
      times.emplace_back(at_s - kTruthApart_s, at_s + kTruthApart_s);
  }
  return times;
}

// When something happened to a unit that does not last.
TimeStretches times_of(const Finding& f, const Recording& recording, const JoinedRun& run, const Vehicle& vehicle,
                       double late_s, std::size_t unit) {
  if (lasts(f)) return {};
  TimeStretches times = f.where.zone ? times_at(*f.where.zone, run, vehicle, late_s, unit) : TimeStretches{};
  if (f.where.recording == recording.name) times.insert(times.end(), f.where.time_s.begin(), f.where.time_s.end());
  return times;
}

}  // namespace

std::optional<Finding> tell_joints_by_all(const std::vector<JoinedRun>& runs, const std::vector<Recording>& recordings,
                                          const std::vector<std::string>& names, const std::vector<Diagnosis>& of_units,
                                          const Vehicle& nominal, double family_wise_error, GeometryFit& geometry) {
  Vehicle calibrated = nominal;
  for (std::size_t u = 0; u < of_units.size(); ++u)
    calibrated = with_drive(calibrated, u, std::get<DifferentialDrive>(of_units[u].calibration.vehicle.kind));
  std::vector<Understood> understood = with_mended_counts(understood_without(of_units, recordings, nominal), nominal);
  std::vector<JoinedRun> beside = runs;
  for (std::size_t r = 0; r < beside.size(); ++r) {
    JoinedRun& run = beside[r];
    run.tracked = at_least_apart(run.tracked, kTruthApart_s);
    run.samples = std::move(understood[r].samples);
    const double late_s = nominal.truth.time_offset_s + geometry.clock_s[r];
    for (std::size_t u = 0; u < of_units.size() && u < run.guessed.size(); ++u)
      for (const Finding& f : of_units[u].findings) {
        const TimeStretches times = times_of(f, recordings[r], run, geometry.vehicle, late_s, u);
        run.guessed[u].insert(run.guessed[u].end(), times.begin(), times.end());
      }
  }
  JoinedModel model(std::move(beside), calibrated, geometry.clock_s, names);
  model.fit_all();
  take_biases(model, nominal, geometry);
  return unnamed_joint(model, family_wise_error);
}

}  // namespace odolab
