// A differential drive on the floor: one body, two driven wheels, castors that roll freely.
#pragma once

#include <optional>

#include "core/vehicle/differential_drive.h"
#include "physics/sensors/encoder.h"
#include "physics/vehicles/driven_axle.h"
#include "physics/vehicles/planar_vehicle.h"

namespace odolab {

class PlanarDifferentialDrive final : public PlanarVehicle, public DrivenByWheels {
 public:
  PlanarDifferentialDrive(const VehicleSetup& setup, const ActualDrive& actual);

  void drive(const Ground& ground, const Floor& floor, const CommandRamp& command) override;
  void drive_wheels(const Ground& ground, const Floor& floor, WheelPair set_speed_radps) override;
  BaseCommand motion_of(WheelPair speed_radps) const override;
  std::vector<std::string> turned_channels() const override { return channels(); }
  void turn(const Ground& ground, const Floor& floor, const std::vector<double>& speeds_radps) override;
  void begin_in_motion(const std::vector<double>& speeds_radps) override;
  DrivenByWheels* by_wheels() override { return this; }
  void set_clock(double begin_s) override { axle_.set_clock(begin_s); }
  void push(Vec2 impulse_ns) override;

  Pose pose() const override { return world_.pose(body_); }
  double speed_mps() const override;
  double yaw_rate_radps() const override { return world_.yaw_rate_radps(body_); }
  WheelState left() const override { return axle_.left(); }
  WheelState right() const override { return axle_.right(); }

  VehicleShape shape() const override;
  void pose_parts(VehiclePosture& posture) const override;

  std::vector<std::string> channels() const override { return {"left_wheel_rad", "right_wheel_rad"}; }
  void sample(double time_s, std::vector<double>& readings) override;
  Pose believed() const override { return believed_; }

 private:
  void step(const Ground& ground, const Floor& floor);

  DifferentialDrive nominal_;
  ActualDrive actual_;
  double step_s_;
  PlanarWorld world_;
  int body_;
  DrivenAxle axle_;
  const planar::Effects* effects_;
  Encoder left_encoder_, right_encoder_;
  std::optional<WheelPair> read_;  // last
  Pose believed_;
};

}  // namespace odolab
