#include "core/guide/outcome.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"
#include "core/guide/misfit.h"
#include "core/guide/rest.h"
#include "core/odometry/prediction.h"
#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

double relative(double stderr_value, double value) { return value == 0.0 ? 0.0 : stderr_value / value; }

// Diameters and wheelbase with what the squares and the tape leave uncertain.
std::vector<Setting> drive_settings(const DifferentialDrive& before, const DifferentialDrive& after,
                                    const std::optional<UmbmarkCalibration>& squares,
                                    const std::optional<ScaleCalibration>& scale) {
  const double scale_error = scale ? relative(scale->scaling_error_stderr, scale->scaling_error) : 0.0;
  const double ed_error = squares ? relative(squares->wheel_diameter_ratio_stderr, squares->wheel_diameter_ratio) : 0.0;
  // The mean radius stays, so a change of Ed moves the two radii against each other (Eqs. 6.33, 6.34). A scale common
  // to both moves radii and wheelbase alike.
  const double ratio = after.wheel_radius_right_m / after.wheel_radius_left_m;
  const double of_left = std::hypot(ed_error * ratio / (1.0 + ratio), scale_error);
  const double of_right = std::hypot(ed_error / (1.0 + ratio), scale_error);
  const double of_wheelbase =
      squares ? std::hypot(relative(squares->wheelbase_ratio_stderr, squares->wheelbase_ratio), scale_error) : 0.0;
  std::vector<Setting> settings(3);
  const auto diameter = [](const char* words, const char* key, const char* ros2, double before_m, double after_m,
                           double error) {
    return Setting{words, key, ros2, "m", 2.0 * before_m, 2.0 * after_m, 2.0 * error * after_m, true, true};
  };
  settings[0] = diameter("diameter of the left wheel", "wheel_radius_left_m", "left_wheel_radius_multiplier",
                         before.wheel_radius_left_m, after.wheel_radius_left_m, of_left);
  settings[1] = diameter("diameter of the right wheel", "wheel_radius_right_m", "right_wheel_radius_multiplier",
                         before.wheel_radius_right_m, after.wheel_radius_right_m, of_right);
  settings[2] = {"wheelbase",        "wheelbase_m",     "wheel_separation_multiplier",   "m",
                 before.wheelbase_m, after.wheelbase_m, of_wheelbase * after.wheelbase_m};
  settings[2].determined = squares.has_value();
  return settings;
}

void tell_type_errors(GuideOutcome& out, const UmbmarkCalibration& c, double side_m) {
  out.sentences.push_back(formatted(
      "In each corner the robot turns %.2f degrees too %s: its wheelbase is %.2f %% %s than believed (type A).",
      degrees(std::abs(c.exact.alpha_rad)), c.exact.alpha_rad > 0.0 ? "little" : "far",
      100.0 * std::abs(c.wheelbase_ratio - 1.0), c.wheelbase_ratio > 1.0 ? "wider" : "narrower"));
  out.sentences.push_back(formatted(
      "On each side of %g m it curves %.2f degrees to the %s: its %s wheel is %.3f %% larger than the other (type B).",
      side_m, degrees(std::abs(c.exact.beta_rad)), c.exact.beta_rad > 0.0 ? "left" : "right",
      c.wheel_diameter_ratio > 1.0 ? "right" : "left", 100.0 * std::abs(c.wheel_diameter_ratio - 1.0)));
  if (c.wheelbase_ratio_stderr == 0.0)
    out.warnings.push_back("One run each way leaves no spread: how uncertain these numbers are, nobody can tell.");
}

void warn_of_runs(GuideOutcome& out, const GuideRound& round, const std::string& when) {
  const std::vector<bool> marked = misfits(round);
  int number[2] = {0, 0};
  for (std::size_t i = 0; i < round.runs.size(); ++i) {
    const GuideRun& run = round.runs[i];
    const std::string name = std::string(run.clockwise ? "cw " : "ccw ") + std::to_string(++number[run.clockwise]);
    if (run.left_out)
      out.warnings.push_back(when + name + " was left out.");
    else if (marked[i])
      out.warnings.push_back(when + name + " does not fit the others of its direction; it counts all the same.");
  }
  if (round.lost > 0)
    out.warnings.push_back(when + std::to_string(round.lost) + (round.lost == 1 ? " run" : " runs") +
                           " never came home and has no return error.");
}

