#include "app/gui/views.h"

#include <algorithm>
#include <cmath>

#include "app/gui/planned_path.h"

namespace odolab {

namespace {

constexpr double kPush_mps = 0.4;  // that a push gives a vehicle of its first body's mass: a kick, no crash

// At a time, or at the end of the track that is nearest to it: encoders and truth do not begin and end together.
std::optional<Pose> pose_nearest(const Track& track, double time_s) {
  return track.empty() ? std::nullopt : pose_at(track, std::clamp(time_s, track.front().time_s, track.back().time_s));
}

std::optional<ui::ReplayFigures> figures_of(const ComparedReplay* c) {
  if (!c) return std::nullopt;
  ui::ReplayFigures f;
  f.simulated = {&c->replay.simulated, c->replay.simulated_error};
  f.dead_reckoning = {&c->replay.dead_reckoned, c->replay.dead_reckoned_error};
  return f;
}

// Calls back with each chosen estimator besides the one that the vehicle steers by.
template <typename OnEach>
void each_beside(const DriveRun& run, const std::set<std::string>& chosen, const ui::Theme& theme,
                 const OnEach& on_each) {
  const RunEstimates& estimates = run.estimates();
  std::size_t beside = 0;
  for (std::size_t i = 0; i < estimates.all().size(); ++i) {
    if (i == estimates.steering()) continue;
    const ui::EstimatorLook look = ui::estimator_look(beside++, theme);
    if (chosen.count(estimates.all()[i].name) > 0) on_each(estimates.all()[i], look);
  }
}

}  // namespace

ui::FloorScene drive_scene(const Session& session, const SimulationState& shown, const ui::Theme& theme,
                           const std::set<std::string>& estimators) {
  const DriveRun& run = session.run();
  const Scenario& scenario = run.scenario();
  ui::FloorScene scene;
  scene.floor = &scenario.floor;
  scene.editable = true;
  scene.planned = planned_path(scenario, run.simulation().driven_start());
  const RunEstimates& estimates = run.estimates();
  const Track &true_track = estimates.truth(), &estimated = estimates.all()[estimates.steering()].track;
  ui::TrackLine truth;
  truth.label = "true";
  truth.track = &true_track;
  truth.until_s = shown.time_s;
  truth.end = shown.true_pose;
  truth.colour = theme.truth;
  ui::TrackLine estimate;
  estimate.label = "estimated";
  estimate.track = &estimated;
  estimate.reference = &true_track;
  estimate.until_s = shown.time_s;
  estimate.end = shown.estimated_pose;
  estimate.colour = theme.orange;
  estimate.dash = ui::Dash::dashes;
  scene.tracks = {truth, estimate};
  each_beside(run, estimators, theme, [&](const RunEstimate& beside, const ui::EstimatorLook& look) {
    ui::TrackLine line;
    line.label = beside.name;
    line.track = &beside.track;
    line.reference = &true_track;
    line.until_s = shown.time_s;
    line.end =
        shown.true_pose * between(*pose_nearest(true_track, shown.time_s), *pose_nearest(beside.track, shown.time_s));
    line.colour = look.colour;
    line.dash = look.dash;
    scene.tracks[1].label = run.estimates().all()[run.estimates().steering()].name;
    scene.tracks.push_back(line);
  });
  ui::VehicleGlyph vehicle;
  vehicle.shape = &run.shape();
  vehicle.posture = run.shown_posture();
  vehicle.pose = shown.true_pose;
  vehicle.colour = theme.truth;
  ui::VehicleGlyph believed = vehicle;
  believed.pose = shown.estimated_pose;
  believed.outline = true;
  believed.colour = theme.orange;
  scene.vehicles = {vehicle, believed};
  scene.reference = shown.true_pose;
  scene.deviating = shown.estimated_pose;
  scene.push_ns = kPush_mps * scenario.actual.mass_kg;
  return scene;
}

ui::FloorScene compare_scene(const Session& session, const ui::Theme& theme) {
  ui::FloorScene scene;
  scene.reference_name = "recorded";
  scene.deviating_name = "simulated";
  scene.empty_text = !session.comparison().loaded() ? "Open a recording, or drop one here"
                     : session.jobs().running()     ? "The recording is being driven in the simulation…"
                                                    : "This recording could not be replayed with this vehicle";
  const ComparedReplay* shown = session.comparison().shown();
  if (!shown) return scene;
  const Replay& replay = shown->replay;
  const double now = session.comparison().start_s() + session.comparison().time_s;
  ui::TrackLine truth, simulated, reckoned;
  truth.label = "recorded truth";
  truth.track = &replay.truth;
  truth.colour = theme.truth;
  simulated.label = "simulated";
  simulated.track = &replay.simulated;
  simulated.reference = &replay.truth;
  simulated.colour = theme.orange;
  simulated.dash = ui::Dash::dashes;
  reckoned.label = shown->estimator;
  reckoned.track = &replay.dead_reckoned;
  reckoned.reference = &replay.truth;
  reckoned.colour = theme.blue;
  reckoned.dash = ui::Dash::dots;
  truth.until_s = simulated.until_s = reckoned.until_s = now;
  scene.tracks = {truth, simulated, reckoned};
  const VehiclePosture posture = shown->posture_at(now);
  const auto glyph = [&](const std::optional<Pose>& pose, bool outline, ImU32 colour) {
    if (!pose) return;
    ui::VehicleGlyph v;
    v.shape = &replay.shape;
    v.posture = posture;
    v.pose = *pose;
    v.outline = outline;
    v.colour = colour;
    scene.vehicles.push_back(v);
  };
  const ui::ErrorNow error = error_now(session);  // the gap of the lens is the one of the figures
  scene.reference = error.truth;
  scene.deviating = error.simulated;
  glyph(scene.reference, false, theme.truth);
  glyph(scene.deviating, true, theme.orange);
  return scene;
}

ui::Transport drive_transport(const Session& session, const ui::Theme& theme, const std::set<std::string>& estimators) {
  const DriveRun& run = session.run();
  ui::Transport t;
  t.playing = session.playing();
  t.finished = run.finished();
  t.time_s = run.shown_s();
  t.latest_s = run.latest_s();
  t.total_s = run.total_s();
  t.total_is_planned = !run.finished();
  t.can_step_back = run.shown_s() > 0.0;
  t.speed = session.speed();
  t.reached_speed = session.reached_speed();
  t.quantity = "gap";
  t.position_curves = {{"position gap", &run.time_s(), &run.gap_m(), theme.orange, ui::Stroke::line}};
  t.heading_curves = {{"heading gap", &run.time_s(), &run.gap_heading_rad(), theme.orange, ui::Stroke::line}};
  each_beside(run, estimators, theme, [&](const RunEstimate& beside, const ui::EstimatorLook& look) {
    const ui::Stroke stroke = look.dash == ui::Dash::dots          ? ui::Stroke::dotted
                              : look.dash == ui::Dash::long_dashes ? ui::Stroke::long_dashed
                                                                   : ui::Stroke::dashed;
    t.position_curves[0].label = t.heading_curves[0].label = run.estimates().all()[run.estimates().steering()].name;
    t.position_curves.push_back({beside.name, &run.time_s(), &beside.gap_m, look.colour, stroke});
    t.heading_curves.push_back({beside.name, &run.time_s(), &beside.heading_rad, look.colour, stroke});
  });
  for (const RunEvent& e : run.events()) {
    const ImU32 colour = e.kind == RunEvent::Kind::bump        ? theme.bump_edge
                         : e.kind == RunEvent::Kind::slip_zone ? theme.zone
                                                               : theme.muted;
    t.events.push_back({e.time_s, e.words, colour});
  }
  return t;
}

ui::Transport compare_transport(const Session& session, const ui::Theme& theme) {
  const Comparison& c = session.comparison();
  ui::Transport t;
  const ComparedReplay* shown = c.shown();
  t.enabled = shown != nullptr;
  t.why_disabled = c.loaded() ? "The replay is not done yet." : "Open a recording first.";
  t.playing = session.playing();
  t.time_s = c.time_s;
  t.latest_s = t.total_s = c.duration_s();
  t.can_step_back = c.time_s > 0.0;
  t.speed = session.speed();
  t.reached_speed = session.reached_speed();
  t.quantity = "error";
  t.empty_text = "No error over time: this recording holds no outside truth";
  if (shown && !shown->replay.truth.empty()) {
    t.position_curves = {{"simulated", &shown->time_s, &shown->simulated_m, theme.orange, ui::Stroke::line},
                         {shown->estimator, &shown->time_s, &shown->dead_reckoned_m, theme.blue, ui::Stroke::dashed}};
    t.heading_curves = {{"simulated", &shown->time_s, &shown->simulated_rad, theme.orange, ui::Stroke::line},
                        {shown->estimator, &shown->time_s, &shown->dead_reckoned_rad, theme.blue, ui::Stroke::dashed}};
  }
  return t;
}

ui::Bench bench_of(const Session& session) {
  const UmbmarkBench& bench = session.bench();
  const Scenario& scenario = bench.experiments().empty() ? session.run().scenario() : bench.scenario();
  ui::Bench b;
  b.experiments = &bench.experiments();
  b.running = bench.running();
  b.share_done = session.jobs().share_done();
  const bool one_drive = std::holds_alternative<DifferentialDrive>(scenario.vehicle.kind);
  b.can_run = one_drive && !session.jobs().running();
  b.why_not = one_drive ? "Busy " + session.jobs().name() + "."
                        : "UMBmark's squares correct a differential drive; this is another kind of vehicle. "
                          "The guides calibrate castors and the CLAPPER.";
  if (const SquarePath* square = std::get_if<SquarePath>(&scenario.path)) b.side_m = square->side_m;
  const Floor& floor = session.run().scenario().floor;
  b.has_things = !floor.bumps.empty() || !floor.slip_zones.empty();
  b.rough = scenario.floor.roughness.largest_height_m > 0.0;
  b.vehicle_name = scenario.vehicle.name;
  b.actual = scenario.actual;
  return b;
}

ui::Compare compare_of(const Session& session, const std::vector<std::string>& example_files) {
  const Comparison& c = session.comparison();
  ui::Compare view;
  if (session.jobs().running()) {
    view.job = session.jobs().name();
    view.share_done = session.jobs().share_done();
  }
  view.loaded = c.loaded();
  for (const std::string& path : example_files)
    if (path.find("/real_") != std::string::npos || path.find("/recorded_") != std::string::npos)
      view.example_files.push_back(path);
  if (!c.loaded()) return view;
  view.name = c.recording().name;
  view.provenance = c.recording().provenance;
  view.inputs = c.has_wheels() ? "wheel rotation" : "commands";
  view.duration_s = c.recording().duration_s();
  view.vehicle_name = c.vehicle().name;
  view.mass_kg = c.scenario().actual.mass_kg;
  if (c.shown()) view.estimator = c.shown()->estimator;
  view.vehicle = c.chosen();
  view.nominal = figures_of(c.nominal());
  view.calibrated = figures_of(c.calibrated());
  view.calibration = c.calibration();
  if (c.nominal()) {
    view.travelled_m = travelled_m(c.nominal()->replay.truth);
    view.truth_samples = c.nominal()->replay.truth.size();
  }
  view.can_calibrate = c.can_be_calibrated() && view.truth_samples > 1;
  view.why_not = c.has_wheels() && !c.can_be_calibrated()
                     ? "Least squares calibrate a differential drive; this is another kind of vehicle."
                 : c.has_wheels() ? "Calibration needs an outside truth with headings."
                                  : "Calibration needs wheel rotation; this recording holds commands alone.";
  return view;
}

ui::Readout readout_of(const Session& session, const SimulationState& shown, const ui::Theme& theme) {
  ui::Readout r;
  r.state = shown;
  const Pose gap = between(shown.true_pose, shown.estimated_pose);
  r.gap_m = length(gap.position());
  r.gap_heading_rad = wrapped(gap.heading_rad);
  r.gap_along_m = gap.x_m;
  r.gap_across_m = gap.y_m;
  r.estimators = estimators_of(session, shown, theme);
  r.sideways = moves_sideways(session.run().scenario().vehicle.kind);
  r.by_hand = std::holds_alternative<HandPath>(session.run().scenario().path);
  r.shape = &session.run().shape();
  r.posture = session.run().shown_posture();
  return r;
}

ui::Estimators estimators_of(const Session& session, const SimulationState& shown, const ui::Theme& theme) {
  const DriveRun& run = session.run();
  const RunEstimates& estimates = run.estimates();
  const Track& exact = estimates.truth();
  const auto after = std::upper_bound(exact.begin(), exact.end(), shown.time_s + 1e-9,
                                      [](double time_s, const TimedPose& p) { return time_s < p.time_s; });
  const std::size_t sample = after == exact.begin() ? 0 : std::size_t(after - exact.begin()) - 1;  // the last so far
  ui::Estimators view;
  view.finished = run.at_end();
  std::size_t beside = 0;
  for (std::size_t i = 0; i < estimates.all().size(); ++i) {
    const RunEstimate& estimate = estimates.all()[i];
    ui::EstimatorRow row;
    row.name = estimate.name;
    row.about = estimate.about;
    row.steers = i == estimates.steering();
    row.look = row.steers ? ui::EstimatorLook{theme.orange, ui::Dash::dashes} : ui::estimator_look(beside++, theme);
    row.gap = between(exact[sample].pose, estimate.track[sample].pose);
    row.error_m = exact[sample].pose.position() - estimate.track[sample].pose.position();
    view.rows.push_back(row);
  }
  return view;
}

ui::ErrorNow error_now(const Session& session) {
  ui::ErrorNow now;
  const ComparedReplay* shown = session.comparison().shown();
  if (!shown) return now;
  // As in track_error: between truth samples that the simulation reaches, from the first of them on.
  const Track &truth = shown->replay.truth, &simulated = shown->replay.simulated;
  const double t = session.comparison().start_s() + session.comparison().time_s;
  const TimedPose *first = nullptr, *last = nullptr;
  for (const TimedPose& p : truth) {
    if (simulated.empty() || p.time_s < simulated.front().time_s || p.time_s > simulated.back().time_s) continue;
    if (!first) first = &p;
    if (p.time_s <= t + 1e-9 || !last) last = &p;
  }
  if (!first) return now;
  now.truth = last->pose;
  now.simulated = pose_at(simulated, last->time_s);
  now.dead_reckoned = pose_nearest(shown->replay.dead_reckoned, last->time_s);
  const Pose gap =
      between(between(first->pose, last->pose), between(*pose_at(simulated, first->time_s), *now.simulated));
  now.simulated_gap_m = length(gap.position());
  now.simulated_gap_heading_rad = wrapped(gap.heading_rad);
  return now;
}

}  // namespace odolab
