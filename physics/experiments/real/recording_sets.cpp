#include "physics/experiments/real/recording_sets.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

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
    if (!set.recordings.empty() || !set.notes.empty()) sets.push_back(std::move(set));
  }
  if (sets.size() == before) skipped.push_back("skipped: the UTIAS recordings are not in " + folder + "/mrclam*");
  return sets;
}

}  // namespace odolab
