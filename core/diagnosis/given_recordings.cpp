#include "core/diagnosis/given_recordings.h"

#include <algorithm>
#include <filesystem>

#include "core/diagnosis/units/vehicle_units.h"
#include "core/recording/same_samples.h"
#include "core/recording/vehicle_samples.h"

namespace odolab {

namespace {

// What there is instead: " in the columns a, b, c".
std::string in_columns(const Recording& recording) {
  constexpr std::size_t kMost = 8;
  std::string text = " in the columns";
  for (std::size_t k = 0; k < std::min(recording.channels.size(), kMost); ++k)
    text += (k == 0 ? " " : ", ") + recording.channels[k].name;
  return recording.channels.empty() ? "" : text + (recording.channels.size() > kMost ? ", ..." : "");
}

}  // namespace

std::optional<Error> ticks_of_unknown_size(const Recording& recording, const Vehicle& vehicle,
                                           const std::string& path) {
  const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind);
  const auto* tracked = std::get_if<Tracked>(&vehicle.kind);
  const bool is_assumed = (drive && drive->counts_are_assumed) || (tracked && tracked->counts_are_assumed);
  const bool has_rotations = recording.channel("left_wheel_rad") && recording.channel("right_wheel_rad");
  if (!is_assumed || has_rotations || !recording.channel("left_ticks") || !recording.channel("right_ticks"))
    return std::nullopt;
  return Error{path, "ticks, and nothing in the vehicle's file that says how many make a turn",
               "encoder_counts_per_revolution under [" + kind_name(vehicle) + "]"};
}

std::optional<Error> unusable(const Recording& recording, const Vehicle& vehicle, const std::string& path) {
  if (const std::vector<std::string> problems = problems_in(recording); !problems.empty())
    return Error{path + ": " + problems.front(), "", ""};
  if (std::optional<Error> unknown = ticks_of_unknown_size(recording, vehicle, path)) return unknown;
  if (const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind)) {
    const std::size_t inputs = std::max(wheel_samples(recording, *drive).size(), command_samples(recording).size());
    if (inputs < 2)
      return Error{path, "no wheel samples and no commands" + in_columns(recording),
                   "left_wheel_rad and right_wheel_rad, left_ticks and right_ticks, or commands, with two samples or "
                   "more (odolab import --map gives columns these names)"};
  } else if (const std::string missing = missing_columns(recording, vehicle); !missing.empty()) {
    return Error{path, "no " + missing, "the encoders of a " + kind_name(vehicle)};
  }
  if (units_of(vehicle).size() > 1) return std::nullopt;  // they judge each other
  const std::size_t truths = truth_samples(recording).size();
  if (truths < 2)
    return Error{path, std::to_string(truths) + " truth samples" + in_columns(recording),
                 "truth_x_m and truth_y_m with two or more, to compare with"};
  return std::nullopt;
}

std::optional<Error> given_twice(const std::vector<Recording>& recordings, const std::vector<std::string>& paths) {
  for (std::size_t i = 0; i < recordings.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (same_samples(recordings[i], recordings[k]))
        return Error{paths[i], "the same run as in " + paths[k], "each run once"};
  return std::nullopt;
}

void make_names_differ(std::vector<Recording>& recordings, const std::vector<std::string>& paths) {
  std::vector<std::filesystem::path> rest(paths.begin(), paths.end());
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<std::string> names;
    for (const Recording& r : recordings) names.push_back(r.name);
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      rest[i] = rest[i].parent_path();
      if (std::count(names.begin(), names.end(), names[i]) < 2 || rest[i].filename().empty()) continue;
      recordings[i].name = rest[i].filename().string() + "/" + recordings[i].name;
      changed = true;
    }
  }
}

}  // namespace odolab
