#include "core/diagnosis/units/beside_truth.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/formatted.h"
#include "core/calibration/frozen_truth.h"
#include "core/diagnosis/by_names.h"
#include "core/diagnosis/units/errors_of_lengths.h"
#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/heading_of_way.h"
#include "core/diagnosis/units/joined_clocks.h"
#include "core/diagnosis/units/joint_errors.h"
#include "core/diagnosis/units/joint_residuals.h"
#include "core/diagnosis/units/joints_by_all.h"
#include "core/diagnosis/units/lone_bias.h"
#include "core/diagnosis/units/mended_counts.h"
#include "core/diagnosis/units/merged.h"
#include "core/diagnosis/units/merged_asked.h"
#include "core/diagnosis/units/merged_findings.h"
#include "core/diagnosis/units/outside_truth.h"
#include "core/diagnosis/units/together/told_together.h"
#include "core/diagnosis/units/told_geometry.h"
#include "core/diagnosis/units/traces.h"
#include "core/diagnosis/units/unit_recordings.h"

namespace odolab {

namespace {

// A biased encoder must be so in runs that it was not fitted on. `right`: encoders that are known to be.
void prove_biases(Diagnosis& d, const std::vector<JoinedRun>& runs, const GeometryFit& geometry, const Vehicle& nominal,
                  const std::vector<std::string>& right) {
  for (const JointEstimate& e : geometry.joints) {
    const auto f = std::find_if(d.findings.begin(), d.findings.end(), [&](const Finding& g) {
      return e.is_of_an_encoder() && g.effect == e.parameter.effect && g.component == e.parameter.component;
    });
    if (f == d.findings.end() || runs.size() < 2 || e.is_from_inside) continue;
    const double ratio = left_out_ratio(runs, nominal, e.parameter.name, right);
    if (ratio < 1.0) {
      const char* words = ratio < 0.95 ? "; what the parts contradict in runs left out falls to %.0f %%"
                                       : "; what the parts contradict in runs left out falls to %.2f %%";
      f->sentence += formatted(words, 100.0 * ratio);
    } else {
      d.findings.erase(f);
    }
  }
}

// Other encoders that alone would do nearly as well.
void add_instead(const LoneBias& lone, const GeometryFit& geometry, Diagnosis& d) {
  const JointParameter& named = geometry.joints[lone.joint].parameter;
  for (Finding& f : d.findings) {
    if (f.effect != named.effect || f.component != named.component) continue;
    for (const LoneBias::Instead& other : lone.instead) {
      const JointParameter& p = geometry.joints[other.joint].parameter;
      f.alternatives.push_back({p.effect, p.component, 0.5 * other.gain,
                                "tight bends to both sides: wide ones show how the encoders differ, and of neither "
                                "which is off"});
    }
  }
}

// How the truth's heading is mounted on a vehicle that tows, and whose wheels are not looked at: known by the way it
// goes, and the hitch's encoder no better than that.
GeometryFit geometry_of_trailer(const std::vector<JoinedRun>& runs, const Vehicle& nominal) {
  constexpr double kUnknown_rad = 0.05, kLeast_rad = 0.001;
  std::vector<Track> tracked;
  for (const JoinedRun& run : runs) tracked.push_back(run.tracked);
  const std::optional<HeadingOfWay> way = heading_of_way(tracked);
  JointEstimate heading;
  heading.parameter = {"truth_mounting.heading_rad",
                       "rad",
                       kUnknown_rad,
                       [](Vehicle& v) -> double& { return v.truth.axle_T_tracked.heading_rad; },
                       "truth_mounting_offset",
                       "truth",
                       kLeast_rad,
                       "heading_rad"};
  heading.nominal = heading.value = nominal.truth.axle_T_tracked.heading_rad;
  Vehicle turned = nominal;
  if (way && std::abs(way->mounting_rad - heading.nominal) > std::max(kLeast_rad, kSigmasOfBias * way->stderr_rad)) {
    heading.value = turned.truth.axle_T_tracked.heading_rad = way->mounting_rad;
    heading.stderr_value = way->stderr_rad;
    heading.determined = true;
  }
  GeometryFit geometry = fitted_geometry(runs, turned);
  const double of_heading_rad = way ? way->stderr_rad : kUnknown_rad;
  for (std::size_t k = 0; k < geometry.joints.size(); ++k) {
    JointEstimate& e = geometry.joints[k];
    if (e.parameter.name != "hitch_angle_offset_rad") continue;
    e.stderr_value = std::hypot(e.stderr_value, of_heading_rad);
    const auto c = static_cast<Eigen::Index>(k);
    if (c < geometry.covariance.rows()) geometry.covariance(c, c) += of_heading_rad * of_heading_rad;
  }
  geometry.joints.push_back(heading);
  return geometry;
}

// Of a truth that no unit's own recording has as it was: by the first unit's wheels, whether it repeats itself.
std::vector<Finding> frozen_truths(const std::vector<Recording>& recordings, const std::vector<JoinedRun>& runs,
                                   const DifferentialDrive& first, double truth_late_s) {
  std::vector<Finding> frozen;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    DataFault fault{"truth_frozen", "truth", recordings[r].name,
                    frozen_truth(truth_samples(recordings[r]), wheels_of(runs[r].samples, 0), first, truth_late_s), ""};
    if (fault.time_s.empty()) continue;
    fault.sentence = in_words_of_frozen(fault.time_s.size());
    frozen.push_back(finding_of(fault));
  }
  return frozen;
}

using Read = std::vector<std::vector<UnitSample>>;  // of each recording

Read samples_read(std::vector<Understood> all) {
  Read read;
  for (Understood& u : all) read.push_back(std::move(u.samples));
  return read;
}

// Where the truth sits, and its clocks, as the unit that carries it knows them: better than stretches of half a metre
// do.
void put_truth_as_on(const Diagnosis& carrying, const Vehicle& nominal, GeometryFit& geometry) {
  const LeastSquaresCalibration& known = carrying.calibration;
  geometry.vehicle.truth.axle_T_tracked = known.vehicle.truth.axle_T_tracked;
  for (std::size_t r = 0; r < std::min(geometry.clock_s.size(), known.time_offset_s.size()); ++r)
    geometry.clock_s[r] = known.time_offset_s[r] - nominal.truth.time_offset_s;
}

JoinedRun joined_run(const Recording& r, const Vehicle& nominal) {
  MendedCounts mended = with_mended_counts(unit_samples(r, nominal), nominal);
  JoinedRun run{std::move(mended.samples), tracked_poses(r), true, std::move(mended.guessed)};
  if (!comes_often(run.tracked))
    run.tracked = few_poses(std::move(run.tracked), run.samples, nominal.truth.time_offset_s);
  return run;
}

// Recordings of one sort, fitted on or held out.
struct Set {
  const std::vector<Recording>& recordings;
  std::vector<JoinedRun> runs;
  Read as_read;
  std::vector<double> clock_s;  // the truth's offset in each, on top of the vehicle's
};

Set set_of(const std::vector<Recording>& recordings, const Vehicle& nominal) {
  Set set{recordings, {}, {}, {}};
  for (const Recording& r : recordings) {
    set.runs.push_back(joined_run(r, nominal));
    set.as_read.push_back(unit_samples(r, nominal));
  }
  return set;
}

class BesideTruth {
 public:
  BesideTruth(const std::vector<Recording>& train, const std::vector<Recording>& held_out, const Vehicle& nominal,
              const DiagnosisOptions& options, const Progress& progress)
      : nominal_(nominal),
        options_(options),
        progress_(progress),
        units_(units_of(nominal)),
        is_towed_(std::holds_alternative<EncoderTrailer>(nominal.kind)),
        is_followed_(outside_truth(train, held_out) == OutsideTruth::poses),
        train_(set_of(train, nominal)),
        held_out_(set_of(held_out, nominal)) {
    for (const Set* set : {&train_, &held_out_})
      for (const Recording& r : set->recordings) names_.push_back(r.name);
  }

