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
  double operator()(const MultiCastor& vehicle) const {
    return (vehicle.castors.empty() ? Castor{} : vehicle.castors.front()).wheel_radius_left_m;
  }
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
  const ActualSynchroWheels& wheels = machine.synchro;
  demands.above_zero("synchro.wheel_circle_radius_m", wheels.wheel_circle_radius_m, "a length in metres");
  demands.length_below("synchro.wheel_circle_radius_m", wheels.wheel_circle_radius_m, 50.0);
  for (const double share : wheels.radius_error) demands.within("synchro.radius_error", share, 0.5, "a share");
  for (const double rad : wheels.misalignment_rad)
    demands.within("synchro.misalignment_rad", rad, 0.5, "an angle in radians");
  demands.zero_or_more("synchro.creep_stiffness", wheels.creep_stiffness, "a ratio");
  demands.above_zero("synchro.relaxation_length_m", wheels.relaxation_length_m, "a length in metres");
  const ActualTracks& tracks = machine.tracks;
  demands.zero_or_more("tracks.contact_length_m", tracks.contact_length_m, "a length in metres");
  demands.length_below("tracks.contact_length_m", tracks.contact_length_m, 50.0);
  if (tracks.pads < 1 || tracks.pads > 64) demands.add("tracks.pads", std::to_string(tracks.pads), "1 to 64");
  // Beyond a sixth of the length the load of a pad would turn negative.
  demands.within("tracks.centre_of_mass_x_m", tracks.centre_of_mass_x_m, tracks.contact_length_m / 6.0 + 1e-12,
                 "a sixth of the contact length");
  demands.zero_or_more("slip_ring.bursts_per_s", machine.slip_ring.bursts_per_s, "a rate");
  if (machine.slip_ring.largest_burst_counts < 0)
    demands.add("slip_ring.largest_burst_counts", std::to_string(machine.slip_ring.largest_burst_counts), "0 or more");
  return std::move(demands).problems();
}

double typical_wheel_radius_m(const VehicleKind& kind) { return std::visit(TypicalRadius{}, kind); }

bool has_linked_part(const VehicleKind& kind, const std::string& component) {
  if (std::holds_alternative<Clapper>(kind) || std::holds_alternative<OmniMate>(kind))
    return component == "truck_a" || component == "truck_b" || component == "link";
  if (std::holds_alternative<EncoderTrailer>(kind) || std::holds_alternative<SmartEncoderTrailer>(kind))
    return component == "trailer";
  if (const auto* vehicle = std::get_if<MultiCastor>(&kind))
    for (std::size_t i = 1; i <= vehicle->castors.size(); ++i)
      if (component == "castor" + std::to_string(i)) return true;
  return false;
}

bool moves_sideways(const VehicleKind& kind) {
  return std::holds_alternative<Clapper>(kind) || std::holds_alternative<OmniMate>(kind) ||
         std::holds_alternative<MultiCastor>(kind);
}

}  // namespace odolab
