#include "core/diagnosis/units/merged_findings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>

#include "core/base/chi_square.h"
#include "core/base/formatted.h"
#include "core/diagnosis/units/component_names.h"
#include "core/diagnosis/units/joint_errors.h"
#include "core/diagnosis/units/traces.h"
#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

// What all units see alike, whichever of them it was named by.
bool is_common(const std::string& effect) {
  return effect == "clock_rate" || effect == "truth_smoothing" || effect == "floor_slope_creep" ||
         effect == "slip_zone" || effect == "truth_frozen";
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
  if (is_data_fault(a.effect) && a.where.recording != b.where.recording) return false;
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

// Encoders that only contradict each other from the inside tell lengths as shares of the wheels'.
std::string or_scale_in_words(const JointEstimate& e) {
  const double off = e.value - e.nominal;
  return formatted(
      "the link's encoder reads %.1f +- %.1f mm %s than the link is long, or all wheels are %s than in the "
      "vehicle file by as large a share: a straight measured with a tape, or an outside truth, would tell",
      1e3 * std::abs(off), 1e3 * e.stderr_value, off > 0.0 ? "more" : "less", off > 0.0 ? "larger" : "smaller");
}

bool takes_place_in(const Finding& event, const WhereFound::Zone& zone) {
  constexpr double kBeside_m = 0.2;
  return event.where.zone && std::hypot(event.where.zone->x_m - zone.x_m, event.where.zone->y_m - zone.y_m) <
                                 zone.radius_m + event.where.zone->radius_m + kBeside_m;
}

}  // namespace

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
      if (std::abs(turned) < 0.003 || std::abs(turned) < kSigmasOfBias * error) continue;
      Finding biased;
      const std::string stands = (unit.name == "trailer" ? "the " : "") + part_words(unit.name);
      biased.effect = bias->effect;
      biased.component = bias->component;
      biased.parameters = {{"bias_rad", bias->sign * turned, error, "rad"}};
      biased.log_likelihood_gain = f.log_likelihood_gain;
      biased.p_value = f.p_value;
      biased.sentence = "the encoder that tells how " + stands + " stands reads more or less than it should";
      all.push_back(biased);
      continue;
    }
    if (f.effect == "unknown" && f.component == "truth" && !unit.carries_truth) f.component = "vehicle";
    if (!is_of_a_joint(f)) rename(f.component);
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

void put_pushes_together(std::vector<Finding>& all, const std::vector<VehicleUnit>& units) {
  constexpr double kAtOnce_s = 0.3;  // a push lasts a quarter of a second
  const auto carries = [&](const Finding& f) {
    return std::any_of(units.begin(), units.end(), [&](const VehicleUnit& unit) {
      return unit.carries_truth && f.component == component_of_unit(unit.name, "vehicle");
    });
  };
  std::vector<Finding> together;
  for (const Finding& f : all) {
    const FoundParameter* at = f.effect == "collision" ? parameter_of(f, "at_s") : nullptr;
    const auto same = std::find_if(together.begin(), together.end(), [&](const Finding& g) {
      return at && g.effect == "collision" && g.where.recording == f.where.recording &&
             std::abs(parameter_of(g, "at_s")->value - at->value) < kAtOnce_s;
    });
    if (same == together.end()) {
      together.push_back(f);
      continue;
    }
    const double gain = same->log_likelihood_gain + f.log_likelihood_gain;
    const double p_value = std::min(same->p_value, f.p_value);
    if (carries(f) || (!carries(*same) && f.log_likelihood_gain > same->log_likelihood_gain)) *same = f;
    same->component = "vehicle";
    same->log_likelihood_gain = gain;
    same->p_value = p_value;
  }
  all = std::move(together);
}

bool leave_out_small_rest(std::vector<Finding>& all) {
  constexpr double kMostLeft = 0.15;
  double named = 0.0;
  // Where the truth sits is no physics, however well it is known.
  for (const Finding& f : all)
    named += f.effect == "unknown" || f.effect.rfind("truth_", 0) == 0 ? 0.0 : f.log_likelihood_gain;
  const auto rest = std::remove_if(all.begin(), all.end(), [&](const Finding& f) {
    return f.effect == "unknown" && f.log_likelihood_gain < kMostLeft * named;
  });
  const bool some = rest != all.end();
  all.erase(rest, all.end());
  return some;
}