  Result<Diagnosis> diagnosed() {
    const Error stopped{"diagnosis", "stopped before its end", ""};
    fit_geometry();
    if (!goes_on(progress_, 0.1)) return stopped;
    tell_together();
    if (const std::optional<Error> error = judge_each()) return *error;
    if (told_)
      if (const std::optional<Error> error = judge_beside_names()) return *error;
    if (!goes_on(progress_, 0.9)) return stopped;
    if (!told_ && is_followed_ && may_be_joined())
      if (const std::optional<Error> error = tell_joints_and_judge_by_them()) return *error;
    if (!goes_on(progress_, 0.95)) return stopped;
    return put_together();
  }

 private:
  void fit_geometry() {
    const auto fitted = [&] {
      return is_towed_ ? geometry_of_trailer(train_.runs, nominal_) : fitted_geometry(train_.runs, nominal_);
    };
    geometry_ = is_followed_ ? fitted() : geometry_of_file(nominal_, train_.runs.size());
    if (!carries_truth(units_) && is_followed_) clocks_ = put_clocks_right(train_.runs, nominal_, geometry_);
    if (is_towed_ && !clocks_.empty()) geometry_ = fitted();
    put_clocks_right_as(clocks_, held_out_.runs, nominal_, geometry_);
    for (const Set* set : {&train_, &held_out_})
      for (const JoinedRun& run : set->runs) samples_.push_back(run.samples);
    set_most_pivots_right(geometry_);
    for (const JoinedRun& run : held_out_.runs)
      held_out_.clock_s.push_back(is_followed_ ? fitted_geometry({run}, geometry_.vehicle).clock_s.front() : 0.0);
  }

