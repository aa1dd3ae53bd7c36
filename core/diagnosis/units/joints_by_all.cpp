#include "core/diagnosis/units/joints_by_all.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/fitted_model.h"
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

struct LastingOnUnit {
  std::size_t unit;
  FittedEffect effect;
};

// What moves a unit and lasts. Wheels that crawl are what a biased encoder is, too.
std::vector<LastingOnUnit> lasting_on(const std::vector<Diagnosis>& of_units) {
  std::vector<LastingOnUnit> all;
  for (std::size_t u = 0; u < of_units.size(); ++u) {
    Diagnosis lasting = of_units[u];
    std::erase_if(lasting.findings, [](const Finding& f) { return !lasts(f) || f.effect == "wheel_toe"; });
    for (const FittedEffect& effect : model_of(lasting).effects)
      if (const Effect* e = catalogue_entry(effect.active); e && e->acts_on_motion()) all.push_back({u, effect});
  }
  return all;
}

std::vector<JoinedModel::Acting> acting(const std::vector<LastingOnUnit>& lasting) {
  std::vector<JoinedModel::Acting> all;
  for (const LastingOnUnit& one : lasting)
    all.push_back({[effect = one.effect](const DriveView& view) {
                     Motions motions;
                     if (effect.recording.empty() || effect.recording == view.recording)
                       for (const BodyMotion& m : motions_of(view, {effect.active})) motions.push_back(m);
                     return motions_by_number(std::move(motions));
                   },
                   Eigen::VectorXd::Ones(1),
                   {one.unit}});
  return all;
}

// An effect's numbers in the catalogue's words, where there is so many times as much of it.
std::vector<FoundParameter> parameters_at(double times, const Effect& e, const ActiveEffect& found) {
  std::vector<FoundParameter> parameters;
  if (!e.to_parameters) {
    for (const Effect::Amplitude& a : e.amplitudes)
      parameters.push_back({a.name, times * found.parameter(a.name), 0.0, a.unit});
    return parameters;
  }
  std::vector<double> value = e.from_parameters(found);
  for (double& v : value) v *= times;
  return e.to_parameters(value, std::vector<double>(value.size(), 0.0));
}

}  // namespace

bool act_on_motion(const std::vector<Diagnosis>& of_units) { return !lasting_on(of_units).empty(); }

void put_sizes(const std::vector<ToldByAll::Size>& sizes, std::size_t unit, std::vector<Finding>& findings) {
  constexpr double kForm = 0.03, kOneOfSeveral = 0.05;  // of a value: as together/joined_errors has it
  constexpr double kStep = 1e-4;
  for (const ToldByAll::Size& size : sizes) {
    const Effect* e = catalogue_entry(size.found);
    const auto f = std::find_if(findings.begin(), findings.end(), [&](const Finding& g) {
      return g.effect == size.found.effect && g.component == size.found.component &&
             g.as_active().parameters == size.found.parameters;
    });
    if (size.unit != unit || !e || f == findings.end()) continue;
    const std::vector<FoundParameter> now = parameters_at(size.times, *e, size.found),
                                      more = parameters_at(size.times + kStep, *e, size.found);
    for (std::size_t k = 0; k < now.size(); ++k)
      for (FoundParameter& p : f->parameters) {
        const double by_all = std::abs(more[k].value - now[k].value) / kStep * size.stderr_of_times;
        if (p.name != now[k].name || by_all <= 0.0 || by_all > p.stderr_value) continue;
        p.value = now[k].value;
        const double of_form = (e->forms.size() > 1 ? kOneOfSeveral : kForm) * p.value;
        p.stderr_value = std::min(p.stderr_value, std::hypot(by_all, of_form));
      }
  }
}

ToldByAll tell_joints_by_all(const std::vector<JoinedRun>& runs, const std::vector<Recording>& recordings,
                             const std::vector<std::string>& names, const std::vector<Diagnosis>& of_units,
                             const Vehicle& nominal, double family_wise_error, GeometryFit& geometry) {
  Vehicle calibrated = nominal;
  for (std::size_t u = 0; u < of_units.size(); ++u)
    calibrated = with_drive(calibrated, u, std::get<DifferentialDrive>(of_units[u].calibration.vehicle.kind));
  std::vector<JoinedRun> beside = runs;
  for (std::size_t r = 0; r < beside.size(); ++r) {
    JoinedRun& run = beside[r];
    run.tracked = at_least_apart(run.tracked, kTruthApart_s);
    const double late_s = nominal.truth.time_offset_s + geometry.clock_s[r];
    for (std::size_t u = 0; u < of_units.size() && u < run.guessed.size(); ++u)
      for (const Finding& f : of_units[u].findings) {
        const TimeStretches times = times_of(f, recordings[r], run, geometry.vehicle, late_s, u);
        run.guessed[u].insert(run.guessed[u].end(), times.begin(), times.end());
      }
  }
  JoinedModel model(std::move(beside), calibrated, geometry.clock_s, names);
  ToldByAll told;
  const std::vector<LastingOnUnit> lasting = lasting_on(of_units);
  if (lasting.empty()) {
    model.fit_all();
  } else {
    const std::vector<std::optional<JoinedModel::Known>> times = model.fit_all_beside(acting(lasting));
    for (std::size_t k = 0; k < lasting.size(); ++k)
      if (times[k])
        told.sizes.push_back({lasting[k].unit, lasting[k].effect.active, times[k]->value, times[k]->stderr_value});
  }
  if (!lasting.empty() && carries_truth(units_of(nominal)))
    take_joints(model, nominal, geometry);
  else
    take_biases(model, nominal, geometry);
  told.erring = unnamed_joint(model, family_wise_error);
  return told;
}

}  // namespace odolab
