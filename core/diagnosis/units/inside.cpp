#include "core/diagnosis/units/inside.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/calibration/linked.h"
#include "core/calibration/smoothed_readings.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/naming/select.h"
#include "core/diagnosis/units/component_names.h"
#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/merged.h"
#include "core/diagnosis/units/traces.h"
#include "core/diagnosis/units/unit_models.h"
#include "core/diagnosis/units/unit_recordings.h"
#include "core/odometry/cast.h"
#include "core/odometry/differential_drive.h"

namespace odolab {

namespace {

constexpr int kMostRounds = 3;  // units to blame, one after the other

// A recording as it is understood so far: without the effects of units that were blamed.
struct Understood {
  const Recording* recording = nullptr;
  std::vector<UnitSample> samples;
};

// What is known of the vehicle so far; its truth sits at the reference point.
struct Known {
  Vehicle vehicle;
  std::vector<DifferentialDrive> drives;
};

Track reckoned(const std::vector<UnitSample>& samples, std::size_t unit, const DifferentialDrive& drive) {
  std::vector<WheelSample> wheels;
  for (const UnitSample& s : samples) wheels.push_back({s.time_s, s.wheels[unit].left_rad, s.wheels[unit].right_rad});
  return dead_reckoned(wheels, drive, Pose{});
}

// The way of the vehicle's reference point by all units but one; of a platform by all where `without` is none of them.
Result<Track> reference(const Known& known, const std::vector<UnitSample>& samples, std::size_t without) {
  if (const auto* platform = std::get_if<MultiCastor>(&known.vehicle.kind)) {
    std::vector<CastorSample> readings;
    for (const UnitSample& s : samples) {
      CastorSample sample{s.time_s, {}};
      for (std::size_t k = 0; k < s.wheels.size(); ++k) sample.castors.push_back({s.wheels[k], s.joints[k]});
      readings.push_back(std::move(sample));
    }
    CastOptions options;
    options.left_out = without < known.drives.size() ? static_cast<int>(without) + 1 : 0;
    if (const std::string problem = problem_in(options, *platform); !problem.empty())
      return Error{known.vehicle.name, problem, "three castors or more, of which the others judge one"};
    return castor_track(readings, *platform, Pose{}, options);
  }
  const std::size_t by = without == 0 ? 1 : 0;
  Track track = reckoned(samples, by, known.drives[by]);
  for (std::size_t i = 0; i < track.size(); ++i)
    track[i].pose = track[i].pose * inverse(tracked_T_axle(known.vehicle, by, samples[i].joints));
  unwrap_headings(track);
  return track;
}

Vehicle without_mounting(Vehicle vehicle) {
  vehicle.truth = {};
  return vehicle;
}

std::vector<std::string> held_joints(const Vehicle& vehicle) {
  std::vector<std::string> held = {kClockHeld};
  for (const JointParameter& p : joint_parameters(vehicle))
    if (p.component == "truth") held.push_back(p.name);
  return held;
}

// A smart trailer is a truck B that is rigid up to the link's end: link angle zero, length constant.
Vehicle as_trucks(const Vehicle& vehicle) {
  Vehicle trucks = vehicle;
  if (const auto* train = std::get_if<SmartEncoderTrailer>(&vehicle.kind)) {
    Clapper clapper;
    clapper.truck_a = train->tow;
    clapper.truck_b = train->trailer;
    clapper.link_length_m = train->drawbar_length_m;
    clapper.link_angle_resolution_rad = train->hitch_angle_resolution_rad;
    clapper.link_length_resolution_m = 0.0;
    clapper.link_angle_a_offset_rad = train->hitch_angle_offset_rad;
    trucks.kind = clapper;
  }
  return trucks;
}

std::vector<LinkedSample> as_linked(const std::vector<UnitSample>& samples, const Vehicle& vehicle) {
  const auto* train = std::get_if<SmartEncoderTrailer>(&vehicle.kind);
  std::vector<LinkedSample> linked;
  for (const UnitSample& s : samples)
    linked.push_back({s.time_s, s.wheels[0], s.wheels[1], s.joints[0], train ? 0.0 : s.joints[1],
                      train ? train->drawbar_length_m : s.joints[2]});
  return linked;
}

// What wheels that are all larger or smaller than in the file by one share make of the link's length at most: from the
// inside lengths are shares of the wheels'.
double length_by_scale_m(const Vehicle& nominal) {
  constexpr double kScale = 0.03;  // as core/calibration/linked.cpp expects of a truck's wheels
  return kScale / (1.0 - kScale) * length_of_joint_m(nominal);
}

// The trucks' estimates in the words of the vehicle.
JointEstimate joint_from(const JointParameter& p, const InternalCalibration& calibration, const Vehicle& nominal) {
  const bool of_trailer = std::holds_alternative<SmartEncoderTrailer>(nominal.kind);
  const std::string name = !of_trailer                          ? p.name
                           : p.name == "hitch_angle_offset_rad" ? "link_angle_a_offset_rad"
                           : p.name == "drawbar_length_m"       ? "link_length_offset_m"
                                                                : "";
  JointEstimate estimate{p};
  Vehicle copy = nominal;
  estimate.nominal = estimate.value = p.of(copy);
  for (const ParameterEstimate& e : calibration.parameters) {
    if (e.name != name) continue;
    estimate.stderr_value = e.stderr_value;
    estimate.determined = e.determined;
    if (e.determined) estimate.value += (p.name == "drawbar_length_m" ? -1.0 : 1.0) * (e.value - e.nominal);
    if (e.name == "link_length_offset_m") estimate.feigned = length_by_scale_m(nominal);
  }
  return estimate;
}

// A pivot's bias comes out a twentieth small: of 15 mrad 0.7 were missing twice.
void widen_what_turns_lose(GeometryFit& fit) {
  constexpr double kLostInTurns = 0.05;
  for (JointEstimate& e : fit.joints)
    if (e.parameter.effect == "pivot_angle_bias" && e.determined)
      e.stderr_value = std::hypot(e.stderr_value, kLostInTurns * (e.value - e.nominal));
}

// All that is fitted from the inside.
std::vector<double*> parts_of(Known& known, const std::vector<JointParameter>& joints) {
  std::vector<double*> parts;
  for (const JointParameter& p : joints) parts.push_back(&p.of(known.vehicle));
  for (DifferentialDrive& d : known.drives)
    parts.insert(parts.end(), {&d.wheel_radius_left_m, &d.wheel_radius_right_m, &d.wheelbase_m});
  return parts;
}

Eigen::VectorXd numbers_of(Known& known, const std::vector<JointParameter>& joints) {
  const std::vector<double*> parts = parts_of(known, joints);
  Eigen::VectorXd x(static_cast<Eigen::Index>(parts.size()));
  for (Eigen::Index k = 0; k < x.size(); ++k) x(k) = *parts[static_cast<std::size_t>(k)];
  return x;
}

void set_numbers(Known& known, const std::vector<JointParameter>& joints, const Eigen::VectorXd& x) {
  const std::vector<double*> parts = parts_of(known, joints);
  for (Eigen::Index k = 0; k < x.size(); ++k) *parts[static_cast<std::size_t>(k)] = x(k);
  for (std::size_t u = 0; u < known.drives.size(); ++u) known.vehicle = with_drive(known.vehicle, u, known.drives[u]);
}

// The point that a slowly converging map leaves as it is, by what its last steps had in common (Anderson 1965).
class FixedPoint {
 public:
  Eigen::VectorXd next(const Eigen::VectorXd& at, const Eigen::VectorXd& to) {
    const Eigen::VectorXd step = to - at;
    Eigen::VectorXd x = to;
    if (last_step_.size() > 0) {
      constexpr std::size_t kMost = 5;
      if (changes_.size() == kMost) changes_.erase(changes_.begin());
      changes_.push_back({to - last_to_, step - last_step_});
      const auto m = static_cast<Eigen::Index>(changes_.size());
      Eigen::MatrixXd of_step(step.size(), m), of_to(step.size(), m);
      for (Eigen::Index k = 0; k < m; ++k) {
        of_to.col(k) = changes_[static_cast<std::size_t>(k)].of_to;
        of_step.col(k) = changes_[static_cast<std::size_t>(k)].of_step;
      }
      x -= of_to * of_step.colPivHouseholderQr().solve(step);
    }
    last_to_ = to;
    last_step_ = step;
    return x;
  }

