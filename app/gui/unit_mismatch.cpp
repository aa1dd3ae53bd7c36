#include "app/gui/unit_mismatch.h"

#include "core/diagnosis/predicted_mismatch.h"
#include "core/diagnosis/units/held_out_residuals.h"
#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

Diagnosis with_held_out_units(const Diagnosis& diagnosis, const std::vector<Recording>& fitted,
                              const std::vector<Recording>& held_out, const Vehicle& nominal) {
  return has_units(nominal) ? with_held_out_residuals_of_units(diagnosis, fitted, held_out, nominal)
                            : with_held_out_residuals(diagnosis, held_out, nominal);
}

std::vector<UnitMismatch> unit_mismatches(const Diagnosis& diagnosis, const std::string& recording,
                                          const Vehicle& nominal) {
  std::vector<UnitMismatch> all;
  for (const VehicleUnit& unit : units_of(nominal)) {
    const std::string name = recording_of_unit(recording, unit.name);
    const Residuals* left = of_recording(diagnosis.residuals_before, name);
    if (!left || left->recording != name || left->time_s.empty()) continue;
    const MismatchOverTime m = mismatch_over_time(diagnosis, name);
    all.push_back({unit.name, m, mean_square(*left), ui::Trail(m.time_s, m.x_m, m.y_m, m.before)});
  }
  return all;
}

}  // namespace odolab
