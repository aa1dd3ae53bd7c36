#include "core/diagnosis/units/merged_calibration.h"

#include <cmath>
#include <tuple>

#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

// The vehicle file's key of a drive's parameter in its unit, whose own recordings were made by `judged_by`.
std::vector<ParameterEstimate> in_file(const ParameterEstimate& p, const VehicleUnit& unit, const Vehicle& nominal,
                                       const Vehicle& judged_by, std::size_t u, const AxleAside& aside) {
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
  if (const auto* platform = std::get_if<MultiCastor>(&judged_by.kind); platform && p.name == "wheelbase_m") {
    const Castor& castor = platform->castors[u];
    std::vector<ParameterEstimate> two;
    const Castor& file = std::get<MultiCastor>(nominal.kind).castors[u];
    for (const auto& [name, nominal_m, offset_m, sign] :
         {std::tuple{"wheel_offset_left_m", file.wheel_offset_left_m, castor.wheel_offset_left_m, 1.0},
          std::tuple{"wheel_offset_right_m", file.wheel_offset_right_m, castor.wheel_offset_right_m, -1.0}}) {
      ParameterEstimate one = p;
      const double share = offset_m / castor.track_m();
      one.name = before + name;
      one.nominal = nominal_m;
      one.value = share * p.value + sign * aside.moved_m;
      one.stderr_value = std::hypot(share * p.stderr_value, aside.stderr_m);
      two.push_back(one);
    }
    return two;
  }
  renamed.name = before + renamed.name;
  return {renamed};
}

// The body is where its pivots are in the mean, and the file's body is so no better than its pivots are: by how far
// they scatter about the file, beside the whole moved and turned.
double stderr_of_body_m(const GeometryFit& geometry, const Vehicle& nominal) {
  const auto& file = std::get<MultiCastor>(nominal.kind).castors;
  const auto& now = std::get<MultiCastor>(geometry.vehicle.kind).castors;
  const double n = static_cast<double>(file.size());
  if (file.size() < 2) return 0.0;
  double squares_m2 = 0.0;
  for (std::size_t i = 0; i < file.size(); ++i) {
    const auto at = [](const Castor& c) { return rotated({c.pivot_radius_m, 0.0}, c.pivot_angle_rad); };
    const Vec2 off = at(now[i]) - at(file[i]);
    squares_m2 += dot(off, off);
  }
  return std::sqrt(squares_m2 / (2.0 * n - 3.0) / n);
}

}  // namespace

AxleAside axle_aside(const LeastSquaresCalibration& of_castor, const GeometryFit& geometry, std::size_t unit) {
  const double beside_pivot_m = unit < geometry.aside_stderr_m.size() ? geometry.aside_stderr_m[unit] : kAsidePrior_m;
  for (const ParameterEstimate& p : of_castor.parameters)
    if (p.name == "truth_mounting.y_m" && p.determined)
      return {p.nominal - p.value, std::hypot(p.stderr_value, beside_pivot_m)};
  return {0.0, kAsidePrior_m};
}

LeastSquaresCalibration merged_calibration(const std::vector<Diagnosis>& diagnoses,
                                           LeastSquaresCalibration Diagnosis::*which, const GeometryFit& geometry,
                                           const std::vector<VehicleUnit>& units, const Vehicle& nominal) {
  LeastSquaresCalibration sum;
  sum.vehicle = geometry.vehicle;
  bool truth_is_carried = false;
  for (std::size_t u = 0; u < units.size(); ++u) {
    const LeastSquaresCalibration& one = diagnoses[u].*which;
    sum.vehicle = with_drive(sum.vehicle, u, std::get<DifferentialDrive>(one.vehicle.kind));
    const AxleAside aside = axle_aside(one, geometry, u);
    move_aside(sum.vehicle, u, aside.moved_m);
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
      for (ParameterEstimate& renamed : in_file(p, units[u], nominal, geometry.vehicle, u, aside))
        sum.parameters.push_back(std::move(renamed));
    }
    for (const std::string& sentence : one.cannot_tell)
      sum.cannot_tell.push_back(units[u].name.empty() ? sentence : part_words(units[u].name) + ": " + sentence);
    sum.scale_is_open = sum.scale_is_open || one.scale_is_open;
    sum.innovations += one.innovations;
    sum.outliers += one.outliers;
    const double share = 1.0 / static_cast<double>(units.size());
    for (double FittedNoise::*size :
         {&FittedNoise::wheel_m_per_sqrt_m, &FittedNoise::truth_position_m, &FittedNoise::truth_heading_rad})
      sum.noise.*size = std::sqrt(sum.noise.*size * sum.noise.*size + share * one.noise.*size * one.noise.*size);
    sum.normalised_chi2 += share * one.normalised_chi2;
    sum.normalised_chi2_nominal += share * one.normalised_chi2_nominal;
  }
  const bool is_platform = std::holds_alternative<MultiCastor>(nominal.kind);
  const double body_m = is_platform ? stderr_of_body_m(geometry, nominal) : 0.0;
  for (const JointEstimate& e : geometry.joints) {
    const bool of_truth = e.parameter.component == "truth";
    if (of_truth && truth_is_carried) continue;
    const bool is_of_body = body_m > 0.0 && (of_truth || e.parameter.name.find("pivot_radius") != std::string::npos);
    sum.parameters.push_back(
        {e.parameter.name, e.parameter.unit, e.nominal, e.value,
         std::hypot(e.stderr_value, e.feigned, is_of_body && e.parameter.unit == "m" ? body_m : 0.0), e.determined});
  }
  if (!truth_is_carried)
    for (double clock_s : geometry.clock_s) sum.time_offset_s.push_back(nominal.truth.time_offset_s + clock_s);
  return sum;
}

}  // namespace odolab
