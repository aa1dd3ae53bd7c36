// Recordings of real robots, measured by others: import, quality, calibration, diagnosis and the proof on what was held
// out.
#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/diagnosis/quality/quality.h"
#include "core/io/number_text.h"
#include "core/odometry/prediction.h"
#include "physics/experiments/experiment.h"
#include "physics/experiments/real/looked_for.h"
#include "physics/experiments/real/recording_sets.h"
#include "physics/experiments/real/robot_transfer.h"

namespace odolab {

namespace {

constexpr double kOwnRefitted = 1.0 / 3.0;  // of a held-out robot's recording
constexpr double kPlainlyBetter = 3.0;      // standard errors: one in a thousand by chance
constexpr double kUndecided = 2.0;          // and so many are nothing
// Looked for in these sets by hand; what is said of them must agree with what was not fitted.
constexpr const char* kLookedFor[] = {"wheel_eccentricity", "speed_dependent_radius", "floor_slope_creep"};

std::string text_in_mm(double m, int digits = 2) { return number_text(digits == 2 ? "%.2f" : "%.1f", 1e3 * m); }
std::string deg(double rad) { return number_text("%.2f", degrees(rad)); }

std::string text_of(const std::optional<FitFigures>& figures) {
  return figures ? text_in_mm(figures->position_rms_m) + " mm, " + deg(figures->heading_rms_rad) : "";
}
std::string text_of(const TypicalError& error) {
  return text_in_mm(error.position_m) + " mm, " + deg(error.heading_rad);
}

std::string verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::found:
      return "found";
    case Verdict::nothing_missing:
      return "nothing missing";
    case Verdict::unknown_effect:
      return "unknown effect";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::cannot_say:
      break;
  }
  return "cannot say";
}

std::string parameters_text(const Finding& finding) {
  std::string text;
  for (const FoundParameter& p : finding.parameters)
    text += (text.empty() ? "" : ", ") + p.name + " " + number_text("%.4g", p.value) + " +- " +
            number_text("%.1g", p.stderr_value);
  if (!finding.where.recording.empty()) text += " (" + finding.where.recording + ")";
  return text;
}

std::string alternatives_text(const Finding& finding) {
  std::string text;
  for (const Alternative& a : finding.alternatives) text += (text.empty() ? "" : ", ") + with_blanks(a.effect);
  return text;
}

// One recording calibrated by itself.
struct FileCheck {
  std::vector<ParameterEstimate> parameters;  // none where it could not be fitted

  const ParameterEstimate* determined(const std::string& name) const {
    for (const ParameterEstimate& p : parameters)
      if (p.name == name && p.determined) return &p;
    return nullptr;
  }
  std::string text(const std::string& name, double factor, const char* format) const {
    const ParameterEstimate* p = determined(name);
    return p ? number_text(format, factor * p->value) : "-";
  }
};

FileCheck check_of(const Recording& recording, const Vehicle& nominal) {
  const Result<LeastSquaresCalibration> own = calibrate_least_squares({recording}, nominal);
  return own ? FileCheck{own->parameters} : FileCheck{};
}

