#include "core/io/actual_toml.h"

#include "core/io/toml_table.h"
#include "core/io/toml_text.h"
#include "core/io/vehicle_toml.h"

namespace odolab {

namespace {

// Wheels of a differential drive alone: other kinds have true lengths in a table of their own.
template <typename S, typename Toml>
void actual_wheel_fields(S& actual, Toml& toml) {
  toml.field("wheel_radius_left_m", actual.wheel_radius_left_m);
  toml.field("wheel_radius_right_m", actual.wheel_radius_right_m);
  toml.field("wheelbase_m", actual.wheelbase_m);
}

// Of the vehicle, or of each truck.
template <typename S, typename Toml>
void body_fields(S& actual, Toml& toml) {
  toml.field("toe_left_rad", actual.toe_left_rad);
  toml.field("toe_right_rad", actual.toe_right_rad);
  toml.field("mass_kg", actual.mass_kg);
  toml.field("moment_of_inertia_kgm2", actual.moment_of_inertia_kgm2);
  toml.field("drive_wheel_load_share", actual.drive_wheel_load_share);
}

// The parts that a drawing does not know, a table each.

template <typename S, typename Toml>
void link_fields(S& link, Toml& toml) {
  toml.field("spring_frequency_hz", link.spring_frequency_hz);
  toml.field("damping_ratio", link.damping_ratio);
  toml.field("length_eccentricity_m", link.length_eccentricity_m);
  toml.field("length_eccentricity_phase_rad", link.length_eccentricity_phase_rad);
  toml.field("platform_mass_kg", link.platform_mass_kg);
}

template <typename S, typename Toml>
void trailer_fields(S& trailer, Toml& toml) {
  toml.field("mass_kg", trailer.mass_kg);
  toml.field("moment_of_inertia_kgm2", trailer.moment_of_inertia_kgm2);
  toml.field("hitch_noise_rad", trailer.hitch_noise_rad);
}

template <typename S, typename Toml>
void actual_castor_fields(S& castors, Toml& toml) {
  toml.field("mass_kg", castors.mass_kg);
  toml.field("moment_of_inertia_kgm2", castors.moment_of_inertia_kgm2);
}

template <typename S, typename Toml>
void synchro_fields(S& synchro, Toml& toml) {
  toml.field("wheel_circle_radius_m", synchro.wheel_circle_radius_m);
  toml.field("radius_error_front", synchro.radius_error[0]);
  toml.field("radius_error_left", synchro.radius_error[1]);
  toml.field("radius_error_right", synchro.radius_error[2]);
  toml.field("misalignment_front_rad", synchro.misalignment_rad[0]);
  toml.field("misalignment_left_rad", synchro.misalignment_rad[1]);
  toml.field("misalignment_right_rad", synchro.misalignment_rad[2]);
  toml.field("creep_stiffness", synchro.creep_stiffness);
  toml.field("relaxation_length_m", synchro.relaxation_length_m);
}

template <typename S, typename Toml>
void tracks_fields(S& tracks, Toml& toml) {
  toml.field("contact_length_m", tracks.contact_length_m);
  toml.field("pads", tracks.pads);
  toml.field("centre_of_mass_x_m", tracks.centre_of_mass_x_m);
}

template <typename S, typename Toml>
void slip_ring_fields(S& ring, Toml& toml) {
  toml.field("bursts_per_s", ring.bursts_per_s);
  toml.field("largest_burst_counts", ring.largest_burst_counts);
}

// What a kind of vehicle has. `part` opens the table of a name and hands it to the list of its fields.
template <typename Machine, typename Part>
void parts(Machine& machine, const VehicleKind& kind, const Part& part) {
  if (std::holds_alternative<Clapper>(kind) || std::holds_alternative<OmniMate>(kind))
    part("link", [&](auto& toml) { link_fields(machine.link, toml); });
  if (std::holds_alternative<EncoderTrailer>(kind) || std::holds_alternative<SmartEncoderTrailer>(kind))
    part("trailer", [&](auto& toml) { trailer_fields(machine.trailer, toml); });
  if (std::holds_alternative<MultiCastor>(kind))
    part("castors", [&](auto& toml) { actual_castor_fields(machine.castors, toml); });
  if (std::holds_alternative<SynchroDrive>(kind))
    part("synchro", [&](auto& toml) { synchro_fields(machine.synchro, toml); });
  if (std::holds_alternative<Tracked>(kind) || std::holds_alternative<EncoderTrailer>(kind))
    part("tracks", [&](auto& toml) { tracks_fields(machine.tracks, toml); });
  if (std::holds_alternative<EncoderTrailer>(kind))
    part("slip_ring", [&](auto& toml) { slip_ring_fields(machine.slip_ring, toml); });
}

}  // namespace

void read_actual(TomlTable table, Scenario& scenario, bool as_drawn_at_first) {
  if (const auto* drive = std::get_if<DifferentialDrive>(&scenario.vehicle.kind)) {
    if (as_drawn_at_first) scenario.actual = as_drawn(*drive);
    actual_wheel_fields(scenario.actual, table);
    body_fields(scenario.actual, table);
    return;
  }
  body_fields(scenario.actual, table);
  const std::string kind = kind_name(scenario.vehicle);
  if (table.has_table(kind.c_str())) {
    TomlTable lengths = table.table(kind.c_str());
    if (as_drawn_at_first || !scenario.machine.lengths) scenario.machine.lengths = scenario.vehicle.kind;
    read_vehicle_kind(lengths, *scenario.machine.lengths);
  }
  parts(scenario.machine, scenario.vehicle.kind, [&](const char* name, const auto& fields) {
    TomlTable inner = table.table(name);
    fields(inner);
  });
}

void write_actual(TomlText& text, const Scenario& scenario) {
  text.table("actual");
  if (std::holds_alternative<DifferentialDrive>(scenario.vehicle.kind)) actual_wheel_fields(scenario.actual, text);
  body_fields(scenario.actual, text);
  if (scenario.machine.lengths) {
    const std::string path = "actual." + kind_name(scenario.vehicle);
    text.table(path);
    write_vehicle_kind(text, *scenario.machine.lengths, path);
  }
  parts(scenario.machine, scenario.vehicle.kind, [&](const char* name, const auto& fields) {
    text.table(std::string("actual.") + name);
    fields(text);
  });
}

}  // namespace odolab
