#include "core/diagnosis/units/held_out_residuals.h"

#include <cmath>

#include "core/calibration/least_squares.h"
#include "core/diagnosis/predicted_mismatch.h"
#include "core/diagnosis/units/unit_models.h"

namespace odolab {

namespace {

constexpr int kHalvings = 10;  // of the range of the noise, which begins a hundredfold

FittedNoise times(FittedNoise noise, double factor) {
  noise.wheel_m_per_sqrt_m *= factor;
  noise.along_m_per_sqrt_m *= factor;
  noise.turning_m_per_sqrt_m *= factor;
  noise.sideways_m_per_sqrt_m *= factor;
  noise.command_timing_s *= factor;
  return noise;
}

// The noise of a fit without effects holds what they did. So much of what adds up is left that the normalised squares
// of the recordings fitted are 1 with the effects.
Result<FittedNoise> noise_beside_effects(const FittedModel& model, const std::vector<Recording>& fitted) {
  const Result<LeastSquaresCalibration> fit = calibrate_least_squares(fitted, model.vehicle);
  if (!fit) return fit.error();
  const auto squared = [&](double factor) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const Recording& recording : fitted)
      if (const Result<Residuals> r = residuals_under(model, times(fit->noise, factor), recording, model.vehicle))
        for (const double s : r->squared) {
          sum += s;
          ++count;
        }
    return count > 0 ? sum / static_cast<double>(count) : 1.0;
  };
  double low = std::log(0.01), high = 0.0;  // squares fall as the noise grows
  if (model.effects.empty() || squared(1.0) >= 1.0) return fit->noise;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (squared(std::exp(middle)) < 1.0 ? high : low) = middle;
  }
  return times(fit->noise, std::exp(high));
}

// What the joints say of a unit's way is on the encoders' clock.
void put_at_truths_stamps(Residuals& r, const Vehicle& vehicle) {
  for (double& t : r.time_s) t += vehicle.truth.time_offset_s;
}

void add_held_out(Diagnosis& all, const Diagnosis& diagnosis, const std::vector<Recording>& fitted,
                  const std::vector<Recording>& held_out, const VehicleUnit& unit, std::size_t u) {
  const FittedModel calibrated = calibrated_model_of(diagnosis), found = model_of(diagnosis);
  const FittedModel calibrated_unit = model_of_unit(calibrated, u), found_unit = model_of_unit(found, u);
  const Result<FittedNoise> noise = noise_beside_effects(found_unit, recordings_of_unit(fitted, found, u));
  if (!noise) return;
  for (const Recording& recording : held_out) {
    const std::vector<Recording> by_calibrated = recordings_of_unit({recording}, calibrated, u),
                                 by_found = recordings_of_unit({recording}, found, u);
    if (by_calibrated.empty() || by_found.empty()) continue;
    Result<Residuals> before = residuals_under(calibrated_unit, *noise, by_calibrated.front(), calibrated_unit.vehicle);
    Result<Residuals> after = residuals_under(found_unit, *noise, by_found.front(), found_unit.vehicle);
    if (!before || !after || before->time_s.empty()) continue;
    if (!unit.carries_truth) {
      put_at_truths_stamps(*before, calibrated.vehicle_in(recording.name));
      put_at_truths_stamps(*after, found.vehicle_in(recording.name));
    }
    before->recording = after->recording = recording_of_unit(recording.name, unit.name);
    all.residuals_before.push_back(std::move(*before));
    all.residuals_after.push_back(std::move(*after));
  }
}

}  // namespace

std::string recording_of_unit(const std::string& recording, const std::string& unit) {
  return unit.empty() ? recording : recording + ", " + unit;
}

Diagnosis with_held_out_residuals_of_units(const Diagnosis& diagnosis, const std::vector<Recording>& fitted,
                                           const std::vector<Recording>& held_out, const Vehicle& nominal) {
  Diagnosis all = diagnosis;
  if (held_out.empty()) return all;
  const std::vector<VehicleUnit> units = units_of(nominal);
  for (std::size_t u = 0; u < units.size(); ++u) add_held_out(all, diagnosis, fitted, held_out, units[u], u);
  return all;
}

}  // namespace odolab
