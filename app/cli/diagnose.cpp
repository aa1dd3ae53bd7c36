#include <algorithm>
#include <filesystem>

#include "app/cli/command.h"
#include "app/cli/terminal.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/fitted_model.h"
#include "core/diagnosis/units/vehicle_units.h"
#include "core/io/diagnosis_html.h"
#include "core/io/diagnosis_json.h"
#include "core/io/diagnosis_text.h"
#include "core/io/import/imported_recording.h"
#include "core/io/model_toml.h"
#include "core/io/vehicle_toml.h"
#include "core/recording/vehicle_samples.h"
#include "physics/model_replay.h"

namespace odolab {

namespace {

struct DiagnoseOptions {
  std::string vehicle;
  std::vector<std::string> recordings, hold_out;
  std::string json, model, html;
  bool skip_broken = false;
};

// What keeps a recording from being judged at all.
std::optional<Error> unusable(const Recording& recording, const Vehicle& vehicle, const std::string& path) {
  if (const std::vector<std::string> problems = problems_in(recording); !problems.empty())
    return Error{path + ": " + problems.front(), "", ""};
  if (const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind)) {
    const std::size_t inputs = std::max(wheel_samples(recording, *drive).size(), command_samples(recording).size());
    if (inputs < 2) return Error{path, "no wheel samples and no commands", "two samples or more"};
  } else if (const std::string missing = missing_columns(recording, vehicle); !missing.empty()) {
    return Error{path, "no " + missing, "the encoders of a " + kind_name(vehicle)};
  }
  if (units_of(vehicle).size() > 1) return std::nullopt;  // they judge each other
  const std::size_t truths = truth_samples(recording).size();
  if (truths < 2) return Error{path, std::to_string(truths) + " truth samples", "two or more, to compare with"};
  return std::nullopt;
}

// A recording's name stands for it in all that is said; where two files have one name, as much of the path as tells
// them apart stands before it.
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

struct Loaded {
  std::vector<Recording> recordings;
  std::vector<std::string> paths;
};

// The recordings that can be used. An error where one cannot and none may be skipped.
Result<Loaded> load(const std::vector<std::string>& paths, const Vehicle& vehicle, bool skip_broken) {
  Loaded loaded;
  for (const std::string& path : paths) {
    Result<ImportedRecording> one = load_recording(path);
    std::optional<Error> problem = one ? unusable(one->recording, vehicle, path) : one.error();
    if (problem && !skip_broken) return *problem;
    if (problem) {
      print_message("skipped: " + problem->message());
      continue;
    }
    for (const std::string& warning : one->warnings) print_message("warning: " + path + ": " + warning);
    loaded.recordings.push_back(std::move(one->recording));
    loaded.paths.push_back(path);
  }
  return loaded;
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return a == b || std::filesystem::equivalent(a, b, ignored);
}

Result<Done> write(const DiagnoseOptions& options, const Diagnosis& diagnosis, const FittedModel& model) {
  if (!options.json.empty())
    if (Result<Done> done = write_json(options.json, diagnosis_json(diagnosis)); !done) return done;
  if (!options.model.empty())
    if (Result<Done> done = write_model(options.model, model); !done) return done;
  if (!options.html.empty())
    if (Result<Done> done = write_report(options.html, diagnosis_report(diagnosis)); !done) return done;
  return Done{};
}

int execute(const DiagnoseOptions& options) {
  const Result<Vehicle> nominal = read_vehicle(options.vehicle);
  if (!nominal) return bad_input(nominal.error());
  if (const std::optional<Error> other = undiagnosed_kind(*nominal)) return bad_input(*other);
  for (const std::string& seen : options.recordings)
    for (const std::string& unseen : options.hold_out)
      if (is_same_file(seen, unseen))
        return bad_input(
            {unseen, "a recording to hold out that is also to be fitted", "runs that the fit does not see"});
  Result<Loaded> train = load(options.recordings, *nominal, options.skip_broken);
  if (!train) return bad_input(train.error());
  Result<Loaded> held_out = load(options.hold_out, *nominal, options.skip_broken);
  if (!held_out) return bad_input(held_out.error());
  if (train->recordings.empty())
    return bad_input({options.recordings.front(), "no recording that can be used", "one or more"});

  std::vector<Recording> all = train->recordings;
  all.insert(all.end(), held_out->recordings.begin(), held_out->recordings.end());
  std::vector<std::string> paths = train->paths;
  paths.insert(paths.end(), held_out->paths.begin(), held_out->paths.end());
  make_names_differ(all, paths);
  const auto first_held_out = all.begin() + static_cast<std::ptrdiff_t>(train->recordings.size());

  Result<Diagnosis> diagnosis = diagnose({all.begin(), first_held_out}, {first_held_out, all.end()}, *nominal, {},
                                         terminal_progress("diagnosing"));
  if (!diagnosis) return bad_input(diagnosis.error());
  const FittedModel model = model_of(*diagnosis);
  const auto& noise_floor =
      diagnosis->held_out.noise_floor ? diagnosis->held_out.noise_floor : diagnosis->train.noise_floor;
  const Result<ModelReplay> replayed = replay_model(all, calibrated_model_of(*diagnosis), model, noise_floor,
                                                    terminal_progress("driving the simulator"));
  if (!replayed) return bad_input(replayed.error());
  diagnosis->simulation = replayed->fit;
  for (const std::string& sentence : replayed->not_switched_on) diagnosis->warnings.push_back(sentence);

  if (Result<Done> written = write(options, *diagnosis, model); !written) return bad_input(written.error());
  for (const std::string& line : summary_lines(*diagnosis)) std::printf("%s\n", line.c_str());
  for (const std::string& warning : diagnosis->warnings) print_message("warning: " + warning);
  for (const std::string* path : {&options.json, &options.model, &options.html})
    if (!path->empty()) print_message("written: " + *path);
  return kDone;
}

}  // namespace

Command diagnose_command() {
  const auto options = std::make_shared<DiagnoseOptions>();
  Command command;
  command.name = "diagnose";
  command.about =
      "Finds where recordings and the vehicle's model differ, names the physics that was left out, and proves it";
  command.example =
      "odolab diagnose --vehicle labmate.toml run-1.csv run-2.csv run-3.csv --hold-out run-4.csv --html report.html "
      "--model fitted.toml";
  command.declare = [options](Arguments& arguments) {
    arguments.option("--vehicle", options->vehicle, "the vehicle as it is believed to be (TOML)", true);
    arguments.files("RECORDING", options->recordings,
                    "one run each, with outside truth; OdoLab's CSV or a format that import knows", true);
    arguments.files("--hold-out", options->hold_out,
                    "recordings that are looked at only to prove what was found on the others", false);
    arguments.option("--json", options->json, "the diagnosis to write for scripts (JSON)");
    arguments.option("--model", options->model, "the fitted model to write, for predict --model (TOML)");
    arguments.option("--html", options->html, "the report with pictures to write, one page (HTML)");
    arguments.flag("--skip-broken", options->skip_broken, "go on without recordings that cannot be used");
  };
  command.execute = [options] { return execute(*options); };
  return command;
}

}  // namespace odolab
