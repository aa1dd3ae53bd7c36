// All recordings of a linked or castor vehicle under one model: every unit's wheels, the joints, the truth's mounting
// and clocks; and the tests of what is not in it. README.md in the folder above, "Together".
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/model/sample_evidence.h"
#include "core/diagnosis/model/score_by_batches.h"
#include "core/diagnosis/units/together/joined_filter.h"

namespace odolab {

// The efficient score of columns that are not in the model: as CandidateTest (core/diagnosis/model/joint_model.h).
struct JoinedTest {
  double statistic = 0.0, inflation = 1.0, survives = 0.0, cross_validated = 0.0;
  int freedom = 0;
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;
  double judged() const { return statistic / inflation; }
  // Not by what happens in a few places only, and predicts what it was not fitted on.
  bool lasts_throughout() const;
};

// Columns of all recordings, side by side: rows of all recordings below each other.
using JoinedColumns = Eigen::MatrixXd;

class JoinedModel {
 public:
  JoinedModel(std::vector<JoinedRun> runs, const Vehicle& vehicle, std::vector<double> clock_s,
              std::vector<std::string> names);

  // Lengths, wheels, clocks and noise, until they agree.
  void fit_all();
  void fit(int iterations);
  void fit_noise();
  // Whether samples of the truth that contradict all before, one after the other, are believed, as where a vehicle was
  // pushed; and no more.
  bool believes_what_contradicts() const;
  void doubt_what_contradicts();

  std::size_t units() const { return drives_of_file_.size(); }
  const std::vector<JoinedFilter>& runs() const { return filters_; }
  const std::vector<JoinedRun>& given() const { return given_; }
  const std::vector<std::string>& names() const { return names_; }
  const Vehicle& vehicle() const { return vehicle_; }
  bool has_truth() const { return has_truth_; }
  bool follows_truth() const { return follows_truth_; }            // not by poses at the ends of a run alone
  bool has_headings() const { return has_headings_; }              // of the truth
  double clock_s(std::size_t run) const { return clock_s_[run]; }  // the truth's offset, on top of the vehicle's
  double stderr_of_clock_s(std::size_t run) const;                 // 0 where it is not fitted, by ends alone
  const JoinedNoise& noise() const { return noise_; }
  const std::vector<DriveView>& views(std::size_t unit) const { return views_[unit]; }  // of each recording
  // What a length comes to, and how well it is known: the vehicle file's key. Unset where there is none of that name.
  struct Known {
    double value = 0.0, stderr_value = 0.0;  // of what it is more than in the file
  };
  std::optional<Known> length(const std::string& name) const;
  // Of these lengths with each other; none with what is not in the model.
  Eigen::MatrixXd covariance_of(const std::vector<std::string>& lengths) const;
  // Of where a castor's axle lies beside its pivot's line.
  double stderr_of_aside_m(std::size_t castor) const;
  // Of the share by which all wheels together may be larger than they are taken to be.
  double stderr_of_scale() const;
  double expected_stderr_of_scale() const;  // the same, of a model that is not fitted yet and leaves more than noise

  // Of motions that each amplitude makes on a unit.
  using MotionsOf = std::function<std::vector<Motions>(const DriveView&)>;
  JoinedColumns columns_of(const MotionsOf& motions, std::size_t amplitudes,
                           const std::vector<std::size_t>& units) const;
  // Of several, side by side: the filters are gone through once for all of them.
  JoinedColumns columns_of_each(const std::vector<MotionsOf>& each, std::size_t amplitudes,
                                const std::vector<std::size_t>& units) const;

  struct Acting {
    MotionsOf motions;
    Eigen::VectorXd value;
    std::vector<std::size_t> units;
  };
  // The noise that is left where all of these act, everything else as it was; they are not in the model afterwards.
  void fit_noise_beside(const std::vector<Acting>& acting);
  // All else fitted where they act, which they do from now on.
  void put_in(const std::vector<Acting>& acting);
  // Lengths, wheels, clocks and noise as fit_all does, and of each of these, of one amplitude, as much as fits best
  // beside them: that, in their order, unset where they act nowhere. They stay in the model.
  std::vector<std::optional<Known>> fit_all_beside(std::vector<Acting> acting);

