#include "core/io/diagnosis_json.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/refuted.h"

namespace odolab {

namespace {

bool is_length_of_vehicle(const ParameterEstimate& p) {
  return p.unit == "m" && p.name.rfind("truth_mounting.", 0) != 0;
}

// Where only ratios of lengths show, each is as uncertain as the vehicle's file was taken to be.
Json calibration_json(const LeastSquaresCalibration& calibration) {
  constexpr double kVehiclesFile = 0.1;
  Json json = Json::object();
  for (const ParameterEstimate& p : calibration.parameters) {
    const bool is_a_ratio = calibration.scale_is_open && p.determined && is_length_of_vehicle(p);
    Json& entry = json[p.name];
    entry["value"] = p.value;
    entry["stderr"] =
        p.determined ? Json(is_a_ratio ? std::hypot(p.stderr_value, kVehiclesFile * p.value) : p.stderr_value) : Json();
    entry["unit"] = p.unit;
    if (is_a_ratio) entry["only_its_ratio_shows"] = true;
    if (!p.determined) entry["determined"] = false;
  }
  return json;
}

// A chance that is less than a number can be is none of zero.
double chance_json(double p_value) { return std::max(1e-300, p_value); }

Json where_json(const WhereFound& where) {
  Json json = Json::object();
  for (const auto& [from_s, to_s] : where.time_s) json["time_s"].push_back(std::vector<double>{from_s, to_s});
  if (!where.recording.empty()) json["recording"] = where.recording;
  for (const std::string& other : where.other_recordings) json["other_recordings"].push_back(other);
  if (where.zone) {
    Json& zone = json["zone"];
    zone["x_m"] = where.zone->x_m;
    zone["y_m"] = where.zone->y_m;
    zone["radius_m"] = where.zone->radius_m;
  }
  if (!where.regime.empty()) json["regime"] = where.regime;
  return json;
}

Json finding_json(const Finding& finding) {
  Json json = Json::object();
  json["effect"] = finding.effect;
  json["component"] = finding.component;
  Json& parameters = json["parameters"] = Json::object();
  for (const FoundParameter& p : finding.parameters) {
    Json& entry = parameters[p.name];
    entry["value"] = p.value;
    entry["stderr"] = p.stderr_value;
    entry["unit"] = p.unit;
  }
  json["where"] = where_json(finding.where);
  Json& evidence = json["evidence"];
  evidence["log_likelihood_gain"] = finding.log_likelihood_gain;
  evidence["p_value"] = chance_json(finding.p_value);
  Json& alternatives = json["alternatives"] = Json::array();
  for (const Alternative& a : finding.alternatives) {
    Json& entry = alternatives.push_back(Json::object());
    entry["effect"] = a.effect;
    entry["component"] = a.component;
    entry["log_likelihood_gain"] = a.log_likelihood_gain;
    entry["told_apart_by"] = a.told_apart_by;
  }
  json["share_of_mismatch"] = finding.share_of_mismatch;
  if (finding.moves) {
    json["moves"]["position_rms_m"] = finding.moves->position_rms_m;
    json["moves"]["heading_rms_rad"] = finding.moves->heading_rms_rad;
  }
  if (!finding.sentence.empty()) json["sentence"] = finding.sentence;
  if (!finding.form_in_words.empty()) json["form"] = finding.form_in_words;
  return json;
}

void put(Json& json, const char* key, const std::optional<FitFigures>& figures, const std::optional<WindowSize>& over) {
  if (!figures) return;
  Json& entry = json[key];
  entry["position_rms_m"] = figures->gathered() ? Json(figures->position_rms_m) : Json();
  entry["heading_rms_rad"] = figures->gathered() && figures->has_heading() ? Json(figures->heading_rms_rad) : Json();
  entry["normalised_chi2"] = figures->normalised_chi2;
  if (!over || !figures->gathered()) return;
  entry["window_m"] = over->way_m;
  entry["window_rad"] = over->turn_rad;
}

Json asked_json(const AskedEffect& asked) {
  Json json = Json::object();
  json["effect"] = asked.effect;
  json["component"] = asked.component;
  json["named"] = asked.named;
  json["log_likelihood_gain"] = asked.log_likelihood_gain;
  if (asked.gain_beside_findings) json["log_likelihood_gain_beside_findings"] = *asked.gain_beside_findings;
  json["p_value"] = chance_json(asked.p_value);
  if (asked.survives) json["survives_calibration"] = *asked.survives;
  const auto put_size = [&](const char* key, const std::optional<FoundParameter>& of) {
    if (!of) return;
    json[key]["parameter"] = of->name;
    json[key]["value"] = of->value;
    json[key]["unit"] = of->unit;
  };
  put_size("bends_calibration", asked.bends);
  put_size("least_size_seen", asked.least_seen);
  return json;
}

Json fit_json(const FitTable& fit, const std::optional<WindowSize>& over) {
  Json json = Json::object();
  put(json, "nominal", fit.nominal, over);
  put(json, "calibrated", fit.calibrated, over);
  put(json, "with_findings", fit.with_findings, over);
  put(json, "noise_floor", fit.noise_floor, over);
  put(json, "spline", fit.spline, over);
  put(json, "placebo", fit.placebo, over);
  return json;
}

}  // namespace

std::string word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::found:
      return "found";
    case Verdict::nothing_missing:
      return "nothing_missing";
    case Verdict::unknown_effect:
      return "unknown_effect";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::cannot_say:
      break;
  }
  return "cannot_say";
}

Json diagnosis_json(const Diagnosis& diagnosis) {
  Json json = Json::object();
  json["schema"] = "odolab.diagnosis/1";
  json["verdict"] = word_of(diagnosis.verdict);
  json["calibration"] = calibration_json(diagnosis.calibration);
  Json& findings = json["findings"] = Json::array();
  for (const Finding& finding : diagnosis.findings) findings.push_back(finding_json(finding));
  json["recordings"]["fitted_on"] = diagnosis.fitted_on;
  json["recordings"]["held_out"] = diagnosis.held_out_runs;
  Json& fit = json["fit"] = Json::object();
  fit["train"] = fit_json(diagnosis.train, diagnosis.train_over);
  fit["held_out"] = fit_json(diagnosis.held_out, diagnosis.held_out_over);
  if (diagnosis.unseen_gain) fit["unseen_log_likelihood_gain"] = *diagnosis.unseen_gain;
  Json& simulation = json["simulation"] = Json::object();
  put(simulation, "before", diagnosis.simulation.calibrated, diagnosis.train_over);
  put(simulation, "after", diagnosis.simulation.with_findings, diagnosis.train_over);
  Json& asked = json["asked"] = Json::array();
  for (const AskedEffect& a : diagnosis.asked) asked.push_back(asked_json(a));
  Json& not_testable = json["not_testable_here"] = Json::array();
  for (const NotTestable& n : diagnosis.not_testable) {
    Json& entry = not_testable.push_back(Json::object());
    entry["effect"] = n.effect;
    entry["because"] = n.because;
    entry["drive_this"] = n.drive_this;
  }
  json["next_drive"] = diagnosis.next_drive;
  Json& refuted_by = json["refuted_by"] = Json::array();
  if (is_refuted_by_unseen(diagnosis)) refuted_by.push_back("held_out");
  if (is_refuted_by_simulator(diagnosis)) refuted_by.push_back("simulation");
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : diagnosis.warnings) warnings.push_back(warning);
  return json;
}

}  // namespace odolab
