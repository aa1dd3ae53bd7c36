#include "core/diagnosis/units/merged.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/diagnosis/chi_square.h"
#include "core/diagnosis/joint_model.h"
#include "core/diagnosis/units/traces.h"
#include "core/diagnosis/units/unit_recordings.h"

namespace odolab {

namespace {

constexpr double kSigmas = 6.0;  // of a mounting or a bias, as in the diagnosis of one drive: least sizes beside it
constexpr double kLeastClock_s = 0.004;

bool is_of_wheels(const std::string& component) {
  return component == "left_wheel" || component == "right_wheel" || component == "both_wheels";
}

// What all units see alike, whichever of them it was named by.
bool is_common(const std::string& effect) {
  return effect == "clock_rate" || effect == "floor_slope_creep" || effect == "slip_zone" || effect == "truth_frozen";
}

const FoundParameter* parameter_of(const Finding& f, const std::string& name) {
  for (const FoundParameter& p : f.parameters)
    if (p.name == name) return &p;
  return nullptr;
}

bool same_zone(const Finding& a, const Finding& b) {
  if (!a.where.zone || !b.where.zone) return !a.where.zone && !b.where.zone;
  return std::hypot(a.where.zone->x_m - b.where.zone->x_m, a.where.zone->y_m - b.where.zone->y_m) <
         a.where.zone->radius_m + b.where.zone->radius_m;
}

bool is_event(const Finding& f) { return parameter_of(f, "at_s") != nullptr; }

bool same_cause(const Finding& a, const Finding& b) {
  return a.effect == b.effect && is_common(a.effect) && same_zone(a, b) && (!is_event(a) || !is_event(b));
}

// What several units say of one cause: each parameter weighted by how well it is known.
void put_together(Finding& sum, const Finding& more) {
  for (FoundParameter& p : sum.parameters) {
    const FoundParameter* q = parameter_of(more, p.name);
    if (!q || !(p.stderr_value > 0.0) || !(q->stderr_value > 0.0)) continue;
    const double a = 1.0 / (p.stderr_value * p.stderr_value), b = 1.0 / (q->stderr_value * q->stderr_value);
    double other = q->value;
    if (p.name.find("direction_rad") != std::string::npos) other = unwrapped(other, p.value);
    p.value = (a * p.value + b * other) / (a + b);
    p.stderr_value = 1.0 / std::sqrt(a + b);
  }
  sum.log_likelihood_gain += more.log_likelihood_gain;
  sum.p_value = std::min(sum.p_value, more.p_value);
  // What one unit cannot tell apart another may.
  std::vector<Alternative> both;
  for (Alternative a : sum.alternatives)
    for (const Alternative& b : more.alternatives)
      if (a.effect == b.effect) {
        a.log_likelihood_gain += b.log_likelihood_gain;
        both.push_back(a);
        break;
      }
  sum.alternatives = both;
}

FitTable joined(const std::vector<Diagnosis>& diagnoses, FitTable Diagnosis::*table) {
  FitTable sum;
  const auto join = [&](std::optional<FitFigures> FitTable::*entry) {
    FitFigures all;
    for (const Diagnosis& d : diagnoses) {
      const std::optional<FitFigures>& one = d.*table.*entry;
      if (!one) return;
      all.position_rms_m += one->position_rms_m * one->position_rms_m / static_cast<double>(diagnoses.size());
      all.heading_rms_rad += one->heading_rms_rad * one->heading_rms_rad / static_cast<double>(diagnoses.size());
      all.normalised_chi2 += one->normalised_chi2 / static_cast<double>(diagnoses.size());
    }
    sum.*entry = FitFigures{std::sqrt(all.position_rms_m), std::sqrt(all.heading_rms_rad), all.normalised_chi2};
  };
  join(&FitTable::nominal);
  join(&FitTable::calibrated);
  join(&FitTable::with_findings);
  join(&FitTable::noise_floor);
  join(&FitTable::spline);
  join(&FitTable::placebo);
  return sum;
}

// The vehicle file's key of a drive's parameter in its unit.
std::vector<ParameterEstimate> in_file(const ParameterEstimate& p, const VehicleUnit& unit, const Vehicle& nominal,
                                       std::size_t u) {
  ParameterEstimate renamed = p;
  const std::string before = unit.key.empty() ? "" : unit.key + ".";
  if (const auto* tracks = std::get_if<Tracked>(&nominal.kind)) {
    if (p.name == "wheel_radius_left_m") renamed.name = "sprocket_radius_left_m";
    if (p.name == "wheel_radius_right_m") renamed.name = "sprocket_radius_right_m";
    if (p.name == "wheelbase_m") {
      renamed.name = "slip_factor";
      renamed.unit = "1";
      for (double ParameterEstimate::*value :
           {&ParameterEstimate::nominal, &ParameterEstimate::value, &ParameterEstimate::stderr_value})
        renamed.*value /= tracks->track_width_m;
    }
  }
  if (const auto* platform = std::get_if<MultiCastor>(&nominal.kind); platform && p.name == "wheelbase_m") {
    const Castor& castor = platform->castors[u];
    std::vector<ParameterEstimate> two;
    for (const auto& [name, offset_m] : {std::pair{"wheel_offset_left_m", castor.wheel_offset_left_m},
                                         std::pair{"wheel_offset_right_m", castor.wheel_offset_right_m}}) {
      ParameterEstimate one = p;
      const double share = offset_m / castor.track_m();
      one.name = before + name;
      one.nominal *= share;
      one.value *= share;
      one.stderr_value *= share;
      two.push_back(one);
    }
    return two;
  }
  renamed.name = before + renamed.name;
  return {renamed};
}

LeastSquaresCalibration joined_calibration(const std::vector<Diagnosis>& diagnoses,
                                           LeastSquaresCalibration Diagnosis::*which, const GeometryFit& geometry,
                                           const std::vector<VehicleUnit>& units, const Vehicle& nominal) {
  LeastSquaresCalibration sum;
  sum.vehicle = geometry.vehicle;
  bool truth_is_carried = false;
  for (std::size_t u = 0; u < units.size(); ++u) {
    const LeastSquaresCalibration& one = diagnoses[u].*which;
    sum.vehicle = with_drive(sum.vehicle, u, std::get<DifferentialDrive>(one.vehicle.kind));
    if (units[u].carries_truth) {
      sum.vehicle.truth = one.vehicle.truth;
      sum.time_offset_s = one.time_offset_s;
      truth_is_carried = true;
    }
    for (const ParameterEstimate& p : one.parameters) {
      const bool of_truth = p.name.rfind("truth_mounting.", 0) == 0;
      if (of_truth && units[u].carries_truth) sum.parameters.push_back(p);
      if (of_truth) continue;
      for (ParameterEstimate& renamed : in_file(p, units[u], nominal, u)) sum.parameters.push_back(std::move(renamed));
    }
    for (const std::string& sentence : one.cannot_tell)
      sum.cannot_tell.push_back(units[u].name.empty() ? sentence : units[u].name + ": " + sentence);
    sum.innovations += one.innovations;
    sum.outliers += one.outliers;
    const double share = 1.0 / static_cast<double>(units.size());
    sum.normalised_chi2 += share * one.normalised_chi2;
    sum.normalised_chi2_nominal += share * one.normalised_chi2_nominal;
  }
  for (const JointEstimate& e : geometry.joints) {
    const bool of_truth = e.parameter.component == "truth";
    if (of_truth && truth_is_carried) continue;
    sum.parameters.push_back({e.parameter.name, e.parameter.unit, e.nominal, e.value, e.stderr_value, e.determined});
  }
  if (!truth_is_carried)
    for (double clock_s : geometry.clock_s) sum.time_offset_s.push_back(nominal.truth.time_offset_s + clock_s);
  return sum;
}

struct Bias {
  std::string effect, component;
  double sign = 0.0;  // of the bias in the heading at which the truth seems to be mounted
};

// The encoder whose bias turns a unit's whole truth.
std::optional<Bias> bias_of(const VehicleUnit& unit) {
  if (unit.carries_truth || unit.name == "truck_a" || unit.name.empty()) return std::nullopt;
  if (unit.name == "trailer") return Bias{"link_angle_bias", "trailer", -1.0};
  if (unit.name == "truck_b") return Bias{"link_angle_bias", "truck_b", 1.0};
  return Bias{"pivot_angle_bias", unit.name, 1.0};
}

// The findings of one unit in the vehicle's words. What remains of the truth's mounting is a biased encoder, or lengths
// that are calibration.
void add_findings_of(const Diagnosis& d, const VehicleUnit& unit, const JointRounding& rounding,
                     std::vector<Finding>& all) {
  const std::optional<Bias> bias = bias_of(unit);
  for (Finding f : d.findings) {
    if (may_be_rounding(f, unit, rounding)) continue;
    const auto rename = [&](std::string& component) { component = component_of_unit(unit.name, component); };
    const bool of_mounting =
        f.effect == "truth_mounting_offset" || (f.effect == "wheel_toe" && !f.alternatives.empty() &&
                                                f.alternatives.front().effect == "truth_mounting_offset");
    if (!unit.carries_truth && (f.effect == "truth_time_offset" || f.effect == "truth_frozen")) continue;
    if (!unit.carries_truth && of_mounting && !bias) continue;
    if (bias && of_mounting) {
      const FoundParameter* toe = parameter_of(f, "sideways_per_metre");
      const FoundParameter* heading = parameter_of(f, "heading_rad");
      const double turned = toe ? -toe->value : heading ? heading->value : 0.0;
      const double error = toe ? toe->stderr_value : heading ? heading->stderr_value : 0.0;
      if (std::abs(turned) < 0.003 || std::abs(turned) < kSigmas * error) continue;
      Finding biased;
      biased.effect = bias->effect;
      biased.component = bias->component;
      biased.parameters = {{"bias_rad", bias->sign * turned, error, "rad"}};
      biased.log_likelihood_gain = f.log_likelihood_gain;
      biased.p_value = f.p_value;
      biased.sentence = "the encoder that tells how the " + unit.name + " stands reads more or less than it should";
      all.push_back(biased);
      continue;
    }
    rename(f.component);
    for (Alternative& a : f.alternatives) rename(a.component);
    if (is_common(f.effect) && f.component != "floor" && f.component != "truth")
      f.component = f.effect == "clock_rate" ? "vehicle" : "floor";
    const auto same = std::find_if(all.begin(), all.end(), [&](const Finding& g) { return same_cause(f, g); });
    if (same == all.end())
      all.push_back(f);
    else
      put_together(*same, f);
  }
}

bool takes_place_in(const Finding& event, const WhereFound::Zone& zone) {
  constexpr double kBeside_m = 0.2;
  return event.where.zone && std::hypot(event.where.zone->x_m - zone.x_m, event.where.zone->y_m - zone.y_m) <
                                 zone.radius_m + event.where.zone->radius_m + kBeside_m;
}

// A patch of floor that one unit names looks like pushes and bumps to units that only touch it.
void put_events_into_their_zones(std::vector<Finding>& all) {
  std::vector<Finding> rest;
  for (const Finding& f : all) {
    Finding* zone = nullptr;
    for (Finding& g : all)
      if ((f.effect == "collision" || f.effect == "bump") && g.effect == "slip_zone" && g.where.zone &&
          takes_place_in(f, *g.where.zone))
        zone = &g;
    if (!zone) rest.push_back(f);
  }
  all = std::move(rest);
}

// As with one drive: what is left without a name beside names that stand must be a fair part of the evidence.
bool leave_out_small_rest(std::vector<Finding>& all) {
  constexpr double kMostLeft = 0.15;
  double named = 0.0;
  for (const Finding& f : all) named += f.effect == "unknown" ? 0.0 : f.log_likelihood_gain;
  const auto rest = std::remove_if(all.begin(), all.end(), [&](const Finding& f) {
    return f.effect == "unknown" && f.log_likelihood_gain < kMostLeft * named;
  });
  const bool some = rest != all.end();
  all.erase(rest, all.end());
  return some;
}

// Biased encoders by the geometry's fit.
void add_biases(const GeometryFit& geometry, const std::vector<VehicleUnit>& units, std::vector<Finding>& all) {
  int asked = 0;
  for (const JointEstimate& e : geometry.joints) asked += e.parameter.effect.empty() ? 0 : 1;
  for (const JointEstimate& e : geometry.joints) {
    if (e.parameter.effect.empty() || e.parameter.component == "truth" || !e.determined) continue;
    const double off = e.value - e.nominal, z = off / e.stderr_value;
    if (std::abs(z) < kSigmas || std::abs(off) < e.parameter.least) continue;
    const auto same = std::find_if(all.begin(), all.end(), [&](const Finding& f) {
      return f.effect == e.parameter.effect && f.component == e.parameter.component;
    });
    if (same != all.end()) {  // what the fit left of it
      same->parameters.front().value += off;
      same->log_likelihood_gain += 0.5 * z * z;
      continue;
    }
    Finding f;
    f.effect = e.parameter.effect;
    f.component = e.parameter.component;
    f.parameters = {{e.parameter.parameter, off, e.stderr_value, e.parameter.unit}};
    f.log_likelihood_gain = 0.5 * z * z;
    f.p_value = std::min(1.0, asked * chi_square_tail(z * z, 1));
    f.sentence = f.effect == "link_length_bias" ? "the link's linear encoder reads more or less than the link is long"
                                                : "an absolute encoder reads more or less than the angle is";
    all.push_back(f);
  }
  // Wheels that do not stand square to the axle crawl sideways, as an axle does whose direction is read wrong.
  for (Finding& f : all) {
    if (f.effect != "link_angle_bias" && f.effect != "pivot_angle_bias") continue;
    for (const VehicleUnit& unit : units)
      if (const std::optional<Bias> bias = bias_of(unit); bias && bias->component == f.component)
        f.alternatives = {{"wheel_toe", component_of_unit(unit.name, "vehicle"), f.log_likelihood_gain,
                           "a straight edge along the joint: the motion is the same"}};
  }
}

// Mounting and clock of the truth where no unit carries it.
void add_truth(const GeometryFit& geometry, const Vehicle& nominal, std::vector<Finding>& all) {
  Finding mounting;
  bool material = false;
  for (const JointEstimate& e : geometry.joints) {
    if (e.parameter.component != "truth" || !e.determined) continue;
    const double off = e.value - e.nominal, z = off / e.stderr_value;
    mounting.parameters.push_back({e.parameter.parameter, e.value, e.stderr_value, e.parameter.unit});
    if (std::abs(z) < kSigmas || std::abs(off) < e.parameter.least) continue;
    material = true;
    mounting.log_likelihood_gain += 0.5 * z * z;
  }
  if (material) {
    mounting.effect = "truth_mounting_offset";
    mounting.component = "truth";
    mounting.p_value = chi_square_tail(2.0 * mounting.log_likelihood_gain, 3);
    mounting.sentence = std::holds_alternative<EncoderTrailer>(nominal.kind)
                            ? "the tracked point, or the hitch, is not where the vehicle's file has it"
                            : "the tracked point is not where the vehicle's file has it";
    all.push_back(mounting);
  }
  double mean_s = 0.0, variance = 0.0;
  const double n = static_cast<double>(geometry.clock_s.size());
  for (std::size_t r = 0; r < geometry.clock_s.size(); ++r) {
    mean_s += geometry.clock_s[r] / n;
    variance += geometry.clock_stderr_s[r] * geometry.clock_stderr_s[r] / (n * n);
  }
  const double z = mean_s / std::sqrt(std::max(variance, 1e-18));
  if (std::abs(z) < kSigmas || std::abs(mean_s) < kLeastClock_s) return;
  Finding clock;
  clock.effect = "truth_time_offset";
  clock.component = "truth";
  clock.parameters = {{"offset_s", nominal.truth.time_offset_s + mean_s, std::sqrt(variance), "s"}};
  clock.log_likelihood_gain = 0.5 * z * z;
  clock.p_value = chi_square_tail(z * z, 1);
  clock.sentence = "the truth's clock is off against the vehicle's";
  all.push_back(clock);
}

std::vector<NotTestable> not_testable_in(const std::vector<Diagnosis>& diagnoses,
                                         const std::vector<VehicleUnit>& units) {
  std::vector<NotTestable> all;
  for (std::size_t u = 0; u < diagnoses.size(); ++u)
    for (const NotTestable& n : diagnoses[u].not_testable) {
      if (std::any_of(all.begin(), all.end(), [&](const NotTestable& m) { return m.effect == n.effect; })) continue;
      all.push_back({n.effect, units[u].name.empty() ? n.because : units[u].name + ": " + n.because, n.drive_this});
    }
  return all;
}

Verdict verdict_of(const std::vector<Diagnosis>& diagnoses, const std::vector<Finding>& findings) {
  const auto any = [&](Verdict v) {
    return std::any_of(diagnoses.begin(), diagnoses.end(), [&](const Diagnosis& d) { return d.verdict == v; });
  };
  if (std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return f.effect == "unknown"; }))
    return Verdict::unknown_effect;
  if (!findings.empty()) {
    const bool open =
        std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return !f.alternatives.empty(); });
    return open ? Verdict::ambiguous : Verdict::found;
  }
  return any(Verdict::cannot_say) ? Verdict::cannot_say : Verdict::nothing_missing;
}

}  // namespace

