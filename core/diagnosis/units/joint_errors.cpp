#include "core/diagnosis/units/joint_errors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/quantile.h"
#include "core/diagnosis/units/axle_put_off.h"
#include "core/diagnosis/units/joint_shapes.h"
#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

// Of one recording: what a joint that reads too much by one puts the axle off by, and functions of what happens there.
struct OfRun {
  AxlePutOff off;
  std::vector<std::vector<double>> values;  // [function][sample]
  std::vector<AxlePutOff> times;            // [function]: one by the other
};
using OfRuns = std::map<std::string, OfRun>;

std::vector<int> joints_of(const Vehicle& vehicle, std::size_t unit) {
  if (std::holds_alternative<MultiCastor>(vehicle.kind)) return {static_cast<int>(unit)};
  std::vector<int> all;
  for (std::size_t j = 0; j < joint_steps(vehicle).size(); ++j) all.push_back(static_cast<int>(j));
  return all;
}

// By how much a length is read otherwise, half a second on, than the wheels of both units at its ends make it: by what
// they slip. Robust, root mean square.
double moved_by_slip_m(const std::vector<std::vector<UnitSample>>& samples, const Vehicle& vehicle, std::size_t joint) {
  constexpr double kOn_s = 0.5;
  std::vector<double> off_m;
  for (const std::vector<UnitSample>& of_run : samples) {
    const Track a = way_of(of_run, 0, units_of(vehicle)[0].drive), b = way_of(of_run, 1, units_of(vehicle)[1].drive);
    const auto apart_m = [&](std::size_t i) { return of_run[i].joints[joint]; };
    for (std::size_t i = 0, k = 0; i < of_run.size(); i = k) {
      for (k = i + 1; k < of_run.size() && of_run[k].time_s < of_run[i].time_s + kOn_s; ++k) continue;
      if (k >= of_run.size()) break;
      const double from_s = of_run[i].time_s, to_s = of_run[k].time_s;
      const Pose a_T_b =
          between(tracked_T_axle(vehicle, 0, of_run[i].joints), tracked_T_axle(vehicle, 1, of_run[i].joints));
      const Pose then = inverse(between(*pose_at(a, from_s), *pose_at(a, to_s))) * a_T_b *
                        between(*pose_at(b, from_s), *pose_at(b, to_s));
      off_m.push_back(length(then.position()) - length(a_T_b.position()) - (apart_m(k) - apart_m(i)));
    }
  }
  return scatter_about_zero(std::move(off_m));
}

// Of what a joint reads, about its mean.
double scatter_of(const std::vector<std::vector<UnitSample>>& samples, std::size_t joint) {
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (const std::vector<UnitSample>& of_run : samples)
    for (const UnitSample& s : of_run) n += 1.0, sum += s.joints[joint], squares += s.joints[joint] * s.joints[joint];
  return std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)));
}

// Change for each second of a number of the samples, over a sixth of one to both sides.
std::vector<double> rates_of_number(const std::vector<UnitSample>& samples,
                                    const std::function<double(const UnitSample&)>& number) {
  constexpr double kAside_s = 0.15;
  std::vector<double> rates;
  std::size_t a = 0, b = 0;
  for (const UnitSample& s : samples) {
    while (samples[a].time_s < s.time_s - kAside_s) ++a;
    while (b + 1 < samples.size() && samples[b].time_s < s.time_s + kAside_s) ++b;
    const double lasts_s = samples[b].time_s - samples[a].time_s;
    rates.push_back(lasts_s > 0.0 ? (number(samples[b]) - number(samples[a])) / lasts_s : 0.0);
  }
  return rates;
}

// v times omega of a unit, m/s2.
std::vector<double> pulled_aside(const std::vector<UnitSample>& samples, std::size_t unit,
                                 const DifferentialDrive& drive) {
  const std::vector<double> left =
                                rates_of_number(samples, [&](const UnitSample&s) { return s.wheels[unit].left_rad; }),
                            right =
                                rates_of_number(samples, [&](const UnitSample&s) { return s.wheels[unit].right_rad; });
  std::vector<double> pulled;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double l = drive.wheel_radius_left_m * left[i], r = drive.wheel_radius_right_m * right[i];
    pulled.push_back(0.5 * (l + r) * (r - l) / drive.wheelbase_m);
  }
  return pulled;
}

