// Where a vehicle and its model differ, what physics was left out, how much of it, and the proof.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/calibration/least_squares.h"
#include "core/diagnosis/active_effect.h"
#include "core/diagnosis/advice/advised_drive.h"
#include "core/diagnosis/found_parameter.h"
#include "core/geometry/window_size.h"
#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

enum class Verdict {
  found,            // named, and each name stands alone
  nothing_missing,  // calibration leaves nothing but noise
  unknown_effect,   // something is missing that no entry of the catalogue describes
  ambiguous,        // something is missing, and the recordings cannot decide between the names given
  cannot_say,       // the recordings are too poor to judge
};

// Only what applies.
struct WhereFound {
  std::vector<std::pair<double, double>> time_s;
  std::string recording;
  bool and_later_recordings = false;
  std::vector<std::string> other_recordings;  // that came to the place too
  struct Zone {
    double x_m = 0.0, y_m = 0.0, radius_m = 0.0;
  };
  std::optional<Zone> zone;
  std::string regime;  // in words: "in turns, grows with speed"
};

struct Alternative {
  std::string effect, component;
  double log_likelihood_gain = 0.0;
  std::string told_apart_by;  // the drive that would decide
};

// How far a finding moves dead reckoning, gathered over a metre of way or a radian: what calibration alone would leave
// of it. Root mean square over the stretches in which it acts, those that it moves by a tenth of the most and more.
struct MovedTrack {
  double position_rms_m = 0.0, heading_rms_rad = 0.0;
};

// How the evidence of a finding gathers along the recordings, laid end to end; and how it would if this is what was
// missing, and all of it.
struct GatheredEvidence {
  std::vector<std::pair<std::string, double>> begins;  // each recording, and where it begins on the axis below
  std::vector<double> driven_s;                        // since the first began
  std::vector<double> gain;                            // of log-likelihood until then
  std::vector<double> foreseen, low, high;             // in the mean, and in 95 % of such drives at each time
};

struct Finding {
  std::string effect, component;  // effect is "unknown" where no name fits
  std::vector<FoundParameter> parameters;
  WhereFound where;
  double log_likelihood_gain = 0.0;
  double p_value = 1.0;  // family-wise over all candidates and scans
  std::vector<Alternative> alternatives;
  double share_of_mismatch = 0.0;  // of the chi-square above noise that calibration leaves
  // Unset where it is none of the vehicle's motion; of what has no name, by the curves that were fitted to it.
  std::optional<MovedTrack> moves;
  GatheredEvidence gathered;  // empty where it is none of the motion
  std::string sentence;       // the finding in plain words
  bool is_parted = false;     // of what has no name: its times were left out of all else (parted.h)
  int form = 0;               // which of the ways in which the effect shows, and in words where there are several
  std::string form_in_words;

  ActiveEffect as_active() const;
};

struct FitFigures {
  double position_rms_m = 0.0;   // gathered over a metre or a radian, from a true start, or to the truth's next pose
  double heading_rms_rad = 0.0;  // NaN: the truth has none, and windows begin with what the model makes of the way
  double normalised_chi2 = 0.0;

  // False: there was nothing to gather them over, as of poses at both ends; both are then exactly zero.
  bool gathered() const { return position_rms_m > 0.0 || heading_rms_rad > 0.0; }
  bool has_heading() const { return !std::isnan(heading_rms_rad); }
};

struct FitTable {
  std::optional<FitFigures> nominal, calibrated, with_findings, noise_floor;
  std::optional<FitFigures> spline,
      placebo;  // calibrated plus a flexible spline; plus a term of equal freedom without meaning
};

struct NotTestable {
  std::string effect, because, drive_this;
};

// An effect of the catalogue that was asked for, of the part where it seems likeliest, named or not.
struct AskedEffect {
  std::string effect, component;
  bool named = false;
  double log_likelihood_gain = 0.0;            // beside the calibration alone, scatter allowed for
  std::optional<double> gain_beside_findings;  // where something was named, and this was not
  double p_value = 1.0;                        // family-wise, beside the calibration alone
  // Of what it does to the tracks, what calibration leaves to be seen; and what would bend it most for an effect of
  // medium size: "wheelbase_m" by so much. Unset where these drives hold nothing that would show it.
  std::optional<double> survives;
  std::optional<FoundParameter> bends;
  // The smallest size that would have been seen nine times in ten. Unset where none would, and of what was named.
  std::optional<FoundParameter> least_seen;
};