std::vector<std::string> add_biases(const GeometryFit& geometry, const std::vector<VehicleUnit>& units,
                                    std::vector<Finding>& all) {
  std::vector<std::string> not_told;
  int asked = 0;
  for (const JointEstimate& e : geometry.joints) asked += e.parameter.effect.empty() ? 0 : 1;
  for (const JointEstimate& e : geometry.joints) {
    if (!e.is_of_an_encoder() || !e.determined) continue;
    const double off = e.value - e.nominal, z = off / e.stderr_value;
    const auto same = std::find_if(all.begin(), all.end(), [&](const Finding& f) {
      return f.effect == e.parameter.effect && f.component == e.parameter.component;
    });
    // What the unit's own fit left of it stands beside what the geometry put into its truth, be that beyond chance or
    // not.
    if (same != all.end()) {
      FoundParameter& bias = same->parameters.front();
      bias.value += off;
      if (std::abs(bias.value) < std::max(e.least_bias(), kSigmasOfBias * bias.stderr_value))
        all.erase(same);
      else if (std::abs(z) > kSigmasOfBias)
        same->log_likelihood_gain += 0.5 * z * z;
      continue;
    }
    if (std::abs(z) < kSigmasOfBias || std::abs(off) < e.least_bias()) continue;
    if (e.feigned > 0.0 && std::abs(off) < e.feigned + kSigmasOfBias * e.stderr_value) {
      not_told.push_back(or_scale_in_words(e));
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
    if (e.feigned > 0.0)
      f.alternatives = {{"wheel_scale", "both_wheels", f.log_likelihood_gain,
                         "a straight measured with a tape, or an outside truth: all wheels off by one share look the "
                         "same from the inside"}};
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
  return not_told;
}

void leave_out_biases_beside_erring_joints(std::vector<Finding>& all) {
  const auto is_bias = [](const Finding& f) {
    return f.effect == "link_angle_bias" || f.effect == "link_length_bias" || f.effect == "pivot_angle_bias";
  };
  double of_joints = 0.0;
  std::set<std::string> erring;
  for (Finding& f : all) {
    if (!is_of_a_joint(f)) continue;
    of_joints = std::max(of_joints, f.log_likelihood_gain);
    erring.insert(f.component);
    for (const Finding& bias : all)
      if (is_bias(bias) && bias.component == f.component)
        f.alternatives.push_back({bias.effect, bias.component, bias.log_likelihood_gain, ""});
  }
  std::erase_if(all, [&](const Finding& f) {
    return is_bias(f) && (erring.count(f.component) > 0 || f.log_likelihood_gain < of_joints);
  });
}

void put_in_order(std::vector<Finding>& all) {
  std::stable_sort(all.begin(), all.end(), [](const Finding& a, const Finding& b) {
    if ((a.effect == "unknown") != (b.effect == "unknown")) return a.effect == "unknown";
    return comes_first(a, b);
  });
  double gain = 0.0;
  for (const Finding& f : all) gain += f.log_likelihood_gain;
  for (Finding& f : all)
    if (gain > 0.0 && f.effect != "unknown") f.share_of_mismatch = f.log_likelihood_gain / gain;
}

void add_mounting(const GeometryFit& geometry, const Vehicle& nominal, std::vector<Finding>& all) {
  Finding mounting;
  bool material = false;
  for (const JointEstimate& e : geometry.joints) {
    if (e.parameter.component != "truth" || !e.determined) continue;
    const double off = e.value - e.nominal, z = off / e.stderr_value;
    mounting.parameters.push_back({e.parameter.parameter, e.value, e.stderr_value, e.parameter.unit});
    if (std::abs(z) < kSigmasOfBias || std::abs(off) < e.parameter.least) continue;
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
}

void add_clock(const GeometryFit& geometry, const Vehicle& nominal, std::vector<Finding>& all) {
  constexpr double kLeast_s = 0.004;  // by joints, and by positions alone, a clock is not known better
  const Eigen::VectorXd error_s = Eigen::Map<const Eigen::VectorXd>(
      geometry.clock_stderr_s.data(), static_cast<Eigen::Index>(geometry.clock_stderr_s.size()));
  const SharedClock shared = shared_clock(geometry.clock_s, Eigen::MatrixXd(error_s.cwiseAbs2().asDiagonal()));
  const double z = shared.offset_s / shared.stderr_s;
  if (geometry.clock_s.empty() || std::abs(z) < kSigmasOfBias || std::abs(shared.offset_s) < kLeast_s) return;
  Finding clock;
  clock.effect = "truth_time_offset";
  clock.component = "truth";
  clock.parameters = {{"offset_s", nominal.truth.time_offset_s + shared.offset_s, shared.stderr_s, "s"}};
  clock.log_likelihood_gain = 0.5 * z * z;
  clock.p_value = chi_square_tail(z * z, 1);
  clock.sentence = "the truth's clock is off against the vehicle's";
  all.push_back(clock);
}

}  // namespace odolab
