#include "core/scenario/machine_parameters.h"

namespace odolab {

std::vector<VehicleParameter> machine_parameters_of(Scenario& scenario) {
  using Unit = ParameterUnit;
  const VehicleKind& kind = scenario.vehicle.kind;
  ActualMachine& m = scenario.machine;
  std::vector<VehicleParameter> list;
  const auto add = [&](const char* group, const char* label, Unit unit, double& value, const char* about) {
    list.push_back({group, label, about, unit, &value, true});
  };
  const bool omnimate = std::holds_alternative<OmniMate>(kind), synchro = std::holds_alternative<SynchroDrive>(kind);
  const bool linked = omnimate || std::holds_alternative<Clapper>(kind),
             tracked = std::holds_alternative<Tracked>(kind);
  const bool behind_tracks = std::holds_alternative<EncoderTrailer>(kind);
  add("", linked ? "mass each" : "mass", Unit::kilograms, scenario.actual.mass_kg,
      "Mass of the vehicle; of linked trucks each one's, of a castor vehicle the platform's.");
  add("", "inertia", Unit::kilogram_square_metres, scenario.actual.moment_of_inertia_kgm2,
      "Moment of inertia of the same body about the vertical axis.");
  if (linked) {
    add("link", "spring", Unit::hertz, m.link.spring_frequency_hz, "Frequency of the trucks against each other.");
    add("link", "damping", Unit::ratio, m.link.damping_ratio, "Damping ratio of the spring.");
    add("link", "eccentricity", Unit::metres, m.link.length_eccentricity_m,
        "By how much the length's reading swings as truck A turns under the link.");
  }
  if (omnimate)
    add("link", "platform mass", Unit::kilograms, m.link.platform_mass_kg, "Mass of the platform on both trucks.");
  if (behind_tracks || std::holds_alternative<SmartEncoderTrailer>(kind)) {
    add("trailer", "trailer mass", Unit::kilograms, m.trailer.mass_kg, "Mass of the trailer.");
    add("trailer", "hitch noise", Unit::radians, m.trailer.hitch_noise_rad,
        "Standard deviation of each reading of the hitch's encoder.");
  }
  if (std::holds_alternative<MultiCastor>(kind))
    add("castors", "castor mass", Unit::kilograms, m.castors.mass_kg, "Mass of each castor.");
  if (synchro) {
    const char* kWheels[] = {"front wheel", "left wheel", "right wheel"};
    for (std::size_t i = 0; i < 3; ++i) {
      add(kWheels[i], "radius error", Unit::share, m.synchro.radius_error[i], "Of the wheel's true radius.");
      add(kWheels[i], "misaligned", Unit::radians, m.synchro.misalignment_rad[i],
          "The wheel's direction against the turret's.");
    }
    add("wheels", "wheel circle", Unit::metres, m.synchro.wheel_circle_radius_m, "From the centre to each wheel.");
  }
  if (tracked || behind_tracks) {
    add("tracks", "contact", Unit::metres, m.tracks.contact_length_m, "Length of each track on the floor.");
    add("tracks", "centre of mass", Unit::metres, m.tracks.centre_of_mass_x_m, "Ahead of the tracks' middle.");
  }
  return list;
}

}  // namespace odolab
