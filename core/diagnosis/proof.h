// How well runs are predicted before and after: by what was only calibrated, with the findings, with a flexible spline,
// and with a term of equal freedom that means nothing.
#pragma once

#include <compare>
#include <memory>
#include <optional>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/model/joint_model.h"
#include "core/diagnosis/quality/quality.h"

namespace odolab {

// What a model comes to, on the recordings that it was fitted to and on those that it was not.
struct Predicted {
  struct Side {
    FitFigures figures;
    JointModel::GatheredError error;
    JointModel::GatheredError of_path;                // where that has none, for want of headings (path_error)
    std::vector<JointModel::GatheredError> of_model;  // what that is made of: one, or one for each run left out in turn
    std::vector<double> minus_two_log_likelihood;     // of each of these
    std::vector<int> scalars;                         // that this is of
    const JointModel::GatheredError& shown() const { return of_path.windows > 0 ? of_path : error; }
  };
  Side fitted;
  std::optional<Side> unseen;  // unset where there is none
  // Where each run was left out in turn: whether all that acts in that run is known from the others. Else what it comes
  // to says nothing of what is known.
  std::vector<char> is_foretold;
  bool tells(std::size_t model, const Predicted& other) const;  // so of one of the models of what was not fitted
};

// Predicts what was not fitted: the recordings held out, by a model that is frozen but for their clocks; where there
// are none, each recording in turn by a fit to the others.
class Predictor {
 public:
  // `clocks`: of what was held out, where these run apart.
  Predictor(const std::vector<CheckedRecording>& ready_held_out, const LeastSquaresCalibration& calibration,
            const Vehicle& nominal, const std::vector<AlignedClock>& clocks = {});
  enum class Fit { to_recordings, none };  // none: a model as it was given, for which all recordings are new
  // With that noise in the place of the model's own, so that models can be compared.
  Predicted of(const JointModel& model, const FittedNoise& noise, Fit fit = Fit::to_recordings) const;
  bool leaves_out_in_turn() const { return runs_.empty(); }
  const std::vector<InnovationRun>& held_out() const { return runs_; }
  // The same model fitted to what was held out as well, to ask whether it suffices. Unset where nothing was held out,
  // or where an effect there is not known: a load that may be gone, the phase of a wheel.
  std::optional<JointModel> fitted_to_all(const JointModel& model) const;
  const Vehicle& nominal() const { return nominal_; }

 private:
  std::vector<InnovationRun> runs_;
  std::vector<char> commands_;
  LeastSquaresCalibration calibration_;
  Vehicle nominal_;
};

// What is held against each other, all under one noise: the model that is said, with its findings, and the calibration.
struct Compared {
  const FittedNoise& noise;
  const JointModel &said, &calibrated;
  const Predicted &by_said, &by_calibrated;
};

// Fills in `train`, `held_out` and the vehicle as fitted. `spline`: let in beside calibration, whatever its evidence.
void prove(Diagnosis& d, const Predictor& predictor, const Compared& compared,
           const std::shared_ptr<const Effect>& spline, const std::vector<Recording>& train);

// How much what was not fitted speaks against one model beside another. The worse of two, in this order.
struct Denied {
  double by_likelihood = 0.0;  // twice that by which it is less likely, where that is more than a form's error makes
  double by_dead_reckoning = 0.0;  // the share by which its squared error grows beyond chance
  auto operator<=>(const Denied&) const = default;
};

// Nothing where innovations are white and make the one likelier: windows of a metre hold few of the moments at which a
// clock or a short event shows, and all of the wheels' noise.
Denied denied_where_unseen(const Predicted& one, const Predicted& other, bool is_white);

// By how much twice the log-likelihood of what was not fitted is larger by one model than by another.
double likelier_where_unseen(const Predicted& one, const Predicted& other);

// Of the accepted effects the one by which what was not fitted is predicted worse than chance could make it, if any;
// the worst of them.
std::optional<std::size_t> refuted(const Predictor& predictor, const JointModel& joint, const Predicted& by_joint,
                                   const Predicted& by_calibrated);

}  // namespace odolab