 private:
  struct Change {
    Eigen::VectorXd of_to, of_step;
  };
  std::vector<Change> changes_;
  Eigen::VectorXd last_to_, last_step_;
};

// Joints and wheels by what the units contradict each other.
Result<GeometryFit> geometry_from_inside(const std::vector<Understood>& train, const Vehicle& nominal,
                                         const Progress& progress) {
  const Vehicle vehicle = without_mounting(nominal);
  const std::vector<VehicleUnit> units = units_of(vehicle);
  if (std::holds_alternative<MultiCastor>(vehicle.kind)) {
    Known known{vehicle, {}};
    for (const VehicleUnit& unit : units) known.drives.push_back(unit.drive);
    // The common way is that of wheels and pivots as they were believed to be: by turns, until both agree. What is
    // nearly common to all castors, as wheels that are all too small, moves by a tenth of its way in each.
    constexpr int kTurns = 14;
    constexpr double kAgree = 2e-6;  // m and rad
    const std::vector<JointParameter> joints = joint_parameters(vehicle);
    FixedPoint fixed;
    GeometryFit fit;
    for (int turn = 0; turn < kTurns; ++turn) {
      std::vector<JoinedRun> runs;
      for (const Understood& u : train) {
        const Result<Track> track = reference(known, u.samples, units.size());
        if (!track) return track.error();
        runs.push_back({u.samples, *track});
      }
      fit = fitted_geometry(runs, vehicle, held_joints(vehicle));
      Known then{fit.vehicle, fit.drives};
      const Eigen::VectorXd at = numbers_of(known, joints), to = numbers_of(then, joints);
      if ((to - at).cwiseAbs().maxCoeff() < kAgree) break;
      if (turn + 1 < kTurns) set_numbers(known, joints, fixed.next(at, to));
    }
    set_most_pivots_right(fit);
    fit.vehicle = without_mounting(fit.vehicle);
    widen_what_turns_lose(fit);
    return fit;
  }
  std::vector<Recording> recordings;
  for (const Understood& u : train) recordings.push_back(recording_of(as_linked(u.samples, vehicle)));
  const Result<InternalCalibration> calibration = calibrate_linked(recordings, as_trucks(vehicle), progress);
  if (!calibration) return calibration.error();
  GeometryFit fit;
  fit.vehicle = vehicle;
  for (const JointParameter& p : joint_parameters(vehicle)) {
    fit.joints.push_back(joint_from(p, *calibration, vehicle));
    if (fit.joints.back().determined) p.of(fit.vehicle) = fit.joints.back().value;
  }
  for (const VehicleUnit& unit : units_of(calibration->vehicle)) fit.drives.push_back(unit.drive);
  fit.clock_s.assign(train.size(), 0.0);
  fit.clock_stderr_s.assign(train.size(), 0.0);
  return fit;
}

// The recordings once the effects of a unit that is to blame are taken off its wheels; what it slips sideways is small
// beside and stays.
void take_off(std::vector<Understood>& all, std::size_t unit, const FittedModel& model,
              const std::vector<VehicleUnit>& units) {
  for (Understood& u : all) {
    InnovationRun run;
    for (const UnitSample& s : u.samples)
      run.wheels.push_back({s.time_s, s.wheels[unit].left_rad, s.wheels[unit].right_rad});
    run.smooth = smoothed(run.wheels);
    run.truth = {TruthSample{run.wheels.front().time_s, {}, 0.0}};
    std::vector<std::vector<BodyMotion>> motions(units.size());
    motions[unit] = motions_of(drive_view(0, run, std::get<DifferentialDrive>(model.vehicle.kind), false, {}),
                               model.effects_in(u.recording->name));
    u.samples = without_effects(u.samples, units, motions).samples;
  }
}

double gain_of(const Diagnosis& d) {
  double gain = 0.0;
  for (const Finding& f : d.findings) gain += f.effect == "unknown" ? 0.0 : f.log_likelihood_gain;
  return gain;
}

// What a unit can be blamed for: the rest is of the joints, of the truth that is none, or has no name.
void keep_names_of_wheels(Diagnosis& d, const VehicleUnit& unit, const JointRounding& rounding) {
  d.findings.erase(std::remove_if(d.findings.begin(), d.findings.end(),
                                  [&](const Finding& f) {
                                    return may_be_rounding(f, unit, rounding) || f.effect.rfind("truth_", 0) == 0 ||
                                           f.effect == "clock_rate" || f.effect == "floor_slope_creep" ||
                                           (f.effect == "wheel_toe" && !f.alternatives.empty() &&
                                            f.alternatives.front().effect == "truth_mounting_offset");
                                  }),
                   d.findings.end());
  if (d.findings.empty() && d.verdict != Verdict::cannot_say) d.verdict = Verdict::nothing_missing;
}

const std::vector<std::string>& common_effects() {
  static const std::vector<std::string> names = {"clock_rate",     "floor_slope_creep",     "truth_time_offset",
                                                 "truth_frozen",   "truth_mounting_offset", "speed_dependent_radius",
                                                 "turn_speed_loss"};
  return names;
}

struct Sets {
  std::vector<Understood> train, held_out;
};

// What each unit looks like beside the others.
struct Judged {
  GeometryFit geometry;
  std::vector<Diagnosis> units;  // as they were where they were not asked again
};

class Judge {
 public:
  Judge(const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress)
      : nominal_(nominal), units_(units_of(nominal)), options_(options), progress_(progress) {
    options_.family_wise_error /= static_cast<double>(units_.size());
  }

