#include "core/diagnosis/units/merged_calibration.h"

#include <cmath>
#include <utility>

#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

// The vehicle file's key of a drive's parameter in its unit.
std::vector<ParameterEstimate> in_file(const ParameterEstimate& p, const VehicleUnit& unit, const Vehicle& nominal,
                                       std::size_t u) {
  ParameterEstimate renamed = p;
  const std::string before = unit.key.empty() ? "" : unit.key + ".";
  if (const auto* tracks = std::get_if<Tracked>(&nominal.kind)) {
    if (p.name == "wheel_radius_left_m") renamed.name = "sprocket_radius_left_m";
    if (p.name == "wheel_radius_right_m") renamed.name = "sprocket_radius_right_m";
    if (p.name == "wheelbase_m") {
      renamed.name = "slip_factor";
      renamed.unit = "1";
      for (double ParameterEstimate::*value :
           {&ParameterEstimate::nominal, &ParameterEstimate::value, &ParameterEstimate::stderr_value})
        renamed.*value /= tracks->track_width_m;
    }
  }
  if (const auto* platform = std::get_if<MultiCastor>(&nominal.kind); platform && p.name == "wheelbase_m") {
    const Castor& castor = platform->castors[u];
    std::vector<ParameterEstimate> two;
    for (const auto& [name, offset_m] : {std::pair{"wheel_offset_left_m", castor.wheel_offset_left_m},
                                         std::pair{"wheel_offset_right_m", castor.wheel_offset_right_m}}) {
      ParameterEstimate one = p;
      const double share = offset_m / castor.track_m();
      one.name = before + name;
      one.nominal *= share;
      one.value *= share;
      one.stderr_value *= share;
      two.push_back(one);
    }
    return two;
  }
  renamed.name = before + renamed.name;
  return {renamed};
}

}  // namespace

LeastSquaresCalibration merged_calibration(const std::vector<Diagnosis>& diagnoses,
                                           LeastSquaresCalibration Diagnosis::*which, const GeometryFit& geometry,
                                           const std::vector<VehicleUnit>& units, const Vehicle& nominal) {
  LeastSquaresCalibration sum;
  sum.vehicle = geometry.vehicle;
  bool truth_is_carried = false;
  for (std::size_t u = 0; u < units.size(); ++u) {
    const LeastSquaresCalibration& one = diagnoses[u].*which;
    sum.vehicle = with_drive(sum.vehicle, u, std::get<DifferentialDrive>(one.vehicle.kind));
    if (units[u].carries_truth) {
      sum.vehicle.truth = one.vehicle.truth;
      sum.time_offset_s = one.time_offset_s;
      sum.innovations_are_correlated = one.innovations_are_correlated;  // of others joints are rounded
      truth_is_carried = true;
    }
    for (const ParameterEstimate& p : one.parameters) {
      const bool of_truth = p.name.rfind("truth_mounting.", 0) == 0;
      if (of_truth && units[u].carries_truth) sum.parameters.push_back(p);
      if (of_truth) continue;
      for (ParameterEstimate& renamed : in_file(p, units[u], nominal, u)) sum.parameters.push_back(std::move(renamed));
    }
    for (const std::string& sentence : one.cannot_tell)
      sum.cannot_tell.push_back(units[u].name.empty() ? sentence : part_words(units[u].name) + ": " + sentence);
    sum.innovations += one.innovations;
    sum.outliers += one.outliers;
    const double share = 1.0 / static_cast<double>(units.size());
    for (double FittedNoise::*size :
         {&FittedNoise::wheel_m_per_sqrt_m, &FittedNoise::truth_position_m, &FittedNoise::truth_heading_rad})
      sum.noise.*size = std::sqrt(sum.noise.*size * sum.noise.*size + share * one.noise.*size * one.noise.*size);
    sum.normalised_chi2 += share * one.normalised_chi2;
    sum.normalised_chi2_nominal += share * one.normalised_chi2_nominal;
  }
  for (const JointEstimate& e : geometry.joints) {
    const bool of_truth = e.parameter.component == "truth";
    if (of_truth && truth_is_carried) continue;
    sum.parameters.push_back(
        {e.parameter.name, e.parameter.unit, e.nominal, e.value, std::hypot(e.stderr_value, e.feigned), e.determined});
  }
  if (!truth_is_carried)
    for (double clock_s : geometry.clock_s) sum.time_offset_s.push_back(nominal.truth.time_offset_s + clock_s);
  return sum;
}

}  // namespace odolab