void tell_accuracy(GuideOutcome& out) {
  const UmbmarkMeasure& first = *out.rounds.front().measure;
  const UmbmarkMeasure& last = *out.rounds.back().measure;
  if (out.rounds.size() < 2) {
    out.sentences.push_back(formatted(
        "As it is, the worse direction's squares end %.0f mm from their start, single runs scatter by %.0f mm.",
        1e3 * first.largest_systematic_error_m, 1e3 * first.spread_m));
    return;
  }
  const double before = first.largest_systematic_error_m, after = last.largest_systematic_error_m;
  if (after < before)
    out.verdict.push_back(formatted("The systematic error went from %.1f to %.1f mm: %.0f times smaller.", 1e3 * before,
                                    1e3 * after, before / after));
  else
    out.warnings.push_back(
        formatted("The systematic error went from %.1f to %.1f mm: the calibration did not help. Were "
                  "the new settings put into the robot, and were both directions entered as driven?",
                  1e3 * before, 1e3 * after));
  const RestOfCalibration rest = rest_of(last, out.rounds.back().runs);
  out.compensate_again = rest.worth_another;
  out.verdict.push_back(rest.sentence);
  out.sentences.insert(out.sentences.end(), out.verdict.begin(), out.verdict.end());
}

void squares_outcome(GuideOutcome& out, const GuideSession& session) {
  const DifferentialDrive* given = std::get_if<DifferentialDrive>(&session.vehicle.kind);
  if (!given) return;
  if (session.tape) out.scale = calibrate_scale(*session.tape, *given);
  for (std::size_t k = 0; k < session.rounds.size(); ++k) {
    out.rounds.push_back(outcome_of(session.rounds[k], session.side_m));
    warn_of_runs(out, session.rounds[k], k == 0 ? "" : "After calibration: ");
  }
  while (!out.rounds.empty() && !out.rounds.back().calibration) out.rounds.pop_back();  // begun, but without both ways
  if (session.kind == GuideKind::extended_umbmark) {
    warn_of_runs(out, session.bumped, "With bumps: ");
    if (session.rounds.empty()) return;
    out.extended = measure_extended_umbmark(umbmark_runs(session.rounds.front(), session.side_m),
                                            umbmark_runs(session.bumped, session.side_m));
    if (!out.extended) return;
    out.sentences.push_back(formatted("Ten bumps turn the robot by %.2f degrees on average (Eq. 3.5).",
                                      degrees(out.extended->mean_absolute_heading_error_rad)));
    out.sentences.push_back(
        formatted("Taken off before: %.2f degrees clockwise and %.2f degrees counter-clockwise, the "
                  "robot's own bias on the smooth floor (Eq. 3.6).",
                  degrees(out.extended->systematic_bias_clockwise_rad),
                  degrees(out.extended->systematic_bias_counter_clockwise_rad)));
    return;
  }
  const double rolls_more = out.scale ? 1.0 / out.scale->scaling_error - 1.0 : 0.0;
  if (out.scale && std::abs(rolls_more) < 0.5e-4)  // 0.00 %
    out.sentences.push_back("The robot has gone as far as it believes: both wheels roll as believed.");
  else if (out.scale)
    out.sentences.push_back(formatted(
        "The robot believes to have gone %.3f times as far as it has: both wheels roll %.2f %% %s than believed.",
        out.scale->scaling_error, 100.0 * std::abs(rolls_more), rolls_more < 0.0 ? "less" : "more"));
  else
    out.warnings.push_back("No tape was read: a scale that both wheels share is not in these numbers.");
  if (out.rounds.empty()) return;
  if (!out.rounds.front().calibration) {
    out.warnings.push_back(
        "The first round has no run in one of both directions any more: what was found by it cannot be told again. "
        "Count its runs again, or begin anew.");
    return;
  }
  tell_type_errors(out, *out.rounds.front().calibration, session.side_m);
  tell_accuracy(out);
  // Driven rounds carry the corrections; before there is one, the first round's own calibration.
  const bool applied = session.rounds.size() > 1;
  const std::size_t found_in = std::min(applied ? session.rounds.size() - 2 : 0, out.rounds.size() - 1);
  const DifferentialDrive after = applied ? session.rounds.back().nominal : out.rounds.front().calibration->corrected;
  out.settings = drive_settings(session.rounds[found_in].nominal, after, out.rounds[found_in].calibration, out.scale);
  out.calibrated = session.vehicle;
  out.calibrated->kind = after;
}

