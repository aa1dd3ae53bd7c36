#include "core/scenario/actual_machine.h"

#include "core/vehicle/demands.h"

namespace odolab {

namespace {

struct TypicalRadius {
  double operator()(const DifferentialDrive& drive) const { return drive.wheel_radius_left_m; }
  double operator()(const SynchroDrive& drive) const { return drive.wheel_radius_m; }
  double operator()(const Tracked& tracks) const { return tracks.sprocket_radius_left_m; }
  double operator()(const LinkedTrucks& trucks) const { return trucks.truck_a.wheel_radius_left_m; }
  double operator()(const EncoderTrailer& train) const { return train.tow.wheel_radius_left_m; }
  double operator()(const SmartEncoderTrailer& train) const { return train.tow.wheel_radius_left_m; }
  double operator()(const MultiCastor& vehicle) const { return vehicle.castors.front().wheel_radius_left_m; }
};

}  // namespace

std::vector<std::string> problems_in(const ActualMachine& machine, const VehicleKind& nominal) {
  Demands demands;
  if (machine.lengths) {
    if (machine.lengths->index() != nominal.index()) {
      demands.add("lengths", "another kind of vehicle", "the nominal vehicle's kind");
    } else {
      demands.add(problems_in(*machine.lengths));
    }
  }
  demands.above_zero("link.spring_frequency_hz", machine.link.spring_frequency_hz, "a frequency in hertz");
  demands.zero_or_more("link.damping_ratio", machine.link.damping_ratio, "a ratio");
  demands.within("link.length_eccentricity_m", machine.link.length_eccentricity_m, 0.1, "a length in metres");
  demands.above_zero("link.platform_mass_kg", machine.link.platform_mass_kg, "a mass in kilograms");
  demands.above_zero("trailer.mass_kg", machine.trailer.mass_kg, "a mass in kilograms");
  demands.above_zero("trailer.moment_of_inertia_kgm2", machine.trailer.moment_of_inertia_kgm2,
                     "a moment of inertia in kg m2");
  demands.zero_or_more("trailer.hitch_noise_rad", machine.trailer.hitch_noise_rad, "an angle in radians");
  demands.above_zero("castors.mass_kg", machine.castors.mass_kg, "a mass in kilograms");
  demands.above_zero("castors.moment_of_inertia_kgm2", machine.castors.moment_of_inertia_kgm2,
                     "a moment of inertia in kg m2");
  return std::move(demands).problems();
}

double typical_wheel_radius_m(const VehicleKind& kind) { return std::visit(TypicalRadius{}, kind); }

bool moves_sideways(const VehicleKind& kind) {
  return std::holds_alternative<Clapper>(kind) || std::holds_alternative<OmniMate>(kind) ||
         std::holds_alternative<MultiCastor>(kind);
}

}  // namespace odolab
