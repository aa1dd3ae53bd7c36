// A body on one driven axle with its encoders: a truck of a linked vehicle.
#pragma once

#include "core/base/random.h"
#include "core/vehicle/differential_drive.h"
#include "physics/sensors/encoder.h"
#include "physics/vehicles/driven_axle.h"
#include "physics/vehicles/planar_vehicle.h"

namespace odolab {

class Truck {
 public:
  // `nominal` is what its odometry believes and its counts per turn, `actual` the machine. Encoders stand anywhere
  // between two counts at the start. The world and the effects must outlive it.
  Truck(PlanarWorld& world, const Pose& start, const DifferentialDrive& nominal, const ActualDrive& actual,
        const VehicleSetup& setup, const planar::Effects& effects, int number, Random& phases)
      : world_(&world),
        nominal_(nominal),
        mass_kg_(actual.mass_kg),
        body_(world.add_body({start, actual.mass_kg, actual.moment_of_inertia_kgm2})),
        axle_(world, body_, {}, effects.built_into(actual), setup.scenario.motor, setup.scenario.step_s, effects,
              number),
        effects_(&effects),
        left_encoder_(nominal.counts_per_wheel_turn(), phases.uniform()),
        right_encoder_(nominal.counts_per_wheel_turn(), phases.uniform()) {}

  int body() const { return body_; }
  double mass_kg() const { return mass_kg_; }
  const DifferentialDrive& nominal() const { return nominal_; }
  DrivenAxle& axle() { return axle_; }
  const DrivenAxle& axle() const { return axle_; }
  const Pose& pose() const { return world_->pose(body_); }

  WheelPair read(double time_s) const {
    WheelPair now{left_encoder_.reading_rad(axle_.left().counted_rad),
                  right_encoder_.reading_rad(axle_.right().counted_rad)};
    for (const auto& effect : *effects_) {
      effect->read_encoder(Side::left, time_s, now.left);
      effect->read_encoder(Side::right, time_s, now.right);
    }
    return now;
  }

 private:
  PlanarWorld* world_;
  DifferentialDrive nominal_;
  double mass_kg_;
  int body_;
  DrivenAxle axle_;
  const planar::Effects* effects_;
  Encoder left_encoder_, right_encoder_;
};

// The weight of a truck with the true wheels of a drive.
inline ActualDrive with_wheels_of(const DifferentialDrive& lengths, ActualDrive weight) {
  weight.wheel_radius_left_m = lengths.wheel_radius_left_m;
  weight.wheel_radius_right_m = lengths.wheel_radius_right_m;
  weight.wheelbase_m = lengths.wheelbase_m;
  return weight;
}

}  // namespace odolab