  void tell_together() {
    if (!may_be_joined() || !may_be_coarse(train_.runs)) return;
    told_ = told_together(train_.runs, nominal_, geometry_.clock_s, names_of_train(), options_.family_wise_error,
                          [&](double share) { return goes_on(progress_, 0.1 * share); });
    if (told_) take_biases(told_->model, nominal_, geometry_);
  }

  bool may_be_joined() const { return units_.size() > 1 && units_.size() <= kMostJoinedUnits; }

  std::vector<std::string> names_of_train() const {
    return {names_.begin(), names_.begin() + static_cast<std::ptrdiff_t>(train_.runs.size())};
  }

  std::vector<Recording> own_of(const Set& set, const Read& read, const std::vector<double>& clock_s,
                                std::size_t unit) const {
    std::vector<Recording> own;
    for (std::size_t r = 0; r < set.runs.size(); ++r)
      own.push_back(recording_of_unit(set.recordings[r], read[r], set.runs[r].tracked, geometry_.vehicle, unit,
                                      clock_s[r], !units_[unit].carries_truth));
    return own;
  }

  Result<Diagnosis> judged(std::size_t unit, const Read& read, const Read& read_held_out, const Progress& part) const {
    const std::vector<Recording> own = own_of(train_, read, geometry_.clock_s, unit),
                                 own_held_out = own_of(held_out_, read_held_out, held_out_.clock_s, unit);
    DiagnosisOptions of_one = options_;
    of_one.family_wise_error /= static_cast<double>(units_.size());
    Vehicle fitted = geometry_.vehicle;
    for (std::size_t u = 0; u < units_.size(); ++u) fitted = with_drive(fitted, u, geometry_.drives[u]);
    of_one.truth_errors = joint_errors(samples_, names_, fitted, unit);
    Result<Diagnosis> one = diagnose(own, own_held_out, vehicle_of_unit(units_[unit], nominal_), of_one, part);
    if (!one) return Error{units_[unit].name + ": " + one.error().where, one.error().found, one.error().expected};
    const bool castor = std::holds_alternative<MultiCastor>(nominal_.kind);
    if (!units_[unit].carries_truth && has_a_name_beside_a_trace(*one, castor)) {
      Result<Diagnosis> named =
          diagnose_by_names(own, own_held_out, vehicle_of_unit(units_[unit], nominal_), of_one, part);
      if (named && !named->findings.empty()) {
        one = std::move(named);
        one->warnings.push_back(kTraceBesideAName);
      }
    }
    if (!units_[unit].carries_truth) {
      const bool is_carried = carries_truth(units_) && !diagnoses_.empty();
      const UncertainLengths lengths =
          uncertain_lengths(geometry_, is_carried ? &diagnoses_.front().calibration : nullptr);
      for (LeastSquaresCalibration Diagnosis::*which : {&Diagnosis::calibration, &Diagnosis::calibration_alone})
        add_errors_of_lengths(own, read, fitted, unit, lengths, (*one).*which);
    }
    leave_out_standing(*one, own, units_[unit].drive);
    if (!units_[unit].carries_truth) leave_out_traces(*one, castor);
    return one;
  }