// What a file has that the others of its set have not: a clock or a tracked point of its own. Far from the median in
// medians of the deviations and in its own standard errors; small ones matter to nobody.
std::string apart_text(const FileCheck& file, const std::vector<FileCheck>& all) {
  const auto apart = [&](const char* name, double least) {
    const ParameterEstimate* own = file.determined(name);
    std::vector<double> values, deviations;
    for (const FileCheck& f : all)
      if (const ParameterEstimate* p = f.determined(name)) values.push_back(p->value);
    if (values.size() < 3 || !own) return false;
    const double middle = median(values);
    for (double v : values) deviations.push_back(v - middle);
    const double away = std::abs(own->value - middle);
    return away > least && away > 5.0 * own->stderr_value && away > 5.0 * scatter_about_zero(deviations);
  };
  std::string text;
  const auto add = [&](bool is, const char* what) {
    if (is) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  add(apart("truth_mounting.time_offset_s", 0.02), "a clock of its own");
  add(apart("truth_mounting.x_m", 0.005) || apart("truth_mounting.y_m", 0.005) ||
          apart("truth_mounting.heading_rad", 0.01),
      "a tracked point of its own");
  add(apart("wheelbase_m", 0.002), "a wheelbase of its own");
  return text;
}

struct Tables {
  ResultTable files{"each file, calibrated by itself (-: it cannot tell); faults of the data are left out of all fits",
                    {"file", "s", "m", "truth", "clock [ms]", "tracked point [mm, mm, degrees]", "wheelbase [mm]",
                     "unlike the others"},
                    {}};
  ResultTable said{"what is missing, on all runs of a set together",
                   {"set", "verdict", "effect", "of", "how much", "gain", "share", "as good"},
                   {}};
  ResultTable proof{"dead reckoning over a metre or a radian, root mean square [mm, degrees]",
                    {"set", "judged on", "as drawn", "calibrated", "with findings", "a placebo", "noise alone"},
                    {}};
  ResultTable looked_for{
      "looked for by name: fitted to the first half of each run beside radii, wheelbase and mounting, judged on the "
      "second halves (error over a metre or a radian, for eccentricity over half a turn of a wheel, without the "
      "largest "
      "tenth)",
      {"set", "effect", "diagnosis", "fitted", "unseen without it [mm, degrees]", "unseen with it",
       "better by [standard errors]"},
      {}};
  ResultTable robots{
      "each robot predicted from a fit to the others, its own re-fitted on its first third, judged on the rest: median "
      "error over a "
      "metre or a radian [mm, degrees]",
      {"robot", "as commanded", "as the others", "its own scales, mounting, clock", "besides, the others' findings",
       "the others' findings"},
      {}};
};

void add_files(const RecordingSet& set, Tables& tables, std::vector<std::string>& notes) {
  std::vector<FileCheck> checks;
  for (const Recording& recording : set.recordings) {
    CheckedRecording checked_one = checked(recording, set.nominal);
    for (const DataFault& fault : checked_one.faults)
      notes.push_back(set.name + ", " + recording.name + ": " + fault.sentence);
    checks.push_back(check_of(checked_one.recording, set.nominal));
  }
  for (std::size_t i = 0; i < set.recordings.size(); ++i) {
    const Recording& r = set.recordings[i];
    const FileCheck& c = checks[i];
    const Track truth = truth_track(r);
    tables.files.rows.push_back(
        {set.name + " " + r.name, number_text("%.0f", r.duration_s()), number_text("%.1f", travelled_m(truth)),
         std::to_string(truth.size()), c.text("truth_mounting.time_offset_s", 1e3, "%.0f"),
         c.text("truth_mounting.x_m", 1e3, "%.1f") + ", " + c.text("truth_mounting.y_m", 1e3, "%.1f") + ", " +
             c.text("truth_mounting.heading_rad", degrees(1.0), "%.2f"),
         c.text("wheelbase_m", 1e3, "%.1f"), apart_text(c, checks)});
  }
}

void add_said(const std::string& set, const Diagnosis& diagnosis, Tables& tables) {
  bool first = true;
  for (const Finding& finding : diagnosis.findings) {
    tables.said.rows.push_back({first ? set : "", first ? verdict_text(diagnosis.verdict) : "",
                                with_blanks(finding.effect), with_blanks(finding.component), parameters_text(finding),
                                number_text("%.0f", finding.log_likelihood_gain),
                                number_text("%.0f %%", 100.0 * finding.share_of_mismatch), alternatives_text(finding)});
    first = false;
  }
  if (first) tables.said.rows.push_back({set, verdict_text(diagnosis.verdict), "", "", "", "", "", ""});
}

void add_proof(const std::string& set, const std::string& judged_on, const FitTable& fit, Tables& tables) {
  if (!fit.calibrated) return;
  tables.proof.rows.push_back({set, judged_on, text_of(fit.nominal), text_of(fit.calibrated),
                               text_of(fit.with_findings), text_of(fit.placebo), text_of(fit.noise_floor)});
}

// Of an error that a few dozen metres give: less than this is no difference.
constexpr double kNoDifference = 0.05;

// What was named must not make runs worse on which it was not fitted: squares of position and heading together, each in
// parts of what calibration leaves.
Claim claim_of(const std::string& set, const std::string& judged_on, double position_before_m,
               double heading_before_rad, double position_m, double heading_rad) {
  Claim claim;
  claim.sentence = set + ": what was named makes no worse what it was not fitted on (" + judged_on + ")";
  claim.because = text_in_mm(position_before_m) + " mm, " + deg(heading_before_rad) + " -> " + text_in_mm(position_m) +
                  " mm, " + deg(heading_rad);
  claim.holds = std::pow(position_m / position_before_m, 2) + std::pow(heading_rad / heading_before_rad, 2) <=
                2.0 * std::pow(1.0 + kNoDifference, 2);
  return claim;
}

std::optional<Claim> claim_of(const std::string& set, const std::string& judged_on, const Diagnosis& diagnosis) {
  const FitTable& fit = diagnosis.held_out;
  if (diagnosis.findings.empty() || !fit.calibrated || !fit.with_findings) return std::nullopt;
  return claim_of(set, judged_on, fit.calibrated->position_rms_m, fit.calibrated->heading_rms_rad,
                  fit.with_findings->position_rms_m, fit.with_findings->heading_rms_rad);
}

// What the halves of the runs that were not fitted say of an effect must be what the diagnosis says of it.
void add_looked_for(const RecordingSet& set, const Diagnosis& diagnosis, Tables& tables, ExperimentReport& report) {
  const FittedModel model = model_of(diagnosis);
  for (const char* effect : kLookedFor) {
    const bool named = std::any_of(diagnosis.findings.begin(), diagnosis.findings.end(),
                                   [&](const Finding& f) { return f.effect == effect; });
    const bool could = std::none_of(diagnosis.not_testable.begin(), diagnosis.not_testable.end(),
                                    [&](const NotTestable& n) { return n.effect == effect; });
    const std::optional<LookedFor> l = looked_for(effect, model, set.recordings);
    std::vector<std::string> row{set.name, with_blanks(effect),
                                 named   ? "named"
                                 : could ? "not named"
                                         : "could not show"};
    if (l) {
      const std::string without = text_in_mm(l->without.position_m) + " mm, " + deg(l->without.heading_rad);
      const std::string with = text_in_mm(l->with.position_m) + " mm, " + deg(l->with.heading_rad);
      row.insert(row.end(), {number_text("%.2g", l->size), without, with});
      row.push_back(number_text("%+.1f", l->better_by));
      Claim claim;
      claim.sentence = set.name + ": " + with_blanks(effect) +
                       (named ? " is named, and runs are better predicted with it where it was not fitted"
                              : " is not named, and what was not fitted is no better predicted with it");
      claim.because = without + " -> " + with + ", better by " + number_text("%.1f", l->better_by) +
                      " standard errors" + (could ? "" : "; these drives could not show it");
      claim.holds = named ? l->better_by > kUndecided : l->better_by < kPlainlyBetter;
      claim.explained = named && std::abs(l->better_by) < kUndecided;
      if (claim.explained && !claim.holds)
        claim.because += ": too little was driven to confirm the name or to refute it";
      report.claims.push_back(claim);
    } else {
      row.insert(row.end(), {"-", "no wheels were recorded, or too little was driven", "", ""});
    }
    tables.looked_for.rows.push_back(row);
  }
}

Progress part(const Progress& progress, double begin, double share) {
  return [=](double done) { return !progress || progress(begin + share * done); };
}

std::string effects_text(const FittedModel& model) {
  std::string text;
  for (const FittedEffect& e : model.effects)
    if (e.active.effect.compare(0, 6, "truth_") != 0) text += (text.empty() ? "" : ", ") + with_blanks(e.active.effect);
  return text.empty() ? "none" : text;
}

Result<Done> add_robots(const RecordingSet& set, Tables& tables, ExperimentReport& report, const Progress& progress) {
  const auto n = static_cast<double>(set.recordings.size());
  for (std::size_t k = 0; k < set.recordings.size(); ++k) {
    std::vector<Recording> others = set.recordings;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const Recording& robot = set.recordings[k];
    const Result<Diagnosis> diagnosis =
        diagnose(others, {robot}, set.nominal, {}, part(progress, static_cast<double>(k) / n, 1.0 / n));
    if (!diagnosis) return diagnosis.error();
    add_proof(set.name, robot.name + ", all frozen from the others", diagnosis->held_out, tables);
    const FittedModel model = model_of(*diagnosis);
    const std::optional<TransferErrors> errors = transferred(model, set.nominal, robot, kOwnRefitted);
    if (!errors) {
      report.notes.push_back(set.name + ": " + robot.name + " holds too little to be judged");
      continue;
    }
    tables.robots.rows.push_back({robot.name, text_of(errors->nominal), text_of(errors->as_the_others),
                                  text_of(errors->own), text_of(errors->own_and_findings), effects_text(model)});
  }
  return Done{};
}

// Names and numbers from every other run, the rest predicted with nothing of their own but the clock that was set by
// hand.
Result<Done> add_runs_held_out(const RecordingSet& set, Tables& tables, ExperimentReport& report,
                               const Progress& progress) {
  std::vector<Recording> seen, unseen;
  for (std::size_t i = 0; i < set.recordings.size(); ++i) (i % 2 ? unseen : seen).push_back(set.recordings[i]);
  if (unseen.empty()) return Done{};
  const Result<Diagnosis> diagnosis = diagnose(seen, unseen, set.nominal, {}, progress);
  if (!diagnosis) return diagnosis.error();
  FittedModel drawn;
  drawn.vehicle = set.nominal;
  const FittedModel models[] = {drawn, calibrated_model_of(*diagnosis), model_of(*diagnosis)};
  double position[3] = {}, heading[3] = {};
  int runs = 0;
  for (const Recording& recording : unseen) {
    std::optional<TrackError> errors[3];
    for (int k = 0; k < 3; ++k) errors[k] = with_own_clock(models[k], recording);
    if (!errors[0] || !errors[1] || !errors[2]) continue;
    ++runs;
    for (int k = 0; k < 3; ++k) {
      position[k] += std::pow(errors[k]->position_rms_m, 2);
      heading[k] += std::pow(errors[k]->heading_rms_rad, 2);
    }
  }
  if (runs == 0) return Done{};
  std::vector<std::string> row{
      set.name, std::to_string(runs) + " unseen, from the " + std::to_string(seen.size()) + " others; own clock"};
  for (int k = 0; k < 3; ++k) {
    position[k] = std::sqrt(position[k] / runs);
    heading[k] = std::sqrt(heading[k] / runs);
    row.push_back(text_in_mm(position[k]) + " mm, " + deg(heading[k]));
  }
  row.insert(row.end(), {"", ""});
  tables.proof.rows.push_back(row);
  if (!models[2].effects.empty())
    report.claims.push_back(claim_of(set.name, row[1], position[1], heading[1], position[2], heading[2]));
  return Done{};
}

Result<ExperimentReport> run_real_recordings(const ExperimentOptions& options, const Progress& progress) {
  ExperimentReport report;
  const std::vector<RecordingSet> sets = recording_sets(recordings_folder(options.recordings), report.notes);
  Tables tables;
  const double share = sets.empty() ? 1.0 : 1.0 / static_cast<double>(sets.size());
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const RecordingSet& set = sets[k];
    const double begin = share * static_cast<double>(k);
    report.notes.insert(report.notes.end(), set.notes.begin(), set.notes.end());
    if (set.recordings.empty()) continue;
    if (progress && !progress(begin)) break;
    add_files(set, tables, report.notes);
    const Result<Diagnosis> diagnosis =
        diagnose(set.recordings, {}, set.nominal, {}, part(progress, begin, 0.4 * share));
    if (progress && !progress(begin + 0.4 * share)) break;
    if (!diagnosis) return diagnosis.error();
    add_said(set.name, *diagnosis, tables);
    add_looked_for(set, *diagnosis, tables, report);
    add_proof(set.name, "all runs that were fitted", diagnosis->train, tables);
    if (diagnosis->left_out_in_turn) {
      add_proof(set.name, "each run left out in turn", diagnosis->held_out, tables);
      if (auto claim = claim_of(set.name, "each left out in turn", *diagnosis)) report.claims.push_back(*claim);
    }
    const Progress rest = part(progress, begin + 0.4 * share, 0.6 * share);
    const Result<Done> done =
        set.robots ? add_robots(set, tables, report, rest) : add_runs_held_out(set, tables, report, rest);
    if (progress && !progress(begin + share)) break;
    if (!done) return done.error();
  }
  for (ResultTable* table : {&tables.files, &tables.said, &tables.proof, &tables.robots, &tables.looked_for})
    if (!table->rows.empty()) report.tables.push_back(std::move(*table));
  return report;
}

}  // namespace

Experiment real_recordings() {
  return {"real", "real recordings: what a plain calibration leaves, what is missing, and the proof on held-out runs",
          "R. B. Sousa et al. 2022 (OptiOdom); K. Y. K. Leung et al. 2011 (UTIAS multi-robot data set)",
          run_real_recordings};
}

}  // namespace odolab