std::vector<Motions> motions_by_joint(const DriveView& view, const OfRuns& runs, std::size_t functions) {
  std::vector<Motions> out(functions);
  const auto run = runs.find(view.recording);
  if (run == runs.end()) return out;
  for (std::size_t f = 0; f < functions; ++f) {
    const AxlePutOff& off = run->second.times[f];
    for (const EffectStep& s : view.steps)
      out[f].push_back(off.moved(s.time_s, s.duration_s, s.forward_m(), s.turn_rad));
  }
  return out;
}

void multiply(OfRun& run) {
  for (const std::vector<double>& of_function : run.values) {
    AxlePutOff product = run.off;
    for (std::size_t i = 0; i < product.by.size(); ++i) {
      Pose& by = product.by[i];
      by = {of_function[i] * by.x_m, of_function[i] * by.y_m, of_function[i] * by.heading_rad};
    }
    run.times.push_back(std::move(product));
  }
}

// Root mean square of what amplitudes come to over all samples, about its mean: that would be a bias.
double size_of_amplitudes(const OfRuns& runs, const std::vector<double>& value) {
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (const auto& [name, run] : runs)
    for (std::size_t i = 0; i < run.off.time_s.size(); ++i) {
      double error = 0.0;
      for (std::size_t f = 0; f < value.size(); ++f) error += value[f] * run.values[f][i];
      n += 1.0, sum += error, squares += error * error;
    }
  return std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)));
}

TruthError error_of(OfRuns runs, const JointName& joint, const std::string& variable, double least) {
  const std::size_t functions = runs.begin()->second.values.size();
  for (auto& [name, run] : runs) multiply(run);
  const auto shared = std::make_shared<const OfRuns>(std::move(runs));
  TruthError error;
  error.component = joint.component;
  error.channel = "error of the encoder of " + joint.words;
  error.variable = variable;
  auto term = std::make_shared<Effect>();
  term->name = error.variable;
  term->component = error.channel;
  term->amplitudes.resize(functions);
  term->motions = [shared, functions](const DriveView& view, const std::vector<double>&) {
    return motions_by_joint(view, *shared, functions);
  };
  error.term = std::move(term);
  error.is_more_than_rounding = [shared, least](const std::vector<double>& value) {
    return size_of_amplitudes(*shared, value) > least;
  };
  return error;
}

GenericCurve curve_over_reading(const ReadingRange& range, const JointName& joint) {
  constexpr int kPoints = 41;
  const double low = range.first(), high = range.last();
  GenericCurve curve;
  curve.variable = joint.words + " [" + joint.unit + "]";
  curve.channel = "error of " + joint.words + " [" + joint.unit + "]";
  for (int i = 0; i < kPoints; ++i) {
    curve.at.push_back(low + (high - low) * i / (kPoints - 1.0));
    curve.basis.push_back(waves_of_reading(curve.at.back(), range));
  }
  return curve;
}

}  // namespace

bool is_of_floor_or_truth(const Finding& f) {
  return f.effect == "unknown" && (f.component == "floor" || f.component == "truth");
}

bool is_of_a_joint(const Finding& f) {
  const bool is_of_a_wheel = f.component == component_of(Wheel::left) || f.component == component_of(Wheel::right);
  return f.effect == "unknown" && f.component != "vehicle" && !is_of_a_wheel && !is_of_floor_or_truth(f);
}

JointName name_of_joint(const Vehicle& vehicle, std::size_t joint) {
  std::vector<JointParameter> biases;  // one for each joint, in their order
  for (JointParameter& p : joint_parameters(vehicle))
    if (!p.effect.empty() && p.component != "truth") biases.push_back(std::move(p));
  const JointParameter& own = biases[joint];
  return {own.effect == "pivot_angle_bias" ? "the pivot of " + part_words(own.component)
                                           : "the " + parameter_words(own.name.substr(0, own.name.rfind("_offset"))),
          own.component, own.unit};
}

