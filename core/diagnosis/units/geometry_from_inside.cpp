#include "core/diagnosis/units/geometry_from_inside.h"

#include <Eigen/Core>
#include <cmath>

#include "core/base/fixed_point.h"
#include "core/calibration/linked.h"

namespace odolab {

namespace {

std::vector<std::string> held_joints(const Vehicle& vehicle) {
  std::vector<std::string> held = {kClockHeld};
  for (const JointParameter& p : joint_parameters(vehicle))
    if (p.component == "truth") held.push_back(p.name);
  return held;
}

// A smart trailer is a truck B that is rigid up to the link's end: link angle zero, length constant.
Vehicle as_trucks(const Vehicle& vehicle) {
  Vehicle trucks = vehicle;
  if (const auto* train = std::get_if<SmartEncoderTrailer>(&vehicle.kind)) {
    Clapper clapper;
    clapper.truck_a = train->tow;
    clapper.truck_b = train->trailer;
    clapper.link_length_m = train->drawbar_length_m;
    clapper.link_angle_resolution_rad = train->hitch_angle_resolution_rad;
    clapper.link_length_resolution_m = 0.0;
    clapper.link_angle_a_offset_rad = train->hitch_angle_offset_rad;
    trucks.kind = clapper;
  }
  return trucks;
}

std::vector<LinkedSample> as_linked(const std::vector<UnitSample>& samples, const Vehicle& vehicle) {
  const auto* train = std::get_if<SmartEncoderTrailer>(&vehicle.kind);
  std::vector<LinkedSample> linked;
  for (const UnitSample& s : samples)
    linked.push_back({s.time_s, s.wheels[0], s.wheels[1], s.joints[0], train ? 0.0 : s.joints[1],
                      train ? train->drawbar_length_m : s.joints[2]});
  return linked;
}

// What wheels that are all larger or smaller than in the file by one share make of the link's length at most: from the
// inside lengths are shares of the wheels'.
double length_by_scale_m(const Vehicle& nominal) {
  constexpr double kScale = 0.03;  // as core/calibration/linked.cpp expects of a truck's wheels
  return kScale / (1.0 - kScale) * length_of_joint_m(nominal);
}

// The trucks' estimates in the words of the vehicle.
JointEstimate joint_from(const JointParameter& p, const InternalCalibration& calibration, const Vehicle& nominal) {
  const bool of_trailer = std::holds_alternative<SmartEncoderTrailer>(nominal.kind);
  const std::string name = !of_trailer                          ? p.name
                           : p.name == "hitch_angle_offset_rad" ? "link_angle_a_offset_rad"
                           : p.name == "drawbar_length_m"       ? "link_length_offset_m"
                                                                : "";
  JointEstimate estimate{p};
  Vehicle copy = nominal;
  estimate.nominal = estimate.value = p.of(copy);
  for (const ParameterEstimate& e : calibration.parameters) {
    if (e.name != name) continue;
    estimate.stderr_value = e.stderr_value;
    estimate.determined = e.determined;
    if (e.determined) estimate.value += (p.name == "drawbar_length_m" ? -1.0 : 1.0) * (e.value - e.nominal);
    if (e.name == "link_length_offset_m") estimate.feigned = length_by_scale_m(nominal);
  }
  return estimate;
}

// A pivot's bias comes out a twentieth small: of 15 mrad 0.7 were missing twice. And of twenty platforms of another
// program, in nineteen of which no pivot had one, they differed by 1.1 mrad root mean square.
void widen_what_turns_lose(GeometryFit& fit) {
  constexpr double kLostInTurns = 0.05, kUnknown_rad = 0.0011;
  for (JointEstimate& e : fit.joints)
    if (e.parameter.effect == "pivot_angle_bias" && e.determined)
      e.stderr_value = std::hypot(e.stderr_value, kLostInTurns * (e.value - e.nominal), kUnknown_rad);
}

// All that is fitted from the inside.
std::vector<double*> parts_of(Known& known, const std::vector<JointParameter>& joints) {
  std::vector<double*> parts;
  for (const JointParameter& p : joints) parts.push_back(&p.of(known.vehicle));
  for (DifferentialDrive& d : known.drives)
    parts.insert(parts.end(), {&d.wheel_radius_left_m, &d.wheel_radius_right_m, &d.wheelbase_m});
  return parts;
}

Eigen::VectorXd numbers_of(Known& known, const std::vector<JointParameter>& joints) {
  const std::vector<double*> parts = parts_of(known, joints);
  Eigen::VectorXd x(static_cast<Eigen::Index>(parts.size()));
  for (Eigen::Index k = 0; k < x.size(); ++k) x(k) = *parts[static_cast<std::size_t>(k)];
  return x;
}

void set_numbers(Known& known, const std::vector<JointParameter>& joints, const Eigen::VectorXd& x) {
  const std::vector<double*> parts = parts_of(known, joints);
  for (Eigen::Index k = 0; k < x.size(); ++k) *parts[static_cast<std::size_t>(k)] = x(k);
  for (std::size_t u = 0; u < known.drives.size(); ++u) known.vehicle = with_drive(known.vehicle, u, known.drives[u]);
}

// The common way is that of wheels and pivots as they were believed to be: by turns, until both agree. What is nearly
// common to all castors, as wheels that are all too small, moves by a tenth of its way in each.
Result<GeometryFit> geometry_of_castors(const std::vector<Understood>& train, const Vehicle& vehicle) {
  constexpr int kTurns = 30;
  constexpr double kAgree = 1e-5;  // m and rad
  Known known{vehicle, {}};
  for (const VehicleUnit& unit : units_of(vehicle)) known.drives.push_back(unit.drive);
  const std::vector<JointParameter> joints = joint_parameters(vehicle);
  FixedPoint fixed;
  GeometryFit fit;
  for (int turn = 0; turn < kTurns; ++turn) {
    std::vector<JoinedRun> runs;
    for (const Understood& u : train) {
      const Result<Track> track = way_by_others(known, u.samples, known.drives.size());
      if (!track) return track.error();
      runs.push_back({u.samples, *track});
    }
    fit = fitted_geometry(runs, vehicle, held_joints(vehicle), fit.at);
    Known then{fit.vehicle, fit.drives};
    const Eigen::VectorXd at = numbers_of(known, joints), to = numbers_of(then, joints);
    if ((to - at).cwiseAbs().maxCoeff() < kAgree) break;
    if (turn + 1 < kTurns) set_numbers(known, joints, fixed.next(at, to));
  }
  set_most_pivots_right(fit);
  fit.vehicle = without_mounting(fit.vehicle);
  widen_what_turns_lose(fit);
  return fit;
}

Result<GeometryFit> geometry_of_trucks(const std::vector<Understood>& train, const Vehicle& vehicle,
                                       const Progress& progress) {
  std::vector<Recording> recordings;
  for (const Understood& u : train) recordings.push_back(recording_of(as_linked(u.samples, vehicle)));
  const Result<InternalCalibration> calibration = calibrate_linked(recordings, as_trucks(vehicle), progress);
  if (!calibration) return calibration.error();
  GeometryFit fit;
  fit.vehicle = vehicle;
  for (const JointParameter& p : joint_parameters(vehicle)) {
    fit.joints.push_back(joint_from(p, *calibration, vehicle));
    if (fit.joints.back().determined) p.of(fit.vehicle) = fit.joints.back().value;
  }
  for (const VehicleUnit& unit : units_of(calibration->vehicle)) fit.drives.push_back(unit.drive);
  fit.clock_s.assign(train.size(), 0.0);
  fit.clock_stderr_s.assign(train.size(), 0.0);
  return fit;
}

}  // namespace

Result<GeometryFit> geometry_from_inside(const std::vector<Understood>& train, const Vehicle& nominal,
                                         const Progress& progress) {
  const Vehicle vehicle = without_mounting(nominal);
  return std::holds_alternative<MultiCastor>(vehicle.kind) ? geometry_of_castors(train, vehicle)
                                                           : geometry_of_trucks(train, vehicle, progress);
}

}  // namespace odolab