  JoinedTest test(const JoinedColumns& columns, double batches_believed_white = kFewestBatchesBelieved) const;
  // Of several with so many columns each, side by side; each by itself.
  std::vector<JoinedTest> tests(const JoinedColumns& all, std::size_t amplitudes, double batches_believed_white) const;
  std::vector<JoinedFilter::Impact> impacts(std::size_t run) const;  // of what is left beside all that was let in
  ScoreByBatches score_by_batches(const JoinedColumns& columns) const;
  // Of each recording, what columns that are not in the model say at these values.
  std::vector<std::vector<SampleEvidence>> evidence_of(const JoinedColumns& columns,
                                                       const Eigen::VectorXd& value) const;
  // Puts columns into the model, at what fits best: what is tested from now on is tested beside them.
  void let_in(const JoinedColumns& columns);

 private:
  struct NoiseSize {
    double JoinedNoise::*of;
    double least, most;
  };
  // Minus twice the log-likelihood at the best of them.
  double fit_sizes(const std::vector<NoiseSize>& sizes);
  std::vector<NoiseSize> sizes_of_truth() const;
  double share_of_ends_left() const;  // of what the poses at both ends err by
  void believe_what_contradicts();
  bool let_frame_wander();  // whether it does; the model is to be linearised anew then
  void make_filters();
  std::vector<JoinedColumn> moved_by(std::size_t run, const MotionsOf& motions, std::size_t amplitudes,
                                     const std::vector<std::size_t>& units) const;
  void linearise();
  // What columns at such values leave once all of the model is fitted to it.
  Eigen::VectorXd trace_of(const JoinedColumns& columns, const Eigen::VectorXd& value) const;
  // `cross`: products of the model's own columns with these.
  JoinedTest test_of(const Eigen::Ref<const Eigen::MatrixXd>& columns, const Eigen::MatrixXd& cross,
                     double batches_believed_white) const;
  Eigen::VectorXd mean_of_radii() const;
  // How well a sum of the model's own numbers is known.
  double stderr_of(const Eigen::VectorXd& sum) const;
  // Of the score along a direction of what is left.
  ScoreByBatches score_along(const Eigen::VectorXd& direction) const;
  void solve();  // for what has been put into z_
  void hold_the_body(Eigen::MatrixXd& prior) const;
  void let_joints_say_nothing_of_scale();
  double minus_two_log_likelihood(const JoinedNoise& noise,
                                  JoinedFilter::Wanted wanted = JoinedFilter::Wanted::likelihood);

  std::vector<JoinedRun> given_;
  Vehicle vehicle_;
  std::vector<double> clock_s_;
  std::vector<std::string> names_;
  struct Length {
    std::string name;
    double prior = 0.0;
    std::function<void(Vehicle&, double)> add;
    double grows_m = 0.0;  // where all lengths grow by one
    double moved = 0.0;    // from the file
  };
  std::vector<Length> lengths_;
  std::vector<DifferentialDrive> drives_of_file_;
  bool has_truth_ = false, follows_truth_ = true, has_headings_ = false;
  std::vector<Acting> acting_;
  JoinedNoise noise_;
  std::vector<JoinedFilter> filters_;
  std::vector<std::vector<DriveView>> views_;  // [unit][recording]
  Eigen::MatrixXd z_;                          // the model's own columns
  Eigen::MatrixXd prior_;                      // of these: an information
  Eigen::VectorXd toward_file_;                // its score, from here
  Eigen::VectorXd residual_;                   // with all that was let in at its best
  Eigen::LLT<Eigen::MatrixXd> gram_;
  Eigen::VectorXd at_best_;  // of the model's own, where the residual would be least
  std::vector<Eigen::Index> batch_ends_;
};

}  // namespace odolab
