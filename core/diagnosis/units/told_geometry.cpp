#include "core/diagnosis/units/told_geometry.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/units/others_way.h"
#include "core/diagnosis/units/unit_recordings.h"

namespace odolab {

namespace {

// What wheels that are all larger or smaller than in the file by one share make of the link's length at most: without a
// truth lengths are shares of the wheels'.
double length_by_scale_m(const Vehicle& nominal) {
  constexpr double kScale = 0.03;  // as core/calibration/linked.cpp expects of a truck's wheels
  return kScale / (1.0 - kScale) * length_of_joint_m(nominal);
}

// Where the lines through the pivots meet the axles; other vehicles' fits stay as they are.
void take_asides(const JoinedModel& model, GeometryFit& fit) {
  const auto* from = std::get_if<MultiCastor>(&model.vehicle().kind);
  auto* to = std::get_if<MultiCastor>(&fit.vehicle.kind);
  for (std::size_t i = 0; from && to && i < to->castors.size(); ++i) {
    Castor& castor = to->castors[i];
    const double track_m = castor.track_m();
    castor.wheel_offset_left_m = track_m * from->castors[i].wheel_offset_left_m / from->castors[i].track_m();
    castor.wheel_offset_right_m = track_m - castor.wheel_offset_left_m;
    fit.aside_stderr_m.resize(to->castors.size());
    fit.aside_stderr_m[i] = model.stderr_of_aside_m(i);
  }
}

}  // namespace

GeometryFit geometry_of_file(const Vehicle& nominal, std::size_t recordings) {
  GeometryFit fit;
  fit.vehicle = nominal;
  for (const JointParameter& p : joint_parameters(nominal)) {
    fit.joints.push_back({p});
    fit.joints.back().nominal = fit.joints.back().value = p.of(fit.vehicle);
    fit.joints.back().stderr_value = p.prior;
  }
  for (const VehicleUnit& unit : units_of(nominal)) fit.drives.push_back(unit.drive);
  fit.clock_s.assign(recordings, 0.0);
  fit.clock_stderr_s.assign(recordings, 0.0);
  return fit;
}

GeometryFit told_geometry(const JoinedModel& model, const Vehicle& nominal) {
  constexpr double kDeterminedBelow = 0.5;  // of what was expected before
  GeometryFit fit = geometry_of_file(nominal, model.given().size());
  for (JointEstimate& estimate : fit.joints) {
    const JointParameter& p = estimate.parameter;
    const std::optional<JoinedModel::Known> known = model.length(p.name);
    if (!known) continue;
    estimate.stderr_value = known->stderr_value;
    estimate.determined = known->stderr_value < kDeterminedBelow * p.prior;
    estimate.is_from_inside = p.component != "truth";
    if (p.effect == "link_length_bias" && !model.has_truth()) estimate.feigned = length_by_scale_m(nominal);
    if (estimate.determined) p.of(fit.vehicle) = estimate.value += known->value;
  }
  fit.drives.clear();
  for (const VehicleUnit& unit : units_of(model.vehicle())) fit.drives.push_back(unit.drive);
  for (std::size_t r = 0; r < model.given().size(); ++r) {
    fit.clock_s[r] = model.clock_s(r);
    fit.clock_stderr_s[r] = model.stderr_of_clock_s(r);
  }
  set_most_pivots_right(fit);
  take_asides(model, fit);
  return fit;
}

Recording recording_by_positions(const Recording& recording, const std::vector<UnitSample>& samples,
                                 const JoinedRun& run, double clock_s, const JoinedModel& model) {
  JoinedFilter filter(run, model.vehicle(), clock_s);
  filter.run(model.noise());
  const Track unit = filter.smoothed().front();
  const double late_s = model.vehicle().truth.time_offset_s + clock_s;
  Track tracked = run.tracked;
  for (TimedPose& t : tracked) {
    const double at_s = std::clamp(t.time_s - late_s, unit.front().time_s, unit.back().time_s);
    const Pose axle_T_tracked = inverse(tracked_T_axle(model.vehicle(), 0, joints_at(samples, at_s)));
    t.pose.heading_rad = (*pose_at(unit, at_s) * axle_T_tracked).heading_rad;
  }
  Recording own = recording_of_unit(recording, samples, tracked, model.vehicle(), 0, clock_s, true);
  std::erase_if(own.channels, [](const Channel& c) { return c.name == "truth_heading_rad"; });
  return own;
}

namespace {

void take_from(const JoinedModel& model, const Vehicle& nominal,
               const std::function<bool(const JointEstimate& has, const JointEstimate& told)>& is_better,
               GeometryFit& fit) {
  const GeometryFit told = told_geometry(model, nominal);
  std::vector<Eigen::Index> taken;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < fit.joints.size(); ++k) {
    JointEstimate& e = fit.joints[k];
    const JointEstimate& by_all = told.joints[k];
    if (!by_all.determined || !is_better(e, by_all)) continue;
    e.parameter.of(fit.vehicle) = e.value = by_all.value;
    e.stderr_value = by_all.stderr_value;
    e.determined = e.is_from_inside = true;
    taken.push_back(static_cast<Eigen::Index>(k));
    names.push_back(e.parameter.name);
  }
  if (fit.covariance.rows() == 0) return;
  for (const Eigen::Index k : taken) {
    fit.covariance.row(k).setZero();
    fit.covariance.col(k).setZero();
  }
  fit.covariance(taken, taken) = model.covariance_of(names);
}

}  // namespace

void take_biases(const JoinedModel& model, const Vehicle& nominal, GeometryFit& fit) {
  take_from(
      model, nominal,
      [](const JointEstimate& has, const JointEstimate& told) {
        return has.is_of_an_encoder() && !(has.determined && told.stderr_value > has.stderr_value);
      },
      fit);
}

void take_joints(const JoinedModel& model, const Vehicle& nominal, GeometryFit& fit) {
  take_from(
      model, nominal, [](const JointEstimate& has, const JointEstimate&) { return has.parameter.component != "truth"; },
      fit);
}

Pose start_of(const JoinedModel& model, std::size_t run) {
  const Pose unit = model.runs()[run].smoothed().front().front().pose;
  return unit *
         inverse(tracked_T_axle(without_mounting(model.vehicle()), 0, model.given()[run].samples.front().joints));
}

void widen_by_scale(double share, Diagnosis& one) {
  for (LeastSquaresCalibration* c : {&one.calibration, &one.calibration_alone})
    for (ParameterEstimate& p : c->parameters)
      if (p.name.rfind("wheel", 0) == 0) p.stderr_value = std::hypot(p.stderr_value, share * p.value);
}

}  // namespace odolab