  std::optional<Error> judge_each() {
    for (std::size_t u = 0; u < units_.size(); ++u) {
      Result<Diagnosis> one = judged(u, train_.as_read, held_out_.as_read, [&](double share) {
        return goes_on(progress_, 0.1 + 0.8 * (static_cast<double>(u) + share) / static_cast<double>(units_.size()));
      });
      if (!one) return one.error();
      if (!units_[u].carries_truth && !told_ && is_followed_) look_for_erring_joint(*one, u);
      diagnoses_.push_back(std::move(*one));
      if (units_[u].carries_truth) put_truth_as_on(diagnoses_.back(), nominal_, geometry_);
    }
    return std::nullopt;
  }

  void look_for_erring_joint(const Diagnosis& one, std::size_t unit) {
    const auto& calibrated = std::get<DifferentialDrive>(one.calibration_alone.vehicle.kind);
    std::optional<ErringJoint> of_unit =
        erring_joint(train_.runs, geometry_.clock_s, with_drive(geometry_.vehicle, unit, calibrated), unit);
    if (of_unit && (!erring_ || of_unit->gain > erring_->gain)) erring_ = std::move(of_unit);
  }

  // The geometry by stretches knew of nothing that is missing, and has taken up what it could of it: all of it, where
  // nothing was named beside it. Then it is asked what would be named if the file were right about the joints; that
  // must stay when these are told beside it.
  std::optional<Error> tell_joints_and_judge_by_them() {
    if (!carries_truth(units_) || acts_on_a_carried_unit()) return judge_until_joints_stay();
    const GeometryFit by_stretches = geometry_;
    const std::vector<Diagnosis> by_these = diagnoses_;
    const std::optional<ErringJoint> erring = erring_;
    for (JointEstimate& e : geometry_.joints)
      if (e.parameter.component != "truth") e.parameter.of(geometry_.vehicle) = e.value = e.nominal;
    if (const std::optional<Error> error = judge_carried_anew()) return error;
    if (acts_on_a_carried_unit())
      if (const std::optional<Error> error = judge_until_joints_stay()) return error;
    if (acts_on_a_carried_unit()) return std::nullopt;
    geometry_ = by_stretches;
    diagnoses_ = by_these;
    erring_ = erring;
    return judge_until_joints_stay();
  }

  // Told beside what was named, the joints are what units whose truth they tell are judged by anew, until they stay
  // where they are.
  std::optional<Error> judge_until_joints_stay() {
    constexpr int kMostRounds = 4;
    for (int round = 0;; ++round) {
      const std::vector<JointEstimate> judged_by = geometry_.joints;
      ToldByAll told = tell_joints_by_all(train_.runs, train_.recordings, names_of_train(), diagnoses_, nominal_,
                                          options_.family_wise_error, geometry_);
      of_joint_ = std::move(told.erring);
      const bool is_beside_names = carries_truth(units_) && act_on_motion(diagnoses_);
      if (round == kMostRounds || !is_beside_names || !have_moved(judged_by)) {
        for (std::size_t u = 0; u < units_.size() && is_beside_names; ++u)
          if (!units_[u].carries_truth) put_sizes(told.sizes, u, diagnoses_[u].findings);
        return std::nullopt;
      }
      if (const std::optional<Error> error = judge_carried_anew()) return error;
    }
  }

  std::optional<Error> judge_carried_anew() {
    erring_.reset();
    for (std::size_t u = 0; u < units_.size(); ++u) {
      if (units_[u].carries_truth) continue;
      Result<Diagnosis> again =
          judged(u, train_.as_read, held_out_.as_read, [&](double) { return goes_on(progress_, 0.9); });
      if (!again) return again.error();
      look_for_erring_joint(*again, u);
      diagnoses_[u] = std::move(*again);
    }
    return std::nullopt;
  }

  bool acts_on_a_carried_unit() const {
    for (std::size_t u = 0; u < units_.size(); ++u)
      if (!units_[u].carries_truth && act_on_motion({diagnoses_[u]})) return true;
    return false;
  }

  // By more than they are known to.
  bool have_moved(const std::vector<JointEstimate>& before) const {
    for (std::size_t k = 0; k < before.size(); ++k) {
      const JointEstimate& e = geometry_.joints[k];
      if (e.parameter.component != "truth" && std::abs(e.value - before[k].value) > e.stderr_value) return true;
    }
    return false;
  }

