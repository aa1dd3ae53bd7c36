// The likelihood of runs with outside truth, in the form of Kalman innovations: README.md in this folder, Eqs. 2 to 9.
//
// In two halves. The wheels between two truth samples are first summed up into one relative motion with its covariance
// and its derivatives; that depends on the parameters and not on the pose. A Kalman filter over the truth samples then
// carries the pose together with its derivatives; that depends on the noise too.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/calibration/wheel_accelerations.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// Sizes of the random errors.
struct FittedNoise {
  double wheel_m_per_sqrt_m = 0.0;  // each wheel's distance error grows with the square root of its travel
  double truth_position_m = 0.0;    // of each coordinate, white
  double truth_heading_rad = 0.0;   // white
  // Of the body as a whole, forward and as the turn of half a wheelbase, independent of each other and of the wheels:
  // what scrubs while one wheel stands still, and what holds both wheels alike, or turns the body on them. They grow
  // with the square root of the wheels' mean travel.
  double along_m_per_sqrt_m = 0.0, turning_m_per_sqrt_m = 0.0;
  // The same sideways, where nothing rolls: another cause, and mostly far smaller.
  double sideways_m_per_sqrt_m = 0.0;
  // Of the truth's frame against the room, each coordinate: it grows with the square root of time, where the vehicle
  // stands as where it drives. Satellites, radio beacons and maps wander; cameras that are bolted to a wall do not.
  double wander_m_per_sqrt_s = 0.0;
  double heading_wander_rad_per_sqrt_s = 0.0;
  // How long the frame stays away: its wander is forgotten with this time constant (Ornstein and Uhlenbeck), as where a
  // laser is matched to a map that is right in the mean. 0: it never comes back.
  double wander_lasts_s = 0.0;
  // Of the moment at which a base acts on a change of its command, from one change to the next; nothing where encoders
  // are read.
  double command_timing_s = 0.0;
};

// The same, none of them so small that no floor, no wheel and no camera could have it: 0.02 mm, 0.02 mrad and 0.02 mm
// after a metre. Recordings made without any noise would else turn what the rounding of their numbers and the path
// between two readings leave into evidence.
FittedNoise as_large_as_any_real(FittedNoise noise);

// The columns of every derivative: seven fixed ones, then the extra ones of the run.
namespace column {
constexpr int wheel_radius_left = 0;
constexpr int wheel_radius_right = 1;
constexpr int wheelbase = 2;
constexpr int mounting_x = 3;
constexpr int mounting_y = 4;
constexpr int mounting_heading = 5;
constexpr int truth_clock = 6;
constexpr int first_extra = 7;
}  // namespace column

// What the wheels did between two samples, for authors of extra columns. The pose is that of dead reckoning.
struct DriveStep {
  double time_s = 0.0;  // at the middle
  double duration_s = 0.0;
  double left_m = 0.0;  // rolled by each wheel
  double right_m = 0.0;
  double turn_rad = 0.0;
  double heading_rad = 0.0;  // at the middle
  Vec2 position;             // at the middle
};

// A small motion of the body in its own frame.
struct BodyMotion {
  double forward_m = 0.0;
  double sideways_m = 0.0;  // to the left
  double turn_rad = 0.0;
};

// An effect on the motion, linear in its own value: `value` times `per_step[i]` is added between wheel samples i and i
// + 1.
struct ExtraColumn {
  std::string name;
  double value = 0.0;
  std::vector<BodyMotion> per_step;
};

// One recording made ready for the filter.
struct InnovationRun {
  std::string name;
  std::vector<WheelSample> wheels;               // two or more, times strictly increasing
  std::vector<WheelSample> smooth;               // the same smoothed, for derivatives; empty: as they are
  std::vector<WheelAcceleration> accelerations;  // for each interval; empty: not reckoned yet
  std::vector<TruthSample> truth;      // two or more, times strictly increasing, about within the time of the wheels
  bool truth_has_heading = false;      // where not, the first heading is unknown and found with the path's shape
  bool speeds_are_held = false;        // between wheel samples, as a command is; else wheels speed up smoothly
  bool counts_show = false;            // the rotations lie on the grid of the encoder's counts
  std::vector<char> set_aside;         // for each truth sample: not to be used
  std::vector<unsigned char> settles;  // for each interval: 1 where the left wheel's count comes to rest or leaves it,
                                       // 2 the right's; empty where counts do not show
  std::vector<ExtraColumn> extra;      // the same number in each run of a set
  std::vector<std::string> warnings;   // what was put right while it was read
  std::vector<std::pair<double, double>> left_out;  // on the wheels' clock, in order: the way across is not known
  std::vector<char> cut;  // for each truth sample: the way to it from the one before is not known; empty: it always is
  // Where several truth samples were averaged into one:
  double samples_averaged = 1.0;       // usually
  double readings_averaged = 1.0;      // so many roundings of the encoders are in one mean
  std::vector<double> truth_variance;  // of each truth sample, in those of a usual one; empty: all are alike
  std::shared_ptr<const InnovationRun> as_recorded;  // what was made less of; null where it is all there
  int frozen = 0;  // truth samples left out since they repeat themselves while the wheels turn
};

