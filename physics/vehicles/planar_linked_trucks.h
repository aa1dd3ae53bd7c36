// CLAPPER and OmniMate on the floor: two differential-drive trucks on a compliant link.
#pragma once

#include <optional>

#include "core/vehicle/linked_trucks.h"
#include "physics/driver/linked_trucks_control.h"
#include "physics/vehicles/linked_belief.h"
#include "physics/vehicles/planar_vehicle.h"
#include "physics/vehicles/truck.h"

namespace odolab {

// The CLAPPER's link is a massless damped spring between the trucks' centres, about which both turn freely. The
// OmniMate's is a platform pinned to truck A's centre, along which truck B's centre slides against the spring. Commands
// are for the link's centre, in the link's frame.
class PlanarLinkedTrucks final : public PlanarVehicle {
 public:
  PlanarLinkedTrucks(const VehicleSetup& setup, const LinkedTrucks& nominal, const LinkedTrucks& lengths,
                     bool with_platform);

  void drive(const Ground& ground, const Floor& floor, const CommandRamp& command) override;
  std::vector<std::string> turned_channels() const override;
  void turn(const Ground& ground, const Floor& floor, const std::vector<double>& speeds_radps) override;
  void begin_in_motion(const std::vector<double>& speeds_radps) override;
  void push(Vec2 impulse_ns) override;
  void set_clock(double begin_s) override { a_.axle().set_clock(begin_s), b_.axle().set_clock(begin_s); }
  Pose pose() const override { return a_.pose(); }
  double speed_mps() const override { return world_.velocity_of_point_mps(a_.body(), {}).x_m; }
  double yaw_rate_radps() const override { return world_.yaw_rate_radps(a_.body()); }
  WheelState left() const override { return a_.axle().left(); }
  WheelState right() const override { return a_.axle().right(); }
  void place_other_bodies(std::vector<Pose>& poses) const override;  // truck B, and the platform if there is one

  VehicleShape shape() const override;
  void pose_parts(VehiclePosture& posture) const override;

  std::vector<std::string> channels() const override;
  void sample(double time_s, std::vector<double>& readings) override;
  Pose believed() const override { return belief_.truck_a(); }
  Pose believed_driven_point() const override { return belief_.link_centre(nominal_.link_length_m); }

 private:
  void step(const Ground& ground, const Floor& floor);
  LinkReadings true_link() const;
  LinkReadings read_link() const;

  LinkedTrucks nominal_, lengths_;
  ActualLink link_;
  double step_s_;
  planar::Effects effects_a_, effects_b_;
  PlanarWorld world_;
  Random phases_;
  Truck a_, b_;
  std::optional<int> platform_;
  LinkedTrucksControl control_;
  LinkReadings readings_;  // last
  bool sampled_ = false;   // since the last command
  WheelPair set_a_before_, set_a_next_, set_b_before_, set_b_next_;
  LinkedBelief belief_;
};

}  // namespace odolab