std::string component_of_unit(const std::string& unit, const std::string& component) {
  if (unit.empty() || component == "floor" || component == "truth") return component;
  return is_of_wheels(component) ? unit + "." + component : component == "vehicle" ? unit : component;
}

std::optional<std::string> component_in_unit(const std::string& unit, const std::string& component,
                                             const std::vector<VehicleUnit>& all) {
  if (component == "floor" || component == "truth" || component == "vehicle") return component;
  if (!unit.empty() && component == unit) return "vehicle";
  if (!unit.empty() && component.rfind(unit + ".", 0) == 0) return component.substr(unit.size() + 1);
  if (unit.empty() && is_of_wheels(component)) return component;
  // of both wheels everywhere, where nothing says whose
  if (is_of_wheels(component) &&
      std::none_of(all.begin(), all.end(), [](const VehicleUnit& u) { return u.name.empty(); }))
    return component;
  return std::nullopt;
}

Diagnosis merged(const std::vector<Diagnosis>& diagnoses, const GeometryFit& geometry, const Vehicle& nominal,
                 const std::vector<Recording>& recordings, bool from_outside) {
  std::vector<VehicleUnit> units = units_of(nominal);
  for (VehicleUnit& unit : units) unit.carries_truth = unit.carries_truth && from_outside;
  Diagnosis d;
  d.calibration = joined_calibration(diagnoses, &Diagnosis::calibration, geometry, units, nominal);
  d.calibration_alone = joined_calibration(diagnoses, &Diagnosis::calibration_alone, geometry, units, nominal);
  bool truth_is_carried = false;
  Vehicle fitted = geometry.vehicle;
  for (std::size_t u = 0; u < units.size(); ++u) {
    const Diagnosis& one = diagnoses[u];
    const Vehicle& own = one.fitted_vehicle ? *one.fitted_vehicle : one.calibration.vehicle;
    fitted = with_drive(fitted, u, std::get<DifferentialDrive>(own.kind));
    if (units[u].carries_truth) {
      fitted.truth = own.truth;
      d.truth_clock_s = one.truth_clock_s;
      truth_is_carried = true;
    }
    add_findings_of(one, units[u], rounding_of_joints(nominal, u), d.findings);
    const std::string of = units[u].name.empty() ? "" : units[u].name + ": ";
    for (const std::string& w : one.warnings) d.warnings.push_back(of + w);
    for (Response r : one.responses) {
      r.channel = of + r.channel;
      d.responses.push_back(std::move(r));
    }
    for (std::vector<Residuals> Diagnosis::*residuals : {&Diagnosis::residuals_before, &Diagnosis::residuals_after})
      for (Residuals r : one.*residuals) {
        if (!units[u].name.empty()) r.recording += ", " + units[u].name;
        (d.*residuals).push_back(std::move(r));
      }
    d.left_out_in_turn = d.left_out_in_turn || one.left_out_in_turn;
    if (!one.next_drive.empty() && (d.next_drive.empty() || one.verdict == Verdict::ambiguous)) {
      d.next_drive = one.next_drive;
      d.next_legs = one.next_legs;
    }
  }
  d.fitted_vehicle = fitted;
  put_events_into_their_zones(d.findings);
  if (!truth_is_carried && from_outside) {
    add_truth(geometry, nominal, d.findings);
  }
  if (!truth_is_carried)
    for (std::size_t r = 0; r < recordings.size(); ++r)
      d.truth_clock_s.emplace_back(recordings[r].name, nominal.truth.time_offset_s + geometry.clock_s[r]);
  if (!from_outside)
    d.fitted_vehicle->truth = d.calibration.vehicle.truth = d.calibration_alone.vehicle.truth = nominal.truth;
  add_biases(geometry, units, d.findings);
  if (leave_out_small_rest(d.findings))
    d.warnings.push_back("beside the names given something small is left that no name describes");
  std::stable_sort(d.findings.begin(), d.findings.end(), [](const Finding& a, const Finding& b) {
    if ((a.effect == "unknown") != (b.effect == "unknown")) return a.effect == "unknown";
    return a.log_likelihood_gain > b.log_likelihood_gain;
  });
  double gain = 0.0;
  for (const Finding& f : d.findings) gain += f.log_likelihood_gain;
  for (Finding& f : d.findings)
    if (gain > 0.0 && f.effect != "unknown") f.share_of_mismatch = f.log_likelihood_gain / gain;
  d.verdict = verdict_of(diagnoses, d.findings);
  d.train = joined(diagnoses, &Diagnosis::train);
  d.held_out = joined(diagnoses, &Diagnosis::held_out);
  d.not_testable = not_testable_in(diagnoses, units);
  if (std::holds_alternative<Tracked>(nominal.kind))
    d.warnings.insert(
        d.warnings.begin(),
        "a tracked vehicle is judged as a differential drive that slips in every turn: its slip factor is "
        "calibration, and what slips beside it is what is found");
  if (std::holds_alternative<EncoderTrailer>(nominal.kind))
    d.warnings.insert(d.warnings.begin(),
                      "the trailer is judged; its odometry does not look at the towing vehicle's own wheels or tracks");
  if (std::holds_alternative<MultiCastor>(nominal.kind))
    for (Finding& f : d.findings)
      if (f.effect == "unknown")
        f.sentence +=
            "; castors whose lengths differ from the file's drag each other along: calibrate them first, and "
            "drive by what was found";
  for (const Finding& f : d.findings) d.sentences.push_back(f.sentence);
  return d;
}

}  // namespace odolab