// Reads a recording; says what is missing. The vehicle gives the counts and the truth's clock. `left_out`: from one
// reading to another, in order and apart; no motion across these is used, nor across the readings beside them; whoever
// knows them has put stamps of arrival right (evened_recording.h). Without it the gaps between readings, once evened.
Result<InnovationRun> innovation_run(const Recording& recording, const Vehicle& vehicle,
                                     const std::optional<std::vector<std::pair<double, double>>>& left_out = {});

// Whether the way to that truth sample from the one before is unknown.
inline bool is_cut(const InnovationRun& run, std::size_t truth_index) {
  return !run.cut.empty() && run.cut[truth_index] != 0;
}

// The steps of a run as the drive's parameters see them, from a start at the first truth sample.
std::vector<DriveStep> drive_steps(const InnovationRun& run, const DifferentialDrive& drive);

// What the likelihood depends on besides the data.
struct InnovationModel {
  DifferentialDrive drive;
  TruthMounting truth;
  FittedNoise noise;
};

// The motion between two truth samples, in the frame of the first.
struct RelativeMotion {
  Pose motion;
  double wheel_noise[6] = {};  // covariance xx, xy, xh, yy, yh, hh for a wheel noise of 1 m per root metre
  // The same for noises of the body of 1 m per root metre, each by itself; 0 where the model has none.
  double along_noise[6] = {}, turning_noise[6] = {}, sideways_noise[6] = {};
  double timing_noise[6] = {};  // for a second by which changes of a command are acted on sooner or later
  double count_noise[6] = {};   // covariance of the count fractions that a wheel takes into a rest and leaves behind
};
struct SummedRun {
  std::vector<RelativeMotion> motions;  // [i] leads from truth sample i to i + 1
  std::vector<double> derivatives;      // of motions[i] by column c: x, y, heading at 3 * (i * columns + c)
  int columns = 0;
  std::vector<double> end_velocity;  // of motions[i] where it ends, in the frame of its start: x, y, heading at 3 * i
};
SummedRun summed_up(const InnovationRun& run, const InnovationModel& model);

// One truth sample against its prediction.
struct Innovation {
  double time_s = 0.0;
  int truth_index = 0;
  int size = 0;               // 3, or 2 where the truth has no heading
  double residual[3] = {};    // truth minus prediction: x, y, heading
  double covariance[6] = {};  // xx, xy, xh, yy, yh, hh
  double white[3] = {};       // the residual made white by the Cholesky factor: independent, of size 1
  double squared = 0.0;       // residual' covariance^-1 residual
  bool set_aside = false;
};

// What the filter did to arrive at one truth sample: enough to carry further derivatives through it afterwards.
struct FilterStep {
  int truth_index = 0;
  bool starts = false;  // begins anew here, from the sample itself
  bool used = false;    // the sample corrected the pose
  int size = 0;         // 3, or 2 where the truth has no heading
  Vec2 moved;           // predicted motion since the sample before, in the room
  double heading_before_rad = 0.0;
  double heading_rad = 0.0;   // predicted here
  Vec2 arm;                   // from the axle to the tracked point, in the room
  double residual[3] = {};    // truth minus prediction
  double covariance[6] = {};  // of the residual: xx, xy, xh, yy, yh, hh
  double gain[9] = {};        // of the pose by the residual, row by row
  double truth_decay = 0.0;   // where the truth's frame comes back: what is left of its error since the sample before
  double truth_gain[9] = {};  // of that error by the residual
  Pose pose;                  // corrected
};

// The squared size of an innovation from which on a sample is set aside: 1.4e-6 of normal ones of three numbers are
// larger.
constexpr double kGate = 30.0;
constexpr int kContradiction =
    20;  // so many such samples in a row are none that err: the filter starts anew behind them

struct FilterOptions {
  bool derivatives = true;  // also information and score; for these the truth's frame never comes back
  double gate = 0.0;        // above 0: set samples aside by this squared size, and forget the run's own `set_aside`
  int contradiction = kContradiction;
  int first = 0, last = -1;  // truth samples to use; -1: to the end
  int batch = 0;             // above 0: scores are also summed over batches of so many truth samples
  std::function<void(const Innovation&)> on_innovation;
  std::function<void(const FilterStep&)> on_step;
};

// Sums over innovations. With p columns: `information` is sum J' S^-1 J (p by p, row by row), `score` sum J' S^-1 nu,
// where J is the derivative of the prediction.
struct InnovationSums {
  double chi2 = 0.0;
  double log_determinant = 0.0;
  int scalars = 0;
  std::vector<double> information;
  std::vector<double> score;
  std::vector<std::vector<double>> batch_scores;
  std::vector<char> set_aside;  // as used: given or gated
  int restarts = 0;             // where so many samples in a row contradicted that the filter started anew
};
InnovationSums filtered(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model,
                        const FilterOptions& options = {});

// First and last sample of where so many contradict the model in a row.
std::vector<std::pair<int, int>> contradictions(const InnovationRun& run, const SummedRun& summed,
                                                const InnovationModel& model);

// One encoder count as it shows in the run, in radians of the wheel; 0 where the rotations are not on a grid.
inline double count_rad(const InnovationRun& run, const DifferentialDrive& drive) {
  return run.counts_show ? 2.0 * kPi / drive.counts_per_wheel_turn() : 0.0;
}

}  // namespace odolab
