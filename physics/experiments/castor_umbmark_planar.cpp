// Multi-castor paper, section IV.B, where wheels can slip: machines that are not as drawn turn six wheels that
// contradict each other, which kinematics cannot know.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/io/number_text.h"
#include "core/odometry/cast.h"
#include "physics/experiments/castor_prototype.h"
#include "physics/experiments/spread.h"
#include "physics/simulation.h"

namespace odolab {

namespace {

constexpr int kPlanarMethods = 3;
constexpr const char* kPlanarMethodNames[kPlanarMethods] = {"IPEC-1", "CAST-1", "CAST-0"};

CastOptions planar_options(int method) {
  CastOptions options;
  options.method = method == 0 ? CastorMethod::ipec : CastorMethod::cast;
  options.left_out = method == 2 ? 0 : 1;
  return options;
}

struct Driven {
  std::array<double, kPlanarMethods> kinematic_m{}, planar_m{}, believed_right_m{};  // Emax by method
  double slip_m = 0.0;  // of the first castor's left wheel along its way, mean of both directions
};

Scenario square_of(const MultiCastor& nominal, const MultiCastor& actual, bool clockwise) {
  Scenario scenario;
  scenario.vehicle.kind = nominal;
  scenario.machine.lengths = actual;
  scenario.path = SquarePath{1.5, clockwise};
  scenario.driving.speed_mps = 0.33;
  scenario.driving.turn_rate_radps = 0.75;
  scenario.sensors.encoder_period_s = 0.050;
  scenario.sensors.truth_period_s = 0.0;
  return scenario;
}

// By the nominal parameters on both grounds; and in the planar world by the exact ones.
Driven drive_machine(const MultiCastor& nominal, std::uint64_t seed, const std::atomic<bool>& stopped) {
  const MultiCastor actual = drawn_castor_machine(nominal, seed, false);
  Driven driven;
  for (const bool clockwise : {false, true}) {
    const CastorRun exact = castor_run(actual, castor_square(clockwise));
    const std::vector<CastorSample> kinematic = rounded(exact.exact, actual, mixed(seed));
    const Scenario scenario = square_of(nominal, actual, clockwise);
    Simulation simulation(scenario, seed);
    const double longest_s = 3.0 * simulation.expected_duration_s();
    while (!simulation.state().finished && simulation.state().time_s < longest_s && !stopped) {
      simulation.step();
      driven.slip_m += 0.5 * std::abs(simulation.state().left.slip_speed_mps) * scenario.step_s;
    }
    const std::vector<CastorSample> planar = castor_samples(simulation.recording(), nominal.castors.size());
    const Vec2 end = simulation.true_track().back().pose.position();
    for (std::size_t m = 0; m < kPlanarMethods; ++m) {
      const CastOptions options = planar_options(static_cast<int>(m));
      const auto gap_m = [&](const std::vector<CastorSample>& samples, const MultiCastor& believed, Vec2 truth) {
        return length(castor_track(samples, believed, {}, options).back().pose.position() - truth);
      };
      driven.kinematic_m[m] = std::max(driven.kinematic_m[m], gap_m(kinematic, nominal, exact.end.position()));
      driven.planar_m[m] = std::max(driven.planar_m[m], gap_m(planar, nominal, end));
      driven.believed_right_m[m] = std::max(driven.believed_right_m[m], gap_m(planar, actual, end));
    }
  }
  return driven;
}

Result<ExperimentReport> run_castor_umbmark_planar(const ExperimentOptions& options, const Progress& progress) {
  const int machines = options.cases > 0 ? options.cases : 20;
  const MultiCastor nominal = assumed_castor_prototype();
  std::vector<Driven> driven(static_cast<std::size_t>(machines));
  const int done = parallel_for(
      machines,
      [&](int i, const std::atomic<bool>& stopped) {
        driven[static_cast<std::size_t>(i)] =
            drive_machine(nominal, seed_of_stream(options.seed, static_cast<std::uint64_t>(i)), stopped);
      },
      {}, progress);
  ExperimentReport report;
  if (done < machines) return report;  // stopped

  const double published_mm[kPlanarMethods] = {394.6, 394.1, 311.0};
  std::array<double, kPlanarMethods> kinematic_mm{}, planar_mm{}, exact_mm{};
  std::vector<double> slip_mm;
  for (const Driven& d : driven) slip_mm.push_back(1e3 * d.slip_m);
  for (std::size_t m = 0; m < kPlanarMethods; ++m) {
    std::vector<double> kinematic, planar, exact;
    for (const Driven& d : driven) {
      kinematic.push_back(1e3 * d.kinematic_m[m]);
      planar.push_back(1e3 * d.planar_m[m]);
      exact.push_back(1e3 * d.believed_right_m[m]);
    }
    const std::string name = std::string("Emax ") + kPlanarMethodNames[m];
    report.figures.push_back(figure_of(name + ", as built, kinematics", "mm", kinematic, published_mm[m]));
    report.figures.push_back(figure_of(name + ", as built, planar physics", "mm", planar, published_mm[m]));
    report.figures.push_back(figure_of(name + ", exact parameters, planar physics", "mm", exact));
    kinematic_mm[m] = mean_and_spread(kinematic).mean;
    planar_mm[m] = mean_and_spread(planar).mean;
    exact_mm[m] = mean_and_spread(exact).mean;
  }
  report.figures.push_back(figure_of("slip of one wheel on a square", "mm", slip_mm));
  const double third = planar_mm[2] / planar_mm[1];
  report.claims = {
      {.sentence = "the third castor takes off a fifth before calibration, where wheels can slip too",
       .holds = third < 0.85,
       .because =
           "three castors leave " + number_text("%.2f", third) + " of two castors' error, by kinematics " +
           number_text("%.2f", kinematic_mm[2] / kinematic_mm[1]) + ". " +
           number_text("%.0f", mean_and_spread(slip_mm).mean) +
           " mm of slip of a wheel on each square are no castor's parameter: with the exact ones CAST-0 is still " +
           number_text("%.0f", exact_mm[2]) + " mm off",
       .explained = kinematic_mm[2] < 0.85 * kinematic_mm[1] && exact_mm[2] > 0.25 * planar_mm[2]},
      {.sentence = "least squares on two castors is nearly IPEC",
       .holds = std::abs(planar_mm[0] / planar_mm[1] - 1.0) < 0.1,
       .because = "they differ by " + number_text("%.1f", 100.0 * std::abs(planar_mm[0] / planar_mm[1] - 1.0)) + " %"}};
  report.assumptions = {castor_prototype_assumption(),
                        "wheels driven at the speeds of the nominal geometry by the LabMate's motors (8 N m), on a "
                        "floor of friction 0.8; "
                        "parameters off as in castor-umbmark; one square each way"};
  report.notes = {
      "Wheels of machines that are not as drawn contradict each other through the rigid frame and slip, which "
      "kinematics does not know. Motors without limits that turn exactly as told give the same within a tenth of the "
      "spread (seed 1: 361, 361 and 379 mm as built): a speed controller's integral lets no wheel lag for long."};
  return report;
}

}  // namespace

Experiment castor_umbmark_planar() {
  return {"castor-umbmark-planar", "the castor vehicle's square where wheels can slip",
          "Multi-castor paper (Doebbler et al. 2008), section IV.B", run_castor_umbmark_planar};
}

}  // namespace odolab
