// The poses of all units of a vehicle in one filter: each unit's wheels carry it on, its joints hold it to the others,
// and the outside truth, as much as there is of it, to the room. README.md in the folder above, "Together".
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "core/diagnosis/effects/motions.h"
#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

inline constexpr std::size_t kMostJoinedUnits = 8;

// Sizes of the random errors, of all units alike.
struct JoinedNoise {
  double wheel_m_per_sqrt_m = 5e-4;     // each wheel's way
  double sideways_m_per_sqrt_m = 5e-5;  // of each unit's axle, where nothing rolls
  double joint_steps = 0.4;             // what a joint reads, in steps of its encoder
  double apart_m = 1e-4;                // by how much a unit stands elsewhere than rigid joints would have it
  double truth_position_m = 0.01, truth_heading_rad = 0.01;
  // Of the truth's frame against the room, each coordinate, in time; forgotten with a time constant, 0: never.
  double wander_m_per_sqrt_s = 0.0, wander_rad_per_sqrt_s = 0.0, wander_lasts_s = 0.0;
};

// What a change of the model by one does to a recording.
struct JoinedColumn {
  std::vector<Eigen::Matrix3Xd> moved;  // of each unit's axle in each epoch, in the frame of its start; may be empty
  Eigen::MatrixXd read;  // of what is read at each epoch's end, the first column before them all; may be empty
};

// One recording, cut into epochs: it is looked at where encoders or the truth are read.
class JoinedFilter {
 public:
  // `vehicle`, of kMostJoinedUnits at most: its lengths, the joints' biases, the truth's mounting and clock, and the
  // drives.
  JoinedFilter(const JoinedRun& run, const Vehicle& vehicle, double clock_s);

  std::size_t units() const { return way_.size(); }
  std::size_t readings() const { return readings_.size(); }  // one more than epochs
  double time_s(std::size_t reading) const { return readings_[reading].time_s; }
  // Numbers of each reading: where each unit but the first stands against the first, along, across and in heading; then
  // the truth, whose heading is left out where it has none.
  Eigen::Index rows() const { return 3 * static_cast<Eigen::Index>(units()); }

  // The world as it would be with so much of a column's motions in it; adds to what was put in before.
  void put_in(const JoinedColumn& column, double value);

  // Minus twice the log-likelihood, alone or with all that is asked for below, of the filter as it ran so last.
  enum class Wanted { likelihood, columns };
  double run(const JoinedNoise& noise, Wanted wanted = Wanted::columns);
  const Eigen::VectorXd& residual() const { return residual_; }  // whitened, rows() of each reading
  Track track(std::size_t unit) const;                           // as corrected
  // Samples of the truth that contradicted the poses one after the other, until those were taken to be lost.
  const std::vector<std::vector<std::size_t>>& contradicting() const { return contradicting_; }
  // Of each unit, by all that is read before and after (A. E. Bryson and M. Frazier, "Smoothing for linear and
  // nonlinear dynamic systems", Proceedings of the Optimum System Synthesis Conference, 1963, as modified by G. J.
  // Bierman 1973).
  std::vector<Track> smoothed() const;

  // Whitened columns, side by side: what the residual would be if the world did so and the model did not know.
  Eigen::MatrixXd carried(const std::vector<JoinedColumn>& columns) const;

  // What a sudden motion of the units on the way to each reading would say, of what is left of the whitened numbers:
  // the score of each unit's x, y and heading in the room, and their information; the truth's frame comes last.
  struct Impact {
    double time_s = 0.0;  // in the middle of that way
    std::vector<Pose> units;
    Eigen::VectorXd score;
    Eigen::MatrixXd information;
  };
  std::vector<Impact> impacts(const Eigen::VectorXd& left) const;

  JoinedColumn nothing() const;
  // Adds what motions between the samples of a unit's wheels come to.
  void add_motions(const Motions& motions, std::size_t unit, JoinedColumn& column) const;
  JoinedColumn by_wheels(std::size_t unit, int which) const;  // left radius, right radius, wheelbase: as a share
  // By a number that `add` adds something to, and that says where units stand; the drives' own do not count here.
  JoinedColumn by_length(const std::function<void(Vehicle&, double)>& add) const;
  JoinedColumn by_clock() const;  // by the truth's offset, s

