#include "core/diagnosis/units/merged.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/diagnosis/measurement_findings.h"
#include "core/diagnosis/units/merged_asked.h"
#include "core/diagnosis/units/merged_calibration.h"
#include "core/diagnosis/units/merged_findings.h"
#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

FitTable joined_table(const std::vector<Diagnosis>& diagnoses, FitTable Diagnosis::*table) {
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

std::vector<NotTestable> not_testable_in(const std::vector<Diagnosis>& diagnoses,
                                         const std::vector<VehicleUnit>& units) {
  std::vector<NotTestable> all;
  for (std::size_t u = 0; u < diagnoses.size(); ++u)
    for (const NotTestable& n : diagnoses[u].not_testable) {
      if (std::any_of(all.begin(), all.end(), [&](const NotTestable& m) { return m.effect == n.effect; })) continue;
      all.push_back(
          {n.effect, units[u].name.empty() ? n.because : part_words(units[u].name) + ": " + n.because, n.drive_this});
    }
  return all;
}

// What the joints say of a unit's way is on the encoders' clock.
void put_onto_truths_clock(Residuals& r, const std::vector<std::pair<std::string, double>>& late_s) {
  for (const auto& [recording, by_s] : late_s)
    if (recording == r.recording)
      for (double& t : r.time_s) t += by_s;
}

}  // namespace

bool any_cannot_say(const std::vector<Diagnosis>& diagnoses) {
  return std::any_of(diagnoses.begin(), diagnoses.end(),
                     [](const Diagnosis& d) { return d.verdict == Verdict::cannot_say; });
}

std::string said_of_unit(const std::string& warning, const VehicleUnit& unit, OutsideTruth truth) {
  if (unit.name.empty()) return warning;
  if (unit.carries_truth || warning.find("truth") == std::string::npos) return part_words(unit.name) + ": " + warning;
  return part_words(unit.name) +
         (truth == OutsideTruth::poses ? " (its truth is told through the joints): "
                                       : " (its truth is the way of the other units, through the joints): ") +
         warning;
}

Verdict verdict_by(const std::vector<Finding>& findings, bool cannot_say) {
  const auto any = [&](const auto& is) { return std::any_of(findings.begin(), findings.end(), is); };
  if (any([](const Finding& f) { return f.effect == "unknown"; })) return Verdict::unknown_effect;
  if (any([](const Finding& f) { return !f.alternatives.empty(); })) return Verdict::ambiguous;
  if (!findings.empty()) return Verdict::found;
  return cannot_say ? Verdict::cannot_say : Verdict::nothing_missing;
}

