#include <cmath>

#include "app/cli/run/outputs.h"
#include "app/cli/terminal.h"
#include "core/io/picture/line_picture.h"
#include "core/io/picture/track_picture.h"
#include "core/odometry/cast_rejection.h"
#include "physics/simulation.h"

namespace odolab {

namespace {

// How far the believed pose is from the true one, over time.
std::string gap_picture(const Track& believed, const Track& exact) {
  DrawnLine position{"position gap [mm]", {}, {}, Look::estimate},
      heading{"heading gap [0.1 degrees]", {}, {}, Look::second};
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const Pose gap = between(exact[i].pose, believed[i].pose);
    position.x.push_back(exact[i].time_s);
    position.y.push_back(1e3 * length(gap.position()));
    heading.x.push_back(exact[i].time_s);
    heading.y.push_back(10.0 * degrees(std::abs(gap.heading_rad)));
  }
  return line_picture({"How far the robot is from where it believes to be", "time [s]", "gap", {position, heading}});
}

// What three castors or more make of the run when the one that contradicts the others is disregarded.
void add_outvoted(RunOutputs& out, const Simulation& simulation, const Scenario& scenario) {
  const auto* vehicle = std::get_if<MultiCastor>(&scenario.vehicle.kind);
  if (!vehicle || vehicle->castors.size() < 3) return;
  const std::vector<CastorSample> samples = castor_samples(simulation.recording(), vehicle->castors.size());
  const RejectingTrack rejecting = castor_track_with_rejection(samples, *vehicle, scenario.start);
  if (rejecting.track.empty()) return;
  const Pose gap = between(simulation.state().true_pose, rejecting.track.back().pose);
  out.figure("outvoted_end_position_error_m", length(gap.position()));
  out.figure("outvoted_end_heading_error_rad", std::abs(wrapped(gap.heading_rad)));
  double disregarded_s = 0.0;
  for (const DisregardedCastor& d : rejecting.disregarded) disregarded_s += d.to_s - d.from_s;
  out.sentences.push_back(
      text_of("With the castor disregarded that contradicts the others (%.1f s in all) it is %.1f mm and %.2f degrees.",
              disregarded_s, 1e3 * length(gap.position()), degrees(std::abs(wrapped(gap.heading_rad)))));
}

}  // namespace

Result<RunOutputs> drive_outputs(const Scenario& scenario, std::uint64_t seed, const Progress& progress) {
  Simulation simulation(scenario, seed);
  const double duration_s = simulation.expected_duration_s();
  constexpr double kPatience = 3.0;  // a robot that has lost its way never arrives
  for (int k = 0; !simulation.state().finished && simulation.state().time_s < kPatience * duration_s; ++k) {
    simulation.step();
    if (k % 2000 == 0 && !goes_on(progress, std::min(1.0, simulation.state().time_s / duration_s)))
      return Error{scenario.name, "a run stopped by its user", "a run to the end"};
  }
  goes_on(progress, 1.0);

  const Track &exact = simulation.true_track(), &believed = simulation.estimated_track();
  RunOutputs out;
  const Pose gap = between(simulation.state().true_pose, simulation.state().estimated_pose);
  out.figure("duration_s", simulation.state().time_s);
  out.figure("finished", simulation.state().finished ? 1.0 : 0.0);
  out.figure("distance_m", travelled_m(exact));
  out.figure("end_position_error_m", length(gap.position()));
  out.figure("end_heading_error_rad", std::abs(wrapped(gap.heading_rad)));
  if (const auto error = track_error(believed, exact)) {
    out.figure("largest_position_error_m", error->largest_position_m);
    out.figure("position_rms_m", error->position_rms_m);
    out.figure("heading_rms_rad", error->heading_rms_rad);
  }
  const Pose& end = simulation.state().true_pose;
  out.figure("end_x_m", end.x_m);
  out.figure("end_y_m", end.y_m);
  out.figure("end_heading_rad", end.heading_rad);
  if (!simulation.state().finished)
    out.sentences.push_back("The robot did not arrive: it was given up after three times the planned time.");
  const auto whole = track_error(believed, exact);
  out.sentences.push_back(text_of(
      "The robot drove %.2f m in %.1f s. In the end it is %.1f mm and %.2f degrees from where it believes to be; on "
      "the way it was up to %.1f mm.",
      travelled_m(exact), simulation.state().time_s, 1e3 * length(gap.position()),
      degrees(std::abs(wrapped(gap.heading_rad))), whole ? 1e3 * whole->largest_position_m : 0.0));
  add_outvoted(out, simulation, scenario);
  out.recordings.emplace_back("recording", simulation.recording());
  out.tracks.emplace_back("true_track", exact);
  out.tracks.emplace_back("estimated_track", believed);
  out.pictures.emplace_back(
      "tracks", track_picture({scenario.name,
                               {{"true track", exact, Look::truth}, {"dead reckoning", believed, Look::estimate}},
                               scenario.floor}));
  out.pictures.emplace_back("gap", gap_picture(believed, exact));
  return out;
}

}  // namespace odolab
