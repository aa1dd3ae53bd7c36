#include "physics/experiments/real/recording_sets.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "core/io/import/imported_recording.h"

namespace odolab {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> entries(const fs::path& folder, bool folders) {
  std::vector<fs::path> found;
  std::error_code failure;
  for (fs::directory_iterator at(folder, failure), end; !failure && at != end; at.increment(failure))
    if (fs::is_directory(at->path(), failure) == folders) found.push_back(at->path());
  std::sort(found.begin(), found.end());
  return found;
}

bool ends_in(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// Wheels of 84 mm on a track of 0.2 m, 64 counts x gear 43.7 for a turn of the wheel (their README).
Vehicle optiodom_robot() {
  DifferentialDrive drive;
  drive.wheel_radius_left_m = drive.wheel_radius_right_m = 0.042;
  drive.wheelbase_m = 0.2;
  drive.encoder_counts_per_revolution = 64;
  drive.gear_ratio = 43.7;
  Vehicle vehicle;
  vehicle.name = "OptiOdom's differential robot";
  vehicle.kind = drive;
  return vehicle;
}

// Wheels of 66 mm, wheelbase 258 mm (the maker's manual); only its commands are recorded.
Vehicle irobot_create() {
  DifferentialDrive drive;
  drive.wheel_radius_left_m = drive.wheel_radius_right_m = 0.033;
  drive.wheelbase_m = 0.258;
  Vehicle vehicle;
  vehicle.name = "iRobot Create";
  vehicle.kind = drive;
  return vehicle;
}

// Neighbouring samples of a truth that comes 66 times a second have their errors in common, which a fit takes for
// motion (README.md).
constexpr double kUtiasTruth_s = 0.1;

// The truth no more often than that, and of commands with one stamp the last, which is the one that acts.
Recording thinned(const Recording& recording, double truth_period_s) {
  constexpr double kEmpty = std::numeric_limits<double>::quiet_NaN();
  Recording out = recording;
  double last_s = -std::numeric_limits<double>::infinity();
  const std::size_t n = recording.time_s.size();
  for (std::size_t i = 0; i < n; ++i) {
    bool truth = false, overruled = false;
    for (const Channel& c : recording.channels) {
      if (std::isnan(c.values[i])) continue;
      if (c.name.compare(0, 6, "truth_") == 0) truth = true;
      if (c.name.compare(0, 8, "command_") == 0)
        for (std::size_t k = i + 1; k < n && recording.time_s[k] == recording.time_s[i]; ++k)
          overruled = overruled || !std::isnan(c.values[k]);
    }
    const bool early = truth && recording.time_s[i] - last_s < truth_period_s - 1e-6;
    if (truth && !early) last_s = recording.time_s[i];
    for (Channel& c : out.channels)
      if ((early && c.name.compare(0, 6, "truth_") == 0) || (overruled && c.name.compare(0, 8, "command_") == 0))
        c.values[i] = kEmpty;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool any = std::any_of(out.channels.begin(), out.channels.end(),
                                 [i](const Channel& c) { return !std::isnan(c.values[i]); });
    if (!any) continue;
    out.time_s[kept] = out.time_s[i];
    for (Channel& c : out.channels) c.values[kept] = c.values[i];
    ++kept;
  }
  out.time_s.resize(kept);
  for (Channel& c : out.channels) c.values.resize(kept);
  return out;
}

void read_into(RecordingSet& set, const fs::path& path) {
  Result<ImportedRecording> imported = import_recording({path.string()});
  if (!imported) {
    set.notes.push_back(set.name + ": " + imported.error().message());
    return;
  }
  for (const std::string& warning : imported->warnings)
    set.notes.push_back(set.name + ", " + path.filename().string() + ": " + warning);
  set.recordings.push_back(std::move(imported->recording));
}

}  // namespace

std::string recordings_folder(const std::string& given) {
  if (!given.empty()) return given;
  const char* named = std::getenv("ODOLAB_RECORDINGS");
  return named && *named ? named : "../shared/recordings";
}

std::vector<RecordingSet> recording_sets(const std::string& folder, std::vector<std::string>& skipped) {
  std::vector<RecordingSet> sets;
  for (const fs::path& kind : entries(fs::path(folder) / "optiodom", true))
    for (const fs::path& id : entries(kind, true)) {
      const std::string name = "optiodom " + kind.filename().string();
      const bool several = entries(kind, true).size() > 1;
      RecordingSet synchronised{
          several ? name + " " + id.filename().string() : name, id.string(), optiodom_robot(), false, {}, {}};
      RecordingSet raw = synchronised;
      raw.name += ", raw";
      for (const fs::path& file : entries(id, false)) {
        const std::string text = file.filename().string();
        if (text.find("_run-") == std::string::npos) continue;
        if (ends_in(text, "_opti.csv"))
          read_into(raw, file);
        else if (ends_in(text, ".csv") && !ends_in(text, "_odo.csv"))
          read_into(synchronised, file);
      }
      for (RecordingSet* set : {&synchronised, &raw})
        if (!set->recordings.empty() || !set->notes.empty()) sets.push_back(std::move(*set));
    }
  if (sets.empty()) skipped.push_back("skipped: OptiOdom's recordings are not in " + folder + "/optiodom");
  const std::size_t before = sets.size();
  for (const fs::path& data_set : entries(folder, true)) {
    const std::string name = data_set.filename().string();
    if (name.compare(0, 6, "mrclam") != 0) continue;
    RecordingSet set{name, data_set.string(), irobot_create(), true, {}, {}};
    for (const fs::path& file : entries(data_set, false))
      if (ends_in(file.filename().string(), "_Odometry.dat")) read_into(set, file);
    for (Recording& recording : set.recordings) recording = thinned(recording, kUtiasTruth_s);
    if (!set.recordings.empty()) set.notes.push_back(name + ": the truth is taken ten times a second");
    if (!set.recordings.empty() || !set.notes.empty()) sets.push_back(std::move(set));
  }
  if (sets.size() == before) skipped.push_back("skipped: the UTIAS recordings are not in " + folder + "/mrclam*");
  return sets;
}

}  // namespace odolab
