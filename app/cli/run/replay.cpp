#include "physics/replay.h"

#include "app/cli/run/outputs.h"
#include "app/cli/terminal.h"
#include "core/io/import/imported_recording.h"
#include "core/io/picture/line_picture.h"
#include "core/io/picture/track_picture.h"
#include "core/io/scenario_toml.h"
#include "core/io/window_words.h"

namespace odolab {

namespace {

DrawnLine distance_line(const std::string& label, const Track& track, const Track& truth, Look look) {
  DrawnLine line{label, {}, {}, look};
  for (const TimedPose& t : truth)
    if (const auto pose = pose_at(track, t.time_s)) {
      line.x.push_back(t.time_s);
      line.y.push_back(1e3 * length(pose->position() - t.pose.position()));
    }
  return line;
}

void add_error(RunOutputs& out, const std::string& who, const std::string& words,
               const std::optional<TrackError>& error, const Track& track, bool headings) {
  if (!error) return;
  if (!headings) {
    out.figure(who + "_end_position_error_m", error->end_position_m);
    out.figure(who + "_largest_position_error_m", error->largest_position_m);
    out.sentences.push_back(text_of("%s: %.1f mm off at the end, %.1f mm at most.", words.c_str(),
                                    1e3 * error->end_position_m, 1e3 * error->largest_position_m));
    return;
  }
  out.figure(who + "_position_rms_m", error->position_rms_m);
  out.figure(who + "_heading_rms_rad", error->heading_rms_rad);
  out.figure(who + "_end_position_error_m", error->end_position_m);
  out.figure(who + "_end_heading_error_rad", std::abs(error->end_heading_rad));
  out.figure(who + "_largest_position_error_m", error->largest_position_m);
  out.sentences.push_back(text_of("%s: %.2f mm and %.3f degrees off %s; %.1f mm at the end, %.1f mm at most.",
                                  words.c_str(), 1e3 * error->position_rms_m, degrees(error->heading_rms_rad),
                                  over_which_way(median_of(window_sizes(track, *error))).c_str(),
                                  1e3 * error->end_position_m, 1e3 * error->largest_position_m));
}

}  // namespace

Result<RunOutputs> replay_outputs(const Scenario& scenario, const std::string& scenario_path,
                                  const Progress& progress) {
  const std::string file = beside(scenario_path, std::get<ReplayPath>(scenario.path).recording);
  Result<ImportedRecording> loaded = load_recording(file, until_interrupted());
  if (!loaded) return loaded.error();
  for (const std::string& warning : loaded->warnings) print_message("warning: " + file + ": " + warning);
  const auto recording = std::make_shared<const Recording>(std::move(loaded->recording));
  const Result<Replay> replayed = replay(scenario, recording, progress);
  if (!replayed) return replayed.error();
  goes_on(progress, 1.0);

  RunOutputs out;
  out.figure("duration_s", recording->duration_s());
  out.figure("distance_m", travelled_m(replayed->simulated));
  add_error(out, "simulated", "The simulated vehicle, driven by the recording", replayed->simulated_error,
            replayed->simulated, replayed->truth_has_headings);
  add_error(out, "dead_reckoned", "Dead reckoning with the vehicle file", replayed->dead_reckoned_error,
            replayed->dead_reckoned, replayed->truth_has_headings);
  if (!replayed->truth_has_headings)
    out.sentences.push_back(
        "The truth has no headings: the heading of the start was found by laying the first metres onto it.");
  out.details["recording"] = recording->name;
  out.details["provenance"] = recording->provenance;
  out.tracks.emplace_back("simulated_track", replayed->simulated);
  out.tracks.emplace_back("dead_reckoned_track", replayed->dead_reckoned);
  out.tracks.emplace_back("truth_track", replayed->truth);
  out.pictures.emplace_back("tracks", track_picture({scenario.name,
                                                     {{"recorded truth", replayed->truth, Look::truth},
                                                      {"simulated vehicle", replayed->simulated, Look::estimate},
                                                      {"dead reckoning", replayed->dead_reckoned, Look::second}},
                                                     scenario.floor}));
  out.pictures.emplace_back(
      "distance",
      line_picture({"Distance from the recorded truth",
                    "time [s]",
                    "distance [mm]",
                    {distance_line("simulated vehicle", replayed->simulated, replayed->truth, Look::estimate),
                     distance_line("dead reckoning", replayed->dead_reckoned, replayed->truth, Look::second)}}));
  return out;
}

}  // namespace odolab
