#include "physics/vehicles/pair_of_tracks.h"

#include "physics/vehicles/driven_axle.h"

namespace odolab {

PairOfTracks::PairOfTracks(PlanarWorld& world, int body, const DifferentialDrive& sprockets, const ActualTracks& actual,
                           const ActualDrive& carried, const Motor& motor, double step_s)
    : world_(&world),
      body_(body),
      step_s_(step_s),
      tracks_{Track{WheelDrive(motor, sprockets.wheel_radius_left_m,
                               0.5 * carried.mass_kg * sprockets.wheel_radius_left_m * sprockets.wheel_radius_left_m),
                    Side::left, sprockets.wheel_radius_left_m},
              Track{WheelDrive(motor, sprockets.wheel_radius_right_m,
                               0.5 * carried.mass_kg * sprockets.wheel_radius_right_m * sprockets.wheel_radius_right_m),
                    Side::right, sprockets.wheel_radius_right_m}} {
  // The pressure falls off evenly along the track, so that the loads balance about the centre of mass.
  const double length_m = actual.contact_length_m;
  const double mean_square_m2 = length_m * length_m * (1.0 - 1.0 / (actual.pads * actual.pads)) / 12.0;
  for (Track& track : tracks_) {
    track.motor = world_->add_drive(body_);
    for (int i = 0; i < actual.pads; ++i) {
      const double x_m = length_m * ((i + 0.5) / actual.pads - 0.5);
      const double tilt = mean_square_m2 > 0.0 ? actual.centre_of_mass_x_m * x_m / mean_square_m2 : 0.0;
      Pad pad;
      pad.place = {x_m - actual.centre_of_mass_x_m, (track.side == Side::left ? 0.5 : -0.5) * sprockets.wheelbase_m};
      pad.load_n = carried.mass_kg * kGravity_mps2 / (2.0 * actual.pads) * (1.0 + tilt);
      pad.tread = world_->add_tread(body_, pad.place);
      track.pads.push_back(pad);
    }
  }
}

void PairOfTracks::turn_motors(WheelPair set) {
  tracks_[0].speed_radps = tracks_[0].drive.advance(set.left, tracks_[0].state.traction_n, step_s_);
  tracks_[1].speed_radps = tracks_[1].drive.advance(set.right, tracks_[1].state.traction_n, step_s_);
}

void PairOfTracks::turn_exactly(WheelPair speed) {
  const double speeds[] = {speed.left, speed.right};
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    tracks_[i].drive.turn_at(speeds[i], step_s_);
    tracks_[i].speed_radps = speeds[i];
  }
}

void PairOfTracks::before_step(const Ground& ground, const Floor& floor) {
  const Pose& pose = world_->pose(body_);
  const double heading_rad = pose.heading_rad + 0.5 * step_s_ * world_->yaw_rate_radps(body_);
  const Vec2 centre = pose.position() + (0.5 * step_s_) * world_->velocity_mps(body_);
  for (Track& track : tracks_) {
    track.state.in_slip_zone = false;
    const WheelDrive::Unloaded unloaded = track.drive.unloaded();
    const bool feels = unloaded.inertia_kgm2 > 0.0;  // the motor the floor
    if (feels)
      world_->set_drive(track.motor, unloaded.inertia_kgm2 / (track.radius_m * track.radius_m),
                        track.radius_m * (unloaded.speed_radps - track.speed_radps));
    for (Pad& pad : track.pads) {
      const Contact contact =
          ground.under({track.side, centre + rotated(pad.place, heading_rad), heading_rad, track.radius_m, 0.0, 0});
      pad.rolled_mps = track.radius_m * track.speed_radps * (1.0 - contact.slip);
      world_->set_tread(pad.tread, {pad.rolled_mps, 0.0}, contact.friction * pad.load_n * std::cos(floor.tilt_rad));
      if (feels) world_->set_tread_drive(pad.tread, track.motor, {1.0 - contact.slip, 0.0});
      track.state.in_slip_zone = track.state.in_slip_zone || contact.in_slip_zone;
    }
  }
}

void PairOfTracks::after_step() {
  for (Track& track : tracks_) {
    if (track.drive.unloaded().inertia_kgm2 > 0.0) {
      const double change_mps = world_->drive_change_mps(track.motor);
      track.speed_radps += change_mps / track.radius_m;
      track.drive.settle_at(track.speed_radps);
      for (Pad& pad : track.pads) pad.rolled_mps += change_mps;
    }
    double slip_mps = 0.0, traction_n = 0.0;
    for (const Pad& pad : track.pads) {
      slip_mps += pad.rolled_mps - world_->velocity_of_point_mps(body_, pad.place).x_m;
      traction_n += world_->tread_force_n(pad.tread).x_m;
    }
    track.state.rotation_rad = track.state.counted_rad = track.drive.rotation_rad();
    track.state.speed_radps = track.drive.speed_radps();
    track.state.slip_speed_mps = slip_mps / static_cast<double>(track.pads.size());
    track.state.traction_n = traction_n;
  }
}

}  // namespace odolab
