#include "core/diagnosis/units/held_out_residuals.h"

#include "core/calibration/least_squares.h"
#include "core/diagnosis/predicted_mismatch.h"
#include "core/diagnosis/units/unit_models.h"

namespace odolab {

namespace {

constexpr std::size_t kFirst = 0;

}  // namespace

Diagnosis with_held_out_residuals_of_units(const Diagnosis& diagnosis, const std::vector<Recording>& fitted,
                                           const std::vector<Recording>& held_out, const Vehicle& nominal) {
  Diagnosis all = diagnosis;
  const FittedModel calibrated = calibrated_model_of(diagnosis), found = model_of(diagnosis);
  const std::string name = units_of(nominal)[kFirst].name;
  const FittedModel calibrated_unit = model_of_unit(calibrated, kFirst), found_unit = model_of_unit(found, kFirst);
  const Result<LeastSquaresCalibration> fit =
      calibrate_least_squares(recordings_of_unit(fitted, found, kFirst), found_unit.vehicle);
  if (!fit) return all;
  for (const Recording& recording : held_out) {
    const std::vector<Recording> by_calibrated = recordings_of_unit({recording}, calibrated, kFirst),
                                 by_found = recordings_of_unit({recording}, found, kFirst);
    if (by_calibrated.empty() || by_found.empty()) continue;
    Result<Residuals> before =
        residuals_under(calibrated_unit, fit->noise, by_calibrated.front(), calibrated_unit.vehicle);
    Result<Residuals> after = residuals_under(found_unit, fit->noise, by_found.front(), found_unit.vehicle);
    if (!before || !after || before->time_s.empty()) continue;
    before->recording = after->recording = name.empty() ? recording.name : recording.name + ", " + name;
    all.residuals_before.push_back(std::move(*before));
    all.residuals_after.push_back(std::move(*after));
  }
  return all;
}

}  // namespace odolab