  // Once more, without what all of them together name.
  std::optional<Error> judge_beside_names() {
    const Read without =
        samples_read(understood_without(*told_, train_.recordings, train_.runs, geometry_.clock_s, nominal_));
    const Read held_out_without =
        samples_read(understood_without(*told_, held_out_.recordings, held_out_.runs, held_out_.clock_s, nominal_));
    for (std::size_t u = 0; u < units_.size(); ++u) {
      if (!acts_on(*told_, u)) {
        diagnoses_[u] = with_names(*told_, u, diagnoses_[u], diagnoses_[u]);
        continue;
      }
      Result<Diagnosis> again = judged(u, without, held_out_without, [&](double) { return goes_on(progress_, 0.9); });
      if (!again) return again.error();
      diagnoses_[u] = with_names(*told_, u, diagnoses_[u], std::move(*again));
    }
    return std::nullopt;
  }

  // One encoder that is off is simpler than several, of which none may be known well.
  std::optional<LoneBias> hold_right_encoders() {
    std::optional<LoneBias> lone = lone_bias(geometry_);
    if (!lone || std::abs(lone->off) < kSigmasOfBias * lone->stderr_value) return std::nullopt;
    const auto put = [&](JointEstimate& e, double value) { e.parameter.of(geometry_.vehicle) = e.value = value; };
    JointEstimate& off = geometry_.joints[lone->joint];
    put(off, off.nominal + lone->off);
    off.stderr_value = lone->stderr_value;
    for (JointEstimate& other : geometry_.joints)
      if (std::find(lone->others.begin(), lone->others.end(), other.parameter.name) != lone->others.end())
        put(other, other.nominal);
    if (std::holds_alternative<MultiCastor>(nominal_.kind)) turn_about_body(geometry_, lone->turned_rad);
    return lone;
  }

  Diagnosis put_together() {
    const std::optional<LoneBias> lone = hold_right_encoders();
    Diagnosis d = merged(diagnoses_, geometry_, nominal_, train_.recordings);
    Vehicle as_mounted = nominal_;
    if (is_towed_) as_mounted.truth.axle_T_tracked.heading_rad = geometry_.vehicle.truth.axle_T_tracked.heading_rad;
    prove_biases(d, train_.runs, geometry_, as_mounted, lone ? lone->others : std::vector<std::string>{});
    if (lone) add_instead(*lone, geometry_, d);
    if (told_) put_names_into(*told_, d);
    if (erring_ && std::none_of(d.findings.begin(), d.findings.end(), is_of_a_joint)) {
      add_erring_joint(*erring_, nominal_, d);
      leave_out_biases_beside_erring_joints(d.findings);
    }
    if (of_joint_ && std::none_of(d.findings.begin(), d.findings.end(), is_of_a_joint)) {
      d.findings.insert(d.findings.begin(), *of_joint_);
      if (!leave_out_small_rest(d.findings)) leave_out_biases_beside_erring_joints(d.findings);
    }
    if (!clocks_.empty()) {
      std::erase_if(d.findings, [](const Finding& f) { return f.effect == "clock_rate"; });
      d.findings.push_back(finding_of(clocks_));
    }
    if (!carries_truth(units_)) {
      const std::vector<Finding> frozen =
          frozen_truths(train_.recordings, train_.runs, units_[0].drive, nominal_.truth.time_offset_s);
      d.findings.insert(d.findings.end(), frozen.begin(), frozen.end());
    }
    // What one unit by itself cannot say all of them together may.
    d.verdict = verdict_by(d.findings, any_cannot_say(diagnoses_) && !(told_ && !d.cannot_judge));
    mark_named(d);
    return d;
  }

  const Vehicle& nominal_;
  const DiagnosisOptions& options_;
  const Progress& progress_;
  std::vector<VehicleUnit> units_;
  bool is_towed_, is_followed_;  // by the truth, and not by poses at both ends alone
  Set train_, held_out_;
  std::vector<std::string> names_;  // of both sets, and what all units read in them, mended
  Read samples_;
  GeometryFit geometry_;
  std::vector<ClockRate> clocks_;
  std::optional<ToldTogether> told_;
  std::vector<Diagnosis> diagnoses_;  // of each unit
  std::optional<ErringJoint> erring_;
  std::optional<Finding> of_joint_;  // an encoder that errs otherwise than by a bias
};

}  // namespace

Result<Diagnosis> diagnose_beside_truth(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                        const Vehicle& nominal, const DiagnosisOptions& options,
                                        const Progress& progress) {
  return BesideTruth(train, held_out, nominal, options, progress).diagnosed();
}

}  // namespace odolab