Diagnosis merged(const std::vector<Diagnosis>& diagnoses, const GeometryFit& geometry, const Vehicle& nominal,
                 const std::vector<Recording>& recordings, OutsideTruth truth) {
  const bool from_outside = truth == OutsideTruth::poses || truth == OutsideTruth::positions;
  std::vector<VehicleUnit> units = units_of(nominal);
  for (VehicleUnit& unit : units) unit.carries_truth = unit.carries_truth && from_outside;
  Diagnosis d;
  d.calibration = merged_calibration(diagnoses, &Diagnosis::calibration, geometry, units, nominal);
  d.calibration_alone = merged_calibration(diagnoses, &Diagnosis::calibration_alone, geometry, units, nominal);
  std::vector<std::pair<std::string, double>> by_geometry;  // by how much the truth's clock is late in each
  for (std::size_t r = 0; r < recordings.size(); ++r)
    by_geometry.emplace_back(recordings[r].name, nominal.truth.time_offset_s + geometry.clock_s[r]);
  bool truth_is_carried = false;
  Vehicle fitted = geometry.vehicle;
  for (std::size_t u = 0; u < units.size(); ++u) {
    const Diagnosis& one = diagnoses[u];
    const Vehicle& own = one.fitted_vehicle ? *one.fitted_vehicle : one.calibration.vehicle;
    fitted = with_drive(fitted, u, std::get<DifferentialDrive>(own.kind));
    move_aside(fitted, u, axle_aside(one.calibration, geometry, u).moved_m);
    if (units[u].carries_truth) {
      fitted.truth = own.truth;
      d.truth_clock_s = one.truth_clock_s;
      truth_is_carried = true;
    }
    add_findings_of(one, units[u], rounding_of_joints(nominal, u), d.findings);
    const std::string of = units[u].name.empty() ? "" : part_words(units[u].name) + ": ";
    for (const std::string& w : one.warnings) d.warnings.push_back(said_of_unit(w, units[u], truth));
    // What has no name is drawn first.
    auto next = one.verdict == Verdict::unknown_effect ? d.responses.begin() : d.responses.end();
    for (Response r : one.responses) {
      r.channel = of + r.channel;
      next = d.responses.insert(next, std::move(r)) + 1;
    }
    for (std::vector<Residuals> Diagnosis::*residuals : {&Diagnosis::residuals_before, &Diagnosis::residuals_after})
      for (Residuals r : one.*residuals) {
        if (!units[u].carries_truth) put_onto_truths_clock(r, by_geometry);
        if (!units[u].name.empty()) r.recording += ", " + units[u].name;
        (d.*residuals).push_back(std::move(r));
      }
    for (const JudgedPart& part : one.judged) {
      const auto whole = std::find_if(d.judged.begin(), d.judged.end(),
                                      [&](const JudgedPart& w) { return w.recording == part.recording; });
      if (whole == d.judged.end())
        d.judged.push_back(part);
      else
        whole->way_unknown_s.insert(whole->way_unknown_s.end(), part.way_unknown_s.begin(), part.way_unknown_s.end());
    }
    d.left_out_in_turn = d.left_out_in_turn || one.left_out_in_turn;
    if (one.unseen_gain) d.unseen_gain = d.unseen_gain.value_or(0.0) + *one.unseen_gain;
    if (!one.next_drive.empty() && (d.next_drive.empty() || one.verdict == Verdict::ambiguous)) {
      d.next_drive = one.next_drive;
      d.next_legs = one.next_legs;
    }
  }
  d.fitted_vehicle = fitted;
  // The truth shows a unit's turned axle beside the joints as they were while its recordings were made.
  for (const JointEstimate& e : geometry.joints)
    if (e.is_from_inside)
      std::erase_if(d.findings, [&](const Finding& f) {
        return f.effect == e.parameter.effect && f.component == e.parameter.component;
      });
  put_events_into_their_zones(d.findings);
  put_pushes_together(d.findings, units);
  if (!truth_is_carried && truth != OutsideTruth::nothing) add_mounting(geometry, nominal, d.findings);
  if (!truth_is_carried && from_outside) add_clock(geometry, nominal, d.findings);
  if (!truth_is_carried) d.truth_clock_s = by_geometry;
  if (truth == OutsideTruth::nothing)
    d.fitted_vehicle->truth = d.calibration.vehicle.truth = d.calibration_alone.vehicle.truth = nominal.truth;
  for (std::string& sentence : add_biases(geometry, units, d.findings)) d.warnings.push_back(std::move(sentence));
  leave_out_biases_beside_erring_joints(d.findings);
  if (leave_out_small_rest(d.findings))
    d.warnings.push_back("beside the names given something small is left that no name describes");
  put_in_order(d.findings);
  d.cannot_judge = std::any_of(diagnoses.begin(), diagnoses.end(), std::mem_fn(&Diagnosis::cannot_judge));
  d.verdict = verdict_by(d.findings, any_cannot_say(diagnoses));
  d.train = joined_table(diagnoses, &Diagnosis::train);
  d.held_out = joined_table(diagnoses, &Diagnosis::held_out);
  d.not_testable = not_testable_in(diagnoses, units);
  d.asked = merged_asked(diagnoses, geometry, units);
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
  return d;
}

}  // namespace odolab