std::shared_ptr<const std::vector<TruthError>> joint_errors(const std::vector<std::vector<UnitSample>>& samples,
                                                            const std::vector<std::string>& names,
                                                            const Vehicle& vehicle, std::size_t unit) {
  const VehicleUnit own = units_of(vehicle)[unit];
  if (own.carries_truth || std::set<std::string>(names.begin(), names.end()).size() != names.size()) return nullptr;
  if (std::any_of(samples.begin(), samples.end(), [](const auto& of_run) { return of_run.size() < 3; })) return nullptr;
  // An encoder that stands as it stood before, in each bend and after each turn, is rounded as before: by up to 0.29 of
  // a step.
  constexpr double kSteps = 0.5;
  constexpr double kLeastRange = 4.0;    // steps
  constexpr double kReadLate_s = 0.004;  // by so much and more
  // A length that goes to and fro by what the wheels slip errs with it, where an error of its encoder is asked for.
  constexpr double kBeyondSlip = 5.0;
  const std::vector<double> steps = joint_steps(vehicle);
  auto errors = std::make_shared<std::vector<TruthError>>();
  for (const int joint : joints_of(vehicle, unit)) {
    const auto j = static_cast<std::size_t>(joint);
    const JointName name = name_of_joint(vehicle, j);
    ReadingRange range;
    range.is_length = name.unit == "m";
    for (const auto& of_run : samples) range.take_in(of_run, j);
    if (range.high - range.low < std::max(kLeastRange * steps[j], 1e-4)) continue;
    const double slip_m = range.is_length ? moved_by_slip_m(samples, vehicle, j) : 0.0;
    if (scatter_of(samples, j) < kBeyondSlip * slip_m) continue;

    OfRuns bare;
    for (std::size_t r = 0; r < samples.size(); ++r)
      bare[names[r]].off = axle_put_off(samples[r], vehicle, unit,
                                        [j](Vehicle&, std::vector<double>& joints, double by) { joints[j] += by; });
    const auto with = [&](const std::function<std::vector<std::vector<double>>(const std::vector<UnitSample>&)>& of) {
      OfRuns runs = bare;
      for (std::size_t r = 0; r < samples.size(); ++r) runs[names[r]].values = of(samples[r]);
      return runs;
    };
    const OfRuns by_reading = with([&](const std::vector<UnitSample>& of_run) {
      std::vector<std::vector<double>> values(2 * kWavesOfReading);
      for (const double reading : mean_readings(of_run, j)) {
        const std::vector<double> at = waves_of_reading(reading, range);
        for (std::size_t k = 0; k < at.size(); ++k) values[k].push_back(at[k]);
      }
      return values;
    });
    errors->push_back(error_of(by_reading, name, kWhatItReads, kSteps * steps[j]));
    errors->back().is_of_a_length = range.is_length;
    errors->back().curves = {curve_over_reading(range, name)};
    const auto add = [&](const char* variable,
                         const std::function<std::vector<double>(const std::vector<UnitSample>&)>& of) {
      const OfRuns runs =
          with([&](const std::vector<UnitSample>& of_run) { return std::vector<std::vector<double>>{of(of_run)}; });
      // Wheels that push and pull a link slip to the one side as it grows and to the other as it shrinks.
      errors->push_back(error_of(runs, name, variable, std::max(kSteps * steps[j], slip_m)));
    };
    add("which way it went last", [&](const auto& of_run) { return ways_of_reading(of_run, j, steps[j]); });
    if (range.is_length) continue;
    add("how fast it turns [rad/s]",
        [&](const auto& of_run) { return rates_of_number(of_run, [&](const UnitSample& s) { return s.joints[j]; }); });
    // By so many seconds it is read late; where the truth's clock is fitted a little off, so is every joint.
    errors->back().is_more_than_rounding =
        [rounding = errors->back().is_more_than_rounding](const std::vector<double>& value) {
          return std::abs(value[0]) > kReadLate_s && rounding(value);
        };
    add("lateral acceleration [m/s2]", [&](const auto& of_run) { return pulled_aside(of_run, unit, own.drive); });
  }
  return errors;
}

}  // namespace odolab
