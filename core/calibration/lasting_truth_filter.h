// The Kalman filter where the truth's frame comes back after a time: README.md in this folder, Eqs. 7a and 9a.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "core/calibration/filter_walk.h"
#include "core/calibration/innovations.h"
#include "core/calibration/noise_slopes.h"
#include "core/calibration/pose_covariance.h"
#include "core/geometry/small_turn.h"

namespace odolab {

// The pose of the axle and, beside it, by how much the truth's frame is off in x, y and heading: an Ornstein-Uhlenbeck
// process each, from its own stationary spread on. No derivatives by columns.
class LastingTruthFilter {
 public:
  LastingTruthFilter(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                     const FilterOptions& options);

  InnovationSums run();
  // The same, with what the logarithms of the sizes change.
  NoiseSlopes slopes();

 private:
  template <typename Filter>
  friend void walk(const InnovationRun&, const FilterOptions&, Filter&, InnovationSums&);

  using State = Eigen::Matrix<double, 6, 1>;
  using Covariance = Eigen::Matrix<double, 6, 6>;
  using Gain = Eigen::Matrix<double, 6, 3>;
  // What one size changes of covariance and state.
  struct Slope {
    Covariance covariance = Covariance::Zero();
    State state = State::Zero();
  };

  void begin_at(int truth_index);
  void predict(int truth_index);
  bool update(int truth_index);
  void pass_by(int truth_index) { report_step(truth_index); }
  void report_step(int truth_index);
  void carry_slopes(const Gain& gain, const Eigen::Matrix3d& weight, const Eigen::Vector3d& residual, Vec2 arm,
                    double position2, double heading2, bool has_heading);

  double variance_of(int truth_index) const;
  Vec2 arm() const;
  void turn(double by_rad);
  // H P of any matrix of six rows: of the tracked point and heading as they are read.
  template <typename Of>
  Eigen::Matrix<double, 3, Of::ColsAtCompileTime> read_of(const Of& of, Vec2 arm, bool has_heading) const;

  const InnovationRun& run_;
  const SummedRun& summed_;
  const InnovationModel& model_;
  const FilterOptions& options_;
  Pose pose_;
  Turn facing_;                                    // cosine and sine of its heading
  Eigen::Vector3d off_ = Eigen::Vector3d::Zero();  // of the truth's frame
  Covariance covariance_ = Covariance::Zero();
  PoseCovariance count_error_;
  double off_position2_ = 0.0, off_heading2_ = 0.0;  // of the frame, before anything is read
  InnovationSums sums_;
  FilterStep step_;
  bool with_slopes_ = false;
  std::array<Slope, noise_size::count> slope_of_;
  NoiseSlopes slopes_;
};

}  // namespace odolab