 private:
  struct Reading {
    double time_s = 0.0;
    std::vector<double> joints;
    std::optional<Pose> truth;                // of the tracked point
    bool joints_are_read = true;              // else they are only known, from their readings before and after
    std::size_t of_tracked = 0;               // which sample the truth is
    bool is_believed = false;                 // it is none of the outliers
    std::vector<Pose> unit_T_body;            // the tracked point as each unit has it
    std::vector<std::vector<Pose>> by_joint;  // [joint][unit] what that moves by where the joint reads more by one
    std::vector<double> held = {};            // of each joint that is read: so many readings count as one
  };
  // What the filter did to arrive at a reading.
  struct Step {
    bool starts = false;
    std::vector<Pose> predicted, corrected;  // of each unit
    std::vector<Eigen::Matrix2d> room_R_corrected;
    Eigen::MatrixXd uncertain;               // covariance of the states as predicted
    Eigen::Index first_row = 0, count = 0;   // of what was read
    Eigen::MatrixXd whitener, out;           // of what is read; of what the poses are off by, as it is seen
    Eigen::MatrixXd gain, on;                // what the poses take of it; what goes on of what they were off by
  };
  static constexpr int kMostStates = 3 * static_cast<int>(kMostJoinedUnits) + 3;
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostStates, kMostStates>;
  struct State;
  struct Seen;
  // All units, where the joints put them about the body; `in_room`: that is not known to be there.
  void put_units(State& state, const Pose& body, const Reading& reading, bool in_room) const;
  State begun(const JoinedNoise& noise) const;
  void go_on(std::size_t reading, const JoinedNoise& noise, State& state) const;  // on the way to it
  void look(const Reading& reading, const JoinedNoise& noise, const State& state, Seen& seen) const;
  // Whether a sample of the truth is none of its outliers; and whether it is the poses that are wrong.
  bool is_taken(const Reading& reading, const Seen& seen, const Small& p, double& minus_two_log) const;
  bool is_lost(const Reading& reading, State& state) const;
  void put_anew(const Reading& reading, State& state) const;  // where the first unit and the joints say
  void correct(const Reading& reading, const Seen& seen, const Eigen::VectorXd& off, State& state) const;
  // The pose between two samples; the ends hold beyond them.
  static Pose on_the_way(const Track& track, double time_s);
  Small turned_with(const std::vector<Pose>& before, const std::vector<Pose>& after,
                    const std::vector<Pose>& unit_T_body) const;
  std::vector<Pose> units_T_body(const Vehicle& vehicle, const std::vector<double>& joints) const;
  Eigen::VectorXd read_at(const std::vector<Pose>& units, const std::vector<Pose>& unit_T_body,
                          const std::optional<Pose>& truth) const;

  // The part of a step between two samples that lies in an epoch, and what a unit's motion in it comes to at the
  // epoch's end, in the frame of its start: turned by an angle, and what is still to come swung about.
  struct Piece {
    int epoch = 0;
    double share = 0.0, cosine = 1.0, sine = 0.0;
    Vec2 rest;
  };
  void cut_into_pieces();
  // A joint that holds its angle holds its rounding: what is read again and again is one reading, unless the joint soon
  // passes on to the next step.
  void count_what_is_held();

  // The body at the first reading, by the truth.
  Pose started_at() const;
  // What the poses are off by, and behind them the truth's frame where that wanders: along x, y and in heading.
  Eigen::Index states() const { return rows() + (wanders_ ? 3 : 0); }
  double kept_of_frame(std::size_t reading) const;  // since the reading before
  // Adds to a score of the states behind a reading what it says itself, of what is left of the whitened numbers.
  void take_in(std::size_t reading, const Eigen::VectorXd& left, Eigen::VectorXd& score) const;
  // What the states at a reading say of those at the one before, given its score there.
  void carry_back(std::size_t reading, Eigen::VectorXd& score) const;

  Vehicle vehicle_;
  std::vector<UnitSample> samples_;
  Eigen::Index truth_rows_ = 3;
  bool outliers_show_ = true;  // not among the poses of both ends alone
  std::vector<DifferentialDrive> drives_;
  std::vector<double> joint_step_, count_m_;  // of each joint's encoder; of each unit's wheels
  std::vector<Track> way_;                    // of each unit, by its wheels alone
  std::vector<Reading> readings_;
  std::vector<std::vector<Pose>> moved_;                      // [unit][epoch]
  std::vector<std::vector<std::array<double, 2>>> rolled_m_;  // [unit][epoch] by each wheel, to and fro
  std::vector<std::vector<char>> is_guessed_;                 // [unit][epoch] what a wheel turned
  std::vector<std::vector<Piece>> pieces_;                    // of each unit
  std::vector<std::size_t> first_piece_;                      // of each step, alike in all units; one more at the end
  bool wanders_ = false;                                      // as it ran last
  double wander_lasts_s_ = 0.0;
  std::vector<Step> steps_;
  std::vector<std::vector<std::size_t>> contradicting_;
  Eigen::VectorXd residual_;
};

}  // namespace odolab
