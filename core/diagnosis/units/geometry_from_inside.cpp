#include "core/diagnosis/units/geometry_from_inside.h"

#include "core/calibration/linked.h"

namespace odolab {

namespace {

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
  }
  return estimate;
}

}  // namespace

Result<GeometryFit> geometry_from_inside(const std::vector<Understood>& train, const Vehicle& nominal,
                                         const Progress& progress) {
  const Vehicle vehicle = without_mounting(nominal);
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

}  // namespace odolab