void internal_outcome(GuideOutcome& out, const InternalCalibration& internal) {
  int determined = 0;
  for (const ParameterEstimate& p : internal.parameters) {
    determined += p.determined;
    out.settings.push_back(
        {parameter_words(p.name), p.name, "", p.unit, p.nominal, p.value, p.stderr_value, p.determined});
  }
  out.sentences.push_back(
      formatted("%d of %d numbers were found from the encoders alone; no outside truth was looked at.", determined,
                static_cast<int>(internal.parameters.size())));
  for (const std::string& sentence : internal.taken_as_known)
    out.sentences.push_back("Taken as known: " + sentence + ".");
  for (const std::string& sentence : internal.cannot_tell) out.warnings.push_back("Not to be told: " + sentence + ".");
  for (const std::string& sentence : internal.warnings) out.warnings.push_back(sentence);
  if (determined > 0) out.calibrated = internal.vehicle;
}

}  // namespace

RoundOutcome outcome_of(const GuideRound& round, double side_m) {
  RoundOutcome out;
  out.runs = umbmark_runs(round, side_m);
  out.measure = measure_umbmark(out.runs);
  out.calibration = calibrate_umbmark(out.runs, round.nominal);
  out.only_clockwise = calibrate_one_direction(out.runs, true, round.nominal);
  out.only_counter_clockwise = calibrate_one_direction(out.runs, false, round.nominal);
  return out;
}

Result<HeldOutError> held_out_error(const Recording& recording, const Vehicle& before, const Vehicle& after) {
  const std::vector<TruthSample> truth = truth_samples(recording);
  if (truth.size() < 2 || !truth.front().heading_rad)
    return Error{recording.name, "no true pose at the start and the end", "a measured pose at both ends"};
  HeldOutError error;
  error.name = recording.name;
  for (const bool calibrated : {false, true}) {
    const Result<Track> track = predicted_track(recording, calibrated ? after : before);
    if (!track) return track.error();
    if (track->empty()) return Error{recording.name, "no encoders", "those of the vehicle"};
    // Where it is when the truth is read last, which may be on the way; behind its last reading it stands.
    const double at_s = std::clamp(truth.back().time_s, track->front().time_s, track->back().time_s);
    const Pose end = *pose_at(*track, at_s);
    (calibrated ? error.after_m : error.before_m) = length(end.position() - truth.back().position);
    if (truth.back().heading_rad)
      (calibrated ? error.after_rad : error.before_rad) =
          std::abs(wrapped(end.heading_rad - *truth.back().heading_rad));
  }
  return error;
}

GuideOutcome outcome_of(const GuideSession& session, const InternalCalibration* internal,
                        const std::vector<Recording>& held_out) {
  GuideOutcome out;
  if (session.kind == GuideKind::umbmark || session.kind == GuideKind::extended_umbmark)
    squares_outcome(out, session);
  else if (internal)
    internal_outcome(out, *internal);
  if (out.calibrated)
    for (const Recording& recording : held_out)
      if (Result<HeldOutError> error = held_out_error(recording, session.vehicle, *out.calibrated)) {
        out.held_out.push_back(*error);
        if (error->after_m > error->before_m)
          out.warnings.push_back(recording.name +
                                 ": the new numbers end further from the truth than the old ones. Was it "
                                 "driven by the same vehicle, and is its truth right?");
      }
  return out;
}

}  // namespace odolab