  // Asks every unit that is not set aside.
  Result<Judged> ask(const Sets& sets, std::vector<Diagnosis> before, const std::vector<char>& set_aside) const {
    Result<GeometryFit> fit = geometry_from_inside(sets.train, nominal_, progress_);
    if (!fit) return fit.error();
    Judged judged{std::move(*fit), std::move(before)};
    judged.units.resize(units_.size());
    Known known{judged.geometry.vehicle, judged.geometry.drives};
    for (std::size_t u = 0; u < units_.size(); ++u) known.vehicle = with_drive(known.vehicle, u, known.drives[u]);
    for (std::size_t u = 0; u < units_.size(); ++u) {
      if (set_aside[u]) continue;
      const Result<std::vector<Recording>> train = recordings_of(known, sets.train, u);
      const Result<std::vector<Recording>> held_out = recordings_of(known, sets.held_out, u);
      if (!train || !held_out) return train ? held_out.error() : train.error();
      Result<Diagnosis> one = judged_alone(*train, *held_out, u);
      if (!one) return Error{units_[u].name + ": " + one.error().where, one.error().found, one.error().expected};
      judged.units[u] = std::move(*one);
    }
    return judged;
  }

  Sets without(Sets sets, std::size_t unit, const Diagnosis& blamed_for) const {
    const FittedModel model = model_of(blamed_for);
    take_off(sets.train, unit, model, units_);
    take_off(sets.held_out, unit, model, units_);
    return sets;
  }

