// CLAPPER paper, section 3: the heading error that the link's encoders show against the one that a bump really makes.
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/io/number_text.h"
#include "core/odometry/ipec.h"
#include "physics/experiments/clapper_runs.h"
#include "physics/experiments/spread.h"
#include "physics/ground.h"

namespace odolab {

namespace {

constexpr double kHeight_m = 0.010, kRadius_m = 0.075;

struct Shown {
  double actual_rad = 0.0;    // that truck A's dead reckoning lost
  double measured_rad = 0.0;  // that internal correction gave back
};

// One bump under truck A's right wheel; and one under truck B's at the same time. Encoders without steps, so that the
// geometry alone is looked at.
Shown over_bumps(bool under_both, double at_m, std::uint64_t seed) {
  Scenario scenario = report_clapper(StraightPath{1.0, false}, false);
  Clapper trucks;
  trucks.truck_a.encoder_counts_per_revolution = trucks.truck_b.encoder_counts_per_revolution = 1e12;
  trucks.link_angle_resolution_rad = trucks.link_length_resolution_m = 0.0;
  scenario.vehicle.kind = trucks;
  scenario.step_s = 0.00025;
  scenario.floor.bumps.push_back({{at_m, 0.0}, 0.5 * kPi, 2.0, kHeight_m, Under::right_wheel});  // B stops before it
  if (under_both) scenario.floor.bumps.push_back({{at_m - 1.0, 0.0}, 0.5 * kPi, 2.0, kHeight_m, Under::right_wheel});
  Simulation simulation(scenario, seed);
  run_to_end(simulation, 60.0);
  const double lost_rad = simulation.state().estimated_pose.heading_rad - simulation.state().true_pose.heading_rad;
  double corrected_rad = 0.0;
  for (const IpecState& state : ipec(linked_samples(simulation.recording()), trucks, {}))
    corrected_rad -= state.correction_a_rad;
  return {lost_rad, corrected_rad};
}

Result<ExperimentReport> run_clapper_bump(const ExperimentOptions& options, const Progress& progress) {
  const int seeds = options.cases > 0 ? options.cases : 8;
  std::vector<Shown> shown(static_cast<std::size_t>(2 * seeds));
  const int jobs = static_cast<int>(shown.size());
  const int done = parallel_for(
      jobs,
      [&](int i) {
        // Where in a sampling interval the bump begins differs from run to run.
        const std::uint64_t seed = seed_of_stream(options.seed, static_cast<std::uint64_t>(i));
        const double at_m = 0.5 + 0.018 * uniform_from_hash(mixed(seed));
        shown[static_cast<std::size_t>(i)] = over_bumps(i >= seeds, at_m, seed);
      },
      {}, progress);
  ExperimentReport report;
  if (done < jobs) return report;

  std::vector<double> actual_deg, off_one, off_two;
  for (int i = 0; i < jobs; ++i) {
    const Shown& s = shown[static_cast<std::size_t>(i)];
    if (i < seeds) actual_deg.push_back(degrees(s.actual_rad));
    (i < seeds ? off_one : off_two).push_back(100.0 * std::abs(s.measured_rad / s.actual_rad - 1.0));
  }
  const double lost_mm = 1e3 * extra_roll_m(kRadius_m, kHeight_m);
  report.figures = {{.name = "travel lost on a bump of 10 mm",
                     .unit = "mm",
                     .published_low = 2.63,
                     .published_high = 2.63,
                     .ours = lost_mm},
                    figure_of("heading lost on it", "degrees", actual_deg, 0.44, 0.60),
                    figure_of("measured against actual, a bump under truck A", "%", off_one, 0.0, 4.5),
                    figure_of("measured against actual, a bump under each truck", "%", off_two, 0.0, 4.5)};
  const double one = mean_and_spread(off_one).mean, two = mean_and_spread(off_two).mean;
  const double ours_deg = mean_and_spread(actual_deg).mean;
  report.claims = {
      {.sentence = "the measured heading error is within 4.5 % of the actual one for one truck on a bump",
       .holds = one < 4.5,
       .because = number_text("%.1f", one) + " % off"},
      {.sentence = "and within as much where both trucks are",
       .holds = two < 4.5,
       .because = number_text("%.1f", two) + " % off"},
      {.sentence = "a bump of 10 mm takes 2.63 mm of travel and 0.44 degrees",
       .holds = std::abs(ours_deg - 0.44) < 0.03,
       .because = "a wheel of 75 mm that rolls over the top of a 10 mm object turns " + number_text("%.2f", lost_mm) +
                  " mm further than it travels, " + number_text("%.2f", ours_deg) +
                  " degrees in the run and 0.6 degrees in the same paper's own measurement (section 6.1)",
       .explained = std::abs(ours_deg - 0.6) < 0.05},
  };
  report.assumptions = {report_clapper_assumptions(), "encoders without steps"};
  return report;
}

}  // namespace

Experiment clapper_bump() {
  return {"clapper-bump", "what the link's encoders see of a bump", "CLAPPER paper (Borenstein 1995), section 3",
          run_clapper_bump};
}

}  // namespace odolab
