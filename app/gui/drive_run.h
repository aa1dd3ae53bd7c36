// A simulation that is watched: it runs ahead at a wanted speed, and every moment so far can be looked at again. What
// lies long ago is kept in fewer pictures, between which the tracks lead.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/gui/kept_rows.h"
#include "app/gui/kept_samples.h"
#include "app/gui/run_estimates.h"
#include "physics/simulation.h"

namespace odolab {

// Something that a person will want to find again on the timeline.
struct RunEvent {
  enum class Kind { bump, slip_zone, floor_changed, pushed } kind = Kind::bump;
  double time_s = 0.0;
  std::string words;
};

class DriveRun {
 public:
  // The scenario has no problems.
  explicit DriveRun(const Scenario& scenario, std::shared_ptr<const Recording> replayed = nullptr);

  void restart();
  // Moves the shown moment on by this much, simulating what is not there yet as long as `go_on` says so.
  void advance(double seconds, const std::function<bool()>& go_on);
  // One picture of about 20 ms, simulated or from what is there.
  void step_forward();
  void step_back();
  void show(double time_s);
  // Takes effect from the latest moment on.
  void set_floor(const Floor& floor);
  void drive_by_hand(double speed_mps, double yaw_rate_radps, double sideways_mps);
  void push(Vec2 impulse_ns);

  const Scenario& scenario() const { return scenario_; }
  const Simulation& simulation() const { return simulation_; }
  // All that was recorded so far, however long ago.
  Result<Recording> recording() const { return kept_samples_.recording(simulation_); }
  // Times are since the start of the run; in a replay its tracks begin at another time than zero.
  double start_s() const { return history_.front().time_s; }
  double shown_s() const { return shown_s_; }
  double latest_s() const { return times_.back(); }
  double total_s() const;  // planned, and never less than what was
  bool finished() const { return history_.back().finished; }
  bool at_end() const { return finished() && shown_s_ >= latest_s(); }
  // The state at the shown moment; poses and wheel rotations are interpolated between pictures.
  SimulationState shown() const;
  VehiclePosture shown_posture() const;
  const VehicleShape& shape() const { return shape_; }

  // The gap between estimate and truth at every picture that is kept: that of the last sample, since the estimate is
  // older than the picture. The estimated poses shown are the true ones with this gap.
  const std::vector<double>& time_s() const { return times_; }
  const std::vector<double>& gap_m() const { return gap_m_; }
  const std::vector<double>& gap_heading_rad() const { return gap_heading_; }
  const RunEstimates& estimates() const { return estimates_; }
  const std::vector<RunEvent>& events() const { return events_; }

 private:
  void simulate_picture();
  void see_sample();
  void remember();
  void thin();
  void note_events(const VehiclePosture& before, const VehiclePosture& now);
  // The pictures on either side of the shown moment, and how far it is from the first to the second.
  struct Around {
    std::size_t before = 0, after = 0;
    double share = 0.0;
    bool thinned = false;  // they are further apart than pictures are
  };
  Around around_shown() const;

  Scenario scenario_;
  std::shared_ptr<const Recording> replayed_;
  Simulation simulation_;
  RunEstimates estimates_;
  int steps_per_picture_ = 20;
  VehicleShape shape_;
  KeptRows kept_;
  KeptSamples kept_samples_;
  std::vector<SimulationState> history_;  // a state and a posture for each picture
  std::vector<VehiclePosture> postures_;
  std::vector<double> times_, gap_m_, gap_heading_;
  std::vector<RunEvent> events_;
  std::size_t samples_seen_ = 1;
  Pose gap_;  // at the last sample
  double shown_s_ = 0.0;
};

}  // namespace odolab
