// Multi-castor paper, section IV.A and Table I: the geometric calibration on 1000 random machines.
#include <array>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/io/number_text.h"
#include "physics/experiments/castor_prototype.h"
#include "physics/experiments/experiment.h"

namespace odolab {

namespace {

// Mean absolute errors of one vehicle's parameters: r_c, r_w, d and the mean of a castor's two d in per cent, beta in
// degrees.
enum Error_ { kOffset, kRadius, kWheelOffset, kMeanWheelOffset, kBeta, kErrors };
using CalibrationErrors = std::array<double, kErrors>;

CalibrationErrors errors_of(const MultiCastor& believed, const MultiCastor& actual) {
  CalibrationErrors e{};
  const double n = static_cast<double>(actual.castors.size());
  const auto percent = [](double is, double should) { return 100.0 * std::abs(is / should - 1.0); };
  for (std::size_t c = 0; c < actual.castors.size(); ++c) {
    const Castor &is = believed.castors[c], &should = actual.castors[c];
    e[kOffset] += percent(is.offset_m, should.offset_m) / n;
    e[kRadius] += (percent(is.wheel_radius_left_m, should.wheel_radius_left_m) +
                   percent(is.wheel_radius_right_m, should.wheel_radius_right_m)) /
                  (2.0 * n);
    e[kWheelOffset] += (percent(is.wheel_offset_left_m, should.wheel_offset_left_m) +
                        percent(is.wheel_offset_right_m, should.wheel_offset_right_m)) /
                       (2.0 * n);
    e[kMeanWheelOffset] += percent(is.track_m(), should.track_m()) / n;
    e[kBeta] += degrees(std::abs(wrapped(is.pivot_encoder_offset_rad - should.pivot_encoder_offset_rad))) / n;
  }
  return e;
}

struct Outcome {
  std::vector<CalibrationErrors> before, after;
  double mean(const std::vector<CalibrationErrors>& all, int which) const {
    double sum = 0.0;
    for (const CalibrationErrors& e : all) sum += e[static_cast<std::size_t>(which)];
    return all.empty() ? 0.0 : sum / static_cast<double>(all.size());
  }
  double spread(const std::vector<CalibrationErrors>& all, int which) const {
    const double middle = mean(all, which);
    double sum = 0.0;
    for (const CalibrationErrors& e : all)
      sum += (e[static_cast<std::size_t>(which)] - middle) * (e[static_cast<std::size_t>(which)] - middle);
    return all.size() < 2 ? 0.0 : std::sqrt(sum / static_cast<double>(all.size() - 1));
  }
};

Outcome calibrate_many(const MultiCastor& nominal, double sweep_rad, int sets, std::uint64_t seed,
                       const Progress& progress) {
  Outcome outcome;
  outcome.before.resize(static_cast<std::size_t>(sets));
  outcome.after = outcome.before;
  const int done = parallel_for(
      sets,
      [&](int i) {
        const std::uint64_t of_set = seed_of_stream(seed, static_cast<std::uint64_t>(i));
        const MultiCastor actual = drawn_castor_machine(nominal, of_set, true);
        const std::vector<Revolution> runs = calibration_revolutions(actual, nominal, sweep_rad, mixed(of_set));
        outcome.before[static_cast<std::size_t>(i)] = errors_of(nominal, actual);
        outcome.after[static_cast<std::size_t>(i)] = errors_of(calibrated_castors(runs, nominal), actual);
      },
      {}, progress);
  outcome.before.resize(static_cast<std::size_t>(done));
  outcome.after.resize(static_cast<std::size_t>(done));
  return outcome;
}

constexpr double kSweep_deg = 90.0;
constexpr const char* kErrorNames[kErrors] = {"r_c", "r_w", "d", "mean d of a castor", "beta"};

Result<ExperimentReport> run_castor_calibration(const ExperimentOptions& options, const Progress& progress) {
  const int sets = options.cases > 0 ? options.cases : 1000;
  const MultiCastor nominal = assumed_castor_prototype();
  const Outcome main = calibrate_many(nominal, radians(kSweep_deg), sets, options.seed,
                                      [&](double share) { return goes_on(progress, 0.6 * share); });
  ExperimentReport report;
  const std::optional<double> before[kErrors] = {0.21, 2.07, 0.89, {}, 7.98},
                              after[kErrors] = {0.09, 0.04, 0.04, {}, 0.01};
  for (const bool calibrated : {false, true})
    for (int k = 0; k < kErrors; ++k) {
      const std::optional<double>& published = (calibrated ? after : before)[k];
      report.figures.push_back(
          {.name = std::string("mean error of ") + kErrorNames[k] + (calibrated ? ", calibrated" : ", as built"),
           .unit = k == kBeta ? "degrees" : "%",
           .published_low = published,
           .published_high = published,
           .ours = main.mean(calibrated ? main.after : main.before, k),
           .ours_spread = main.spread(calibrated ? main.after : main.before, k),
           .seeds = static_cast<int>(main.after.size())});
    }

  // What the calibrated errors hang on: how far the vehicle turns, and r_c against the pivots' distance.
  ResultTable table{"calibrated mean errors by sweep and geometry",
                    {"sweep", "r_c / D", "r_c %", "r_w %", "d %", "mean d %", "beta degrees"},
                    {}};
  MultiCastor long_castors = nominal;
  for (Castor& castor : long_castors.castors) castor.offset_m = 0.18 * std::sqrt(3.0) * castor.pivot_radius_m;
  double offset_of_long = 0.0, wheel_offset_of_long_sweep = 0.0, radius_of_long_sweep = 0.0;
  int done = 0;
  for (const MultiCastor& vehicle : {nominal, long_castors})
    for (const double sweep_deg : {30.0, 90.0, 330.0}) {
      const Outcome o =
          calibrate_many(vehicle, radians(sweep_deg), std::max(3, sets / 25), options.seed + 1,
                         [&](double share) { return goes_on(progress, 0.6 + 0.4 * (done + share) / 6.0); });
      ++done;
      if (o.after.empty()) return report;  // stopped
      const Castor& c = vehicle.castors.front();
      std::vector<std::string> row{number_text("%.0f degrees", sweep_deg),
                                   number_text("%.2f", c.offset_m / (std::sqrt(3.0) * c.pivot_radius_m))};
      for (int k = 0; k < kErrors; ++k) row.push_back(number_text(k == kBeta ? "%.4f" : "%.3f", o.mean(o.after, k)));
      table.rows.push_back(row);
      if (table.rows.size() == 3) {  // the assumed prototype and the longest sweep
        wheel_offset_of_long_sweep = o.mean(o.after, kWheelOffset);
        radius_of_long_sweep = o.mean(o.after, kRadius);
      }
      if (table.rows.size() > 3 && sweep_deg == kSweep_deg) offset_of_long = o.mean(o.after, kOffset);
    }
  report.tables = {table};

  // A published figure has two decimals: it may be half of the last one larger.
  const auto reached = [&](int k, double published) { return main.mean(main.after, k) < published + 0.005; };
  const auto said = [&](int k) { return number_text("%.3f", main.mean(main.after, k)); };
  report.claims = {
      {.sentence = "r_c is calibrated to 0.09 %",
       .holds = reached(kOffset, 0.09),
       .because = said(kOffset) + " % with r_c = 0.12 D; with r_c = 0.18 D it is " +
                  number_text("%.3f", offset_of_long) +
                  " %: by Eq. 3 the error is D cos(Gamma) times that of Gamma, which is the pivot encoder's",
       .explained = offset_of_long < 0.095},
      {.sentence = "r_w is calibrated to 0.04 %",
       .holds = reached(kRadius, 0.04),
       .because = said(kRadius) + " % after sweeps of " + number_text("%.0f", kSweep_deg) + " degrees"},
      {.sentence = "d is calibrated to 0.04 %",
       .holds = reached(kWheelOffset, 0.04),
       .because =
           said(kWheelOffset) + " % for each wheel's d and " + said(kMeanWheelOffset) +
           " % for the mean of a castor's two: by Eqs. 4 to 7 a radius's error enters d times D cos(Gamma) / d, " +
           number_text("%.1f", std::sqrt(3.0) * 0.24 / 0.05) + " here. Sweeps of 330 degrees reach " +
           number_text("%.3f", wheel_offset_of_long_sweep) + " %, and then r_w has " +
           number_text("%.3f", radius_of_long_sweep) + " %: both at 0.04 % belong to no one sweep",
       .explained = wheel_offset_of_long_sweep < 0.045},
      {.sentence = "beta is calibrated to 0.01 degrees",
       .holds = reached(kBeta, 0.01),
       .because = said(kBeta) + " degrees"},
  };
  report.assumptions = {castor_prototype_assumption(),
                        "errors as built are uniform, with Table I's means; the encoders are the prototype's",
                        "kinematics: no wheel slips; sweeps of " + number_text("%.0f", kSweep_deg) +
                            " degrees once the castors have come round, read at 20 Hz"};
  report.notes = {"the figures as built are the paper's by construction; those after calibration are found"};
  return report;
}

}  // namespace

Experiment castor_calibration() {
  return {"castor-calibration", "three castors calibrated by their own encoders, 1000 machines",
          "multi-castor paper, section IV.A, Table I", run_castor_calibration};
}

}  // namespace odolab