// What the mismatch that calibration leaves depends on: its response to a variable of the motion, with its 95 % band.
struct Response {
  std::string variable, channel;  // "yaw rate [rad/s]", "turn per metre [rad/m]"
  std::vector<double> at, value, low, high;
  std::vector<double> after;  // what is left of it with the findings; empty where nothing was found
};

// Innovations of one recording over time, at the truth's stamps, for pictures.
struct Residuals {
  std::string recording;
  std::vector<double> time_s, x_m, y_m, along_m, across_m, heading_rad, squared;  // squared: normalised, 1 per scalar
};

// What of a recording is judged: the truth's samples that count, and where the way of the wheels is not known, by which
// no error is gathered.
struct JudgedPart {
  std::string recording;
  std::vector<double> truth_s;                           // on the truth's clock
  std::vector<std::pair<double, double>> way_unknown_s;  // on the wheels'
};

struct Diagnosis {
  Verdict verdict = Verdict::cannot_say;
  std::vector<std::string> fitted_on, held_out_runs;  // names of recordings
  LeastSquaresCalibration calibration;                // together with the findings: what predicts with them
  LeastSquaresCalibration calibration_alone;          // as if nothing were missing: what the findings are held against
  std::optional<Vehicle> fitted_vehicle;              // of `calibration`, unset where no model could be fitted
  std::vector<std::pair<std::string, double>>
      truth_clock_s;  // the offset of the truth's clock in each recording fitted on
  // Strongest first; data faults among them: truth_frozen, encoder_data_fault, and truth_mounting_offset where
  // `where.recording` names the one run in which the tracked point sat elsewhere.
  std::vector<Finding> findings;
  FitTable train, held_out;
  // Whether something is missing: there are too few innovations on the way, or most effects could not have shown.
  bool cannot_judge = false;
  bool left_out_in_turn = false;  // what `held_out` is: each recording by a fit to the others
  // By how much likelier the findings make the recordings of `held_out`, log-likelihood, than calibration alone does:
  // where each sample of the truth errs by more than a metre of dead reckoning, only this shows them.
  std::optional<double> unseen_gain;
  FitTable simulation;  // nominal: unused; calibrated: before; with_findings: after; filled in by the physics
  std::vector<AskedEffect> asked;  // every effect once, the likeliest first
  std::vector<NotTestable> not_testable;
  std::string next_drive;
  std::vector<DriveLeg> next_legs;  // the same to be driven; empty where words are all there is
  std::vector<std::string> warnings;
  std::vector<Response> responses;                           // strongest first
  std::vector<Residuals> residuals_before, residuals_after;  // calibrated; with findings
  std::vector<JudgedPart> judged;                            // of the recordings fitted on, and of those held out
  // Over which way the figures of `train` and of `held_out` are gathered; of `simulation` that of `train`.
  std::optional<WindowSize> train_over, held_out_over;
};

struct TruthError;  // core/diagnosis/generic/truth_errors.h

struct DiagnosisOptions {
  double family_wise_error = 0.02;
  std::shared_ptr<const std::vector<TruthError>> truth_errors;  // what else the truth may err by; null: nothing
  // What the truth's steps, where it has any, may feign of a vehicle's motion at a place or moment.
  double truth_step_m = 0.0, truth_step_rad = 0.0;
};

// Recordings of one vehicle. `held_out` give no name and no number: they are predicted after everything is frozen, and
// may only take a name away that they contradict. Where none are given, each recording in turn is predicted from a fit
// to the others (the names themselves were found on all of them).
Result<Diagnosis> diagnose(const std::vector<Recording>& recordings, const std::vector<Recording>& held_out,
                           const Vehicle& nominal, const DiagnosisOptions& options = {}, const Progress& progress = {});

// The track that a vehicle with effects predicts, as predicted_track does without (core/odometry/prediction.h).
Result<Track> predicted_track(const Recording& recording, const Vehicle& vehicle,
                              const std::vector<ActiveEffect>& effects);

}  // namespace odolab
