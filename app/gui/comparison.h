// A recording beside its replay in the simulation, by the nominal and by the calibrated vehicle.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/jobs.h"
#include "core/calibration/least_squares.h"
#include "physics/replay.h"
#include "ui/compare.h"

namespace odolab {

// One replay and its errors at the times of the truth, counted from the first of them.
struct ComparedReplay {
  Vehicle vehicle;
  std::string estimator;  // whose track is the dead reckoned one
  Replay replay;
  // How the simulated vehicle stands, its reference being the point that the truth measures.
  VehiclePosture posture_at(double time_s) const;  // of the truth's clock
  std::vector<double> time_s;
  std::vector<double> simulated_m, simulated_rad;
  std::vector<double> dead_reckoned_m, dead_reckoned_rad;
};

class Comparison {
 public:
  using OnError = std::function<void(const std::string&)>;

  // Replays in a job, as it is made sound for the command line's calibration; what goes wrong is reported in words.
  // `scenario` replays it; its vehicle is the nominal one.
  void open(std::shared_ptr<const Recording> recording, const Scenario& scenario, Jobs& jobs, OnError on_error);
  void calibrate(Jobs& jobs, OnError on_error);
  void choose(ui::ReplayVehicle vehicle) { chosen_ = vehicle; }

  bool loaded() const { return recording_ != nullptr; }
  const Recording& recording() const { return *recording_; }
  const std::shared_ptr<const Recording>& as_given() const { return as_given_; }
  const std::vector<std::string>& faults() const { return faults_; }  // of what was given, each in one line
  const Vehicle& vehicle() const { return scenario_.vehicle; }
  const Scenario& scenario() const { return scenario_; }  // that replays it
  const ComparedReplay* nominal() const { return nominal_ ? &*nominal_ : nullptr; }
  const ComparedReplay* calibrated() const { return calibrated_ ? &*calibrated_ : nullptr; }
  const LeastSquaresCalibration* calibration() const { return calibration_ ? &*calibration_ : nullptr; }
  ui::ReplayVehicle chosen() const { return chosen_; }
  // The chosen replay; null until it is done.
  const ComparedReplay* shown() const {
    return chosen_ == ui::ReplayVehicle::calibrated && calibrated_ ? calibrated() : nominal();
  }
  bool has_wheels() const;         // all encoders of the vehicle
  bool can_be_calibrated() const;  // by least squares from this recording

  // Playback, in seconds since the truth's first sample.
  double time_s = 0.0;
  double start_s() const;
  double duration_s() const;

 private:
  std::shared_ptr<const Recording> as_given_, recording_;
  LeastSquaresOptions how_;  // to calibrate from it
  std::vector<std::string> faults_;
  Scenario scenario_;
  std::optional<ComparedReplay> nominal_, calibrated_;
  std::optional<LeastSquaresCalibration> calibration_;
  ui::ReplayVehicle chosen_ = ui::ReplayVehicle::nominal;
};

}  // namespace odolab
