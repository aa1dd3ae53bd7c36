// One run of a scenario in the planar world, step by step: the true motion, the encoders, and the robot's own belief.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/geometry/track.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "physics/sampled_run.h"
#include "physics/vehicles/vehicle_shape.h"

namespace odolab {

namespace planar {
class Effect;
}

struct SimulationState {
  double time_s = 0.0;  // since the start; in a replay on the recording's clock
  Pose true_pose;       // of the point that the truth measures: the axle's centre, truck A's, the platform's
  Pose estimated_pose;  // of the same point by the robot's dead reckoning, in the floor's frame from the same start
  double true_speed_mps = 0.0;
  double true_yaw_rate_radps = 0.0;
  WheelState left, right;          // drive wheels of the first body
  std::vector<Pose> other_bodies;  // true poses of the bodies that are coupled to the first one, in a fixed order
  bool finished = false;
};

// The same scenario, seed and steps give the same bits, whoever calls step() and however often.
class Simulation {
 public:
  // The scenario has no problems (problems_in). `replayed` is the recording of a ReplayPath and may be null otherwise.
  // `own` are effects that no scenario can name, fresh for this run; they act after the scenario's.
  Simulation(const Scenario& scenario, std::uint64_t seed, std::shared_ptr<const Recording> replayed = nullptr,
             const std::vector<std::shared_ptr<planar::Effect>>& own = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  // Advances by step_s; does nothing once finished.
  void step();

  const SimulationState& state() const;
  double expected_duration_s() const;  // a guess for progress bars and timelines

  // What the vehicle looks like, and how its parts stand now; gauges are those of the last sample.
  VehicleShape shape() const;
  VehiclePosture posture() const;
  // Where its path begins: the point that the driver steers, of linked trucks the link's centre.
  Pose driven_start() const;
  // How many samples there are, and the last one's readings in the order of the vehicle's channels.
  std::size_t samples() const;
  const std::vector<std::string>& channels() const;
  const std::vector<double>& readings() const;

  // While it runs: the floor may change, a person may drive (only with a HandPath), a push may come from outside.
  void set_floor(const Floor& floor);
  void drive_by_hand(double speed_mps, double yaw_rate_radps, double sideways_mps = 0.0);
  void push(Vec2 impulse_ns);

  // From now on the tracks hold the last sample alone, for whoever keeps them himself. Its recording stays whole.
  void keep_no_tracks();
  // Sampled so far. The tracks hold a pose for each encoder sample.
  const Track& true_track() const;
  const Track& estimated_track() const;
  // Where the truth really sits and how late its stamps are: the vehicle file's, and what effects add to them.
  TruthMounting truth_mounting() const;
  // What the robot and the outside measurement recorded so far, each by its own clock. Of a run whose samples were
  // taken `earlier` holds all that was taken, in order.
  Recording recording(SampledRun earlier = {}) const;
  // Hands over what was sampled since the last time, for whoever keeps a long run elsewhere.
  SampledRun take_samples();
  // The absolute measurements at the start and, once finished, at the end (sonar corner).
  Pose measured_start() const;
  Pose measured_end() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Runs to the end, or to `longest_s`.
void run_to_end(Simulation& simulation, double longest_s = 1e9);

}  // namespace odolab
