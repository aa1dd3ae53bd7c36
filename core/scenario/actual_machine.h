// How the machine itself differs from its drawing, for vehicles other than a differential drive.
#pragma once

#include <array>
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

// The wheels of a synchro drive: three at the corners of an equilateral triangle, the first ahead of the base's centre,
// the second behind to its left, the third behind to its right. Assumptions.
struct ActualSynchroWheels {
  double wheel_circle_radius_m = 0.25;                       // from the base's centre to each wheel
  std::array<double, 3> radius_error = {0.0, 0.0, 0.0};      // of each wheel, as a share of the true radius
  std::array<double, 3> misalignment_rad = {0.0, 0.0, 0.0};  // of each wheel's direction against the turret's
  // Rubber creeps: force over load for each unit of slip, below the grip. 0: hard wheels that hold up to the grip.
  double creep_stiffness = 12.0;
  double relaxation_length_m = 0.05;  // way in which the creep builds up
};

// Two tracks, each of many pads that hold by Coulomb's law and share the weight. Assumptions.
struct ActualTracks {
  double contact_length_m = 0.70;   // of each track on the floor
  int pads = 8;                     // along each track
  double centre_of_mass_x_m = 0.0;  // ahead of the tracks' middle; the load shifts with it
};

// The slip ring through which a trailer's pulses come. Its noise: bursts of false counts in one wheel's encoder, so
// often in the mean, each of up to so many counts of either sign.
struct ActualSlipRing {
  double bursts_per_s = 0.0;
  int largest_burst_counts = 0;
};

struct ActualMachine {
  // True lengths, and true offsets of the sensors; none: just as the nominal vehicle says. Of the same kind as that.
  std::optional<VehicleKind> lengths;
  ActualLink link;
  ActualTrailer trailer;
  ActualCastors castors;
  ActualSynchroWheels synchro;
  ActualTracks tracks;
  ActualSlipRing slip_ring;
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

// Whether a vehicle has this part with an encoder of its own: "truck_a", "link", "trailer", "castor2".
bool has_linked_part(const VehicleKind& kind, const std::string& component);

// Whether vehicles of this kind can be driven sideways.
bool moves_sideways(const VehicleKind& kind);

}  // namespace odolab
