// How the machine itself differs from its drawing, for vehicles other than a differential drive.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/vehicle/vehicle.h"

namespace odolab {

// The compliant link of CLAPPER and OmniMate: what no drawing says. Assumptions; the paper gives none of these.
struct ActualLink {
  double spring_frequency_hz = 2.0;  // of the two trucks against each other
  double damping_ratio = 0.7;
  // The length's reading swings by this much as truck A turns under the link: amplitude cos(link angle A + phase).
  double length_eccentricity_m = 0.0;
  double length_eccentricity_phase_rad = 0.0;
  double platform_mass_kg = 40.0;  // the OmniMate's, whose free castors roll without resistance
};

// A towed trailer. Assumptions.
struct ActualTrailer {
  double mass_kg = 8.0;
  double moment_of_inertia_kgm2 = 0.5;  // about its axle's centre
  double hitch_noise_rad = 0.0;         // of each reading, standard deviation
};

// Each castor of a multi-castor vehicle. Assumptions.
struct ActualCastors {
  double mass_kg = 4.0;
  double moment_of_inertia_kgm2 = 0.02;  // about its centre of mass, which lies above the axle's centre
};

struct ActualMachine {
  // True lengths, and true offsets of the sensors; none: just as the nominal vehicle says. Of the same kind as that.
  std::optional<VehicleKind> lengths;
  ActualLink link;
  ActualTrailer trailer;
  ActualCastors castors;
};

// Everything that is wrong with it, each a sentence that starts with the key below "actual.".
std::vector<std::string> problems_in(const ActualMachine& machine, const VehicleKind& nominal);

// The true lengths of a machine of this kind.
template <typename Kind>
const Kind& true_lengths(const ActualMachine& machine, const Vehicle& nominal) {
  return std::get<Kind>(machine.lengths ? *machine.lengths : nominal.kind);
}

// A wheel's true radius that stands for all: by it the height of bumps is judged.
double typical_wheel_radius_m(const VehicleKind& kind);

// Whether vehicles of this kind can be driven sideways.
bool moves_sideways(const VehicleKind& kind);

}  // namespace odolab