 private:
  static Result<std::vector<Recording>> recordings_of(const Known& known, const std::vector<Understood>& set,
                                                      std::size_t unit) {
    std::vector<Recording> own;
    for (const Understood& r : set) {
      const Result<Track> track = reference(known, r.samples, unit);
      if (!track) return track.error();
      own.push_back(recording_of_unit(*r.recording, r.samples, *track, known.vehicle, unit, 0.0, true));
    }
    return own;
  }

  Result<Diagnosis> judged_alone(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                 std::size_t u) const {
    Vehicle own = vehicle_of_unit(units_[u], without_mounting(nominal_));
    own.kind = units_[u].drive;
    Result<Diagnosis> one = diagnose(train, held_out, own, options_, progress_);
    if (!one) return one;
    leave_out_standing(*one, train, units_[u].drive);
    leave_out_traces(*one, std::holds_alternative<MultiCastor>(nominal_.kind));
    keep_names_of_wheels(*one, units_[u], rounding_from_inside(nominal_));
    return one;
  }

  Vehicle nominal_;
  std::vector<VehicleUnit> units_;
  DiagnosisOptions options_;
  Progress progress_;
};

// Against a unit that errs all others contradict, and hardly in a way that is one of their own: the one whose effects
// explain most is to blame. Where others come near, the one without whose effects the rest is most in order.
struct Blame {
  std::size_t unit = 0;
  bool either = false;  // what is left does not tell which of two
};

Result<std::optional<Blame>> unit_to_blame(const Judge& judge, const Sets& sets, const Judged& judged,
                                           const std::vector<char>& set_aside) {
  std::vector<std::size_t> suspects;
  for (std::size_t u = 0; u < judged.units.size(); ++u)
    if (!set_aside[u] && gain_of(judged.units[u]) > 0.0) suspects.push_back(u);
  if (suspects.empty()) return std::optional<Blame>();
  std::sort(suspects.begin(), suspects.end(),
            [&](std::size_t a, std::size_t b) { return gain_of(judged.units[a]) > gain_of(judged.units[b]); });
  constexpr double kNear = 0.5;  // of the largest gain; of two units either may look worse
  const double most = gain_of(judged.units[suspects[0]]);
  if (judged.units.size() > 2)
    while (gain_of(judged.units[suspects.back()]) < kNear * most) suspects.pop_back();
  if (suspects.size() < 2) return std::optional<Blame>(Blame{suspects[0]});
  std::vector<double> left;
  for (std::size_t suspect : suspects) {
    std::vector<char> aside = set_aside;
    aside[suspect] = 1;
    const Result<Judged> then = judge.ask(judge.without(sets, suspect, judged.units[suspect]), judged.units, aside);
    if (!then) return then.error();
    left.push_back(0.0);
    for (std::size_t u = 0; u < judged.units.size(); ++u)
      if (!aside[u]) left.back() += gain_of(then->units[u]);
  }
  const std::size_t best = static_cast<std::size_t>(std::min_element(left.begin(), left.end()) - left.begin());
  const bool either = left.size() == 2 && std::abs(left[0] - left[1]) < kClearlyBeaten;
  return std::optional<Blame>(Blame{suspects[best], either});
}

}  // namespace

Result<Diagnosis> diagnose_inside(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                  const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress) {
  const std::vector<VehicleUnit> units = units_of(nominal);
  Sets sets;
  for (const Recording& r : train) sets.train.push_back({&r, unit_samples(r, nominal)});
  for (const Recording& r : held_out) sets.held_out.push_back({&r, unit_samples(r, nominal)});
  const Judge judge(nominal, options, [&](double) { return goes_on(progress, 0.5); });

  std::vector<char> blamed(units.size(), 0);
  std::vector<Alternative> instead;  // of the first unit to blame
  Result<Judged> judged = judge.ask(sets, {}, blamed);
  for (int round = 0; round < kMostRounds && judged; ++round) {
    const Result<std::optional<Blame>> blame = unit_to_blame(judge, sets, *judged, blamed);
    if (!blame) return blame.error();
    if (!*blame) break;
    const std::size_t unit = (*blame)->unit;
    for (std::size_t u = 0; (*blame)->either && round == 0 && u < units.size(); ++u)
      for (const Finding& f : judged->units[u].findings)
        if (u != unit)
          instead.push_back(
              {f.effect, component_of_unit(units[u].name, f.component), f.log_likelihood_gain, "an outside truth"});
    blamed[unit] = 1;
    sets = judge.without(std::move(sets), unit, judged->units[unit]);
    judged = judge.ask(sets, judged->units, blamed);
  }
  if (!judged) return judged.error();

  Diagnosis d = merged(judged->units, judged->geometry, nominal, train, false);
  if (!instead.empty() && !d.findings.empty()) {
    d.findings.front().alternatives.insert(d.findings.front().alternatives.end(), instead.begin(), instead.end());
    d.verdict = Verdict::ambiguous;
  }
  const auto is_common = [](const NotTestable& n) {
    return std::find(common_effects().begin(), common_effects().end(), n.effect) != common_effects().end();
  };
  d.not_testable.erase(std::remove_if(d.not_testable.begin(), d.not_testable.end(), is_common), d.not_testable.end());
  for (const std::string& name : common_effects())
    d.not_testable.push_back({name, "without an outside truth what all units do alike does not show between them",
                              "the same with an outside truth that has headings"});
  d.warnings.insert(d.warnings.begin(),
                    "no outside truth with headings, a sample a second or more: the units were judged against each "
                    "other; their scale, and what they all do alike, is not seen");
  return d;
}

}  // namespace odolab
