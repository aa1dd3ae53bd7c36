#include "core/diagnosis/units/biases_from_inside.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/units/geometry_from_inside.h"
#include "core/diagnosis/units/mended_counts.h"

namespace odolab {

namespace {

constexpr std::size_t kFewestRuns = 3;
constexpr double kContradicted = 4.0;  // standard errors of both

// The share by which a unit's wheels may be larger or smaller.
double scale_stderr(const Diagnosis& of_unit) {
  for (const ParameterEstimate& p : of_unit.calibration.parameters)
    if (p.name == "wheel_radius_left_m" && p.determined) return p.stderr_value / p.value;
  return 0.0;
}

}  // namespace

bool put_inside_beside_truth(GeometryFit& geometry, const std::vector<Recording>& train, const Vehicle& nominal,
                             const std::vector<Diagnosis>& of_units, const Progress& progress) {
  if (train.size() < kFewestRuns) return false;
  const std::vector<VehicleUnit> units = units_of(nominal);
  Vehicle calibrated = nominal;
  for (std::size_t u = 0; u < units.size(); ++u)
    calibrated = with_drive(calibrated, u, std::get<DifferentialDrive>(of_units[u].calibration.vehicle.kind));
  const std::vector<Understood> all = with_mended_counts(understood_without(of_units, train, nominal), nominal);
  const Result<GeometryFit> inside = geometry_from_inside(all, calibrated, progress);
  std::vector<GeometryFit> without;  // each run in turn
  for (std::size_t r = 0; r < all.size() && inside; ++r) {
    std::vector<Understood> others = all;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(r));
    Result<GeometryFit> one = geometry_from_inside(others, calibrated, progress);
    if (!one) return false;
    without.push_back(std::move(*one));
  }
  if (!inside) return false;

  bool changed = false;
  const double n = static_cast<double>(without.size());
  for (JointEstimate& e : geometry.joints)
    for (std::size_t k = 0; k < inside->joints.size(); ++k) {
      const JointEstimate& i = inside->joints[k];
      if (i.parameter.name != e.parameter.name || !e.is_of_an_encoder() || !i.determined) continue;
      double mean = 0.0, squared = 0.0, scale = 0.0;
      for (const GeometryFit& one : without) mean += one.joints[k].value / n;
      for (const GeometryFit& one : without) squared += (one.joints[k].value - mean) * (one.joints[k].value - mean);
      if (e.parameter.unit == "m") scale = scale_stderr(of_units.front()) * length_of_joint_m(nominal);
      const double error = std::hypot(std::max(i.stderr_value, std::sqrt((n - 1.0) / n * squared)), scale);
      const double apart = i.value - e.value;
      if (!e.determined) {  // nothing contradicts it
        e.value = i.value;
        e.stderr_value = error;
        e.parameter.of(geometry.vehicle) = e.value;
        e.determined = e.is_from_inside = changed = true;
        continue;
      }
      if (std::abs(apart) > kContradicted * std::hypot(error, e.stderr_value)) continue;
      const double by_truth = 1.0 / (e.stderr_value * e.stderr_value), by_inside = 1.0 / (error * error);
      e.value += by_inside / (by_truth + by_inside) * apart;
      e.stderr_value = 1.0 / std::sqrt(by_truth + by_inside);
      e.parameter.of(geometry.vehicle) = e.value;
      e.is_from_inside = by_inside > by_truth;
      changed = true;
    }
  if (changed) geometry.covariance.resize(0, 0);  // which was that of the truth alone
  return changed;
}

}  // namespace odolab
