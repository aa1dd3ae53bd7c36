#include <algorithm>
#include <cstdio>
#include <functional>

#include "app/cli/command.h"
#include "app/cli/file_examples.h"
#include "app/cli/overwriting.h"
#include "app/cli/terminal.h"
#include "core/calibration/recording_fault.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/fitted_model.h"
#include "core/diagnosis/given_recordings.h"
#include "core/diagnosis/units/vehicle_units.h"
#include "core/io/diagnosis_html.h"
#include "core/io/diagnosis_json.h"
#include "core/io/diagnosis_text.h"
#include "core/io/import/imported_recording.h"
#include "core/io/model_toml.h"
#include "core/io/vehicle_toml.h"
#include "physics/confirmed_diagnosis.h"

namespace odolab {

namespace {

struct DiagnoseOptions {
  std::string vehicle;
  std::vector<std::string> recordings, hold_out;
  std::string json, model, html;
  bool skip_broken = false;
};

struct Loaded {
  std::vector<Recording> recordings;
  std::vector<std::string> paths;
};

// Said at once, and again in what is written.
void skip(const Error& fault, std::vector<std::string>& skipped) {
  skipped.push_back("skipped: " + fault.message());
  print_message(skipped.back());
}

// The recordings that can be used. An error where one cannot and none may be skipped.
Result<Loaded> load(const std::vector<std::string>& paths, const Vehicle& vehicle, bool skip_broken,
                    std::vector<std::string>& skipped) {
  Loaded loaded;
  for (const std::string& path : paths) {
    Result<ImportedRecording> one = load_recording(path, until_interrupted());
    if (interrupted()) return Error{path, "a wish to stop", "time to read it"};
    std::optional<Error> problem = one ? unusable(one->recording, vehicle, path) : one.error();
    if (problem && !skip_broken) return *problem;
    if (problem) {
      skip(*problem, skipped);
      continue;
    }
    for (const std::string& warning : one->warnings) print_message("warning: " + path + ": " + warning);
    loaded.recordings.push_back(std::move(one->recording));
    loaded.paths.push_back(path);
  }
  return loaded;
}

// Leaves out the recordings whose columns are not what their names say. An error where one is and none may be left out,
// or where none would be left.
Result<Done> leave_out_faulty(Loaded& loaded, const std::vector<std::optional<Error>>& faults, bool skip_broken,
                              std::vector<std::string>& skipped) {
  Loaded sound;
  for (std::size_t i = 0; i < loaded.recordings.size(); ++i) {
    if (!faults[i]) {
      sound.recordings.push_back(std::move(loaded.recordings[i]));
      sound.paths.push_back(loaded.paths[i]);
      continue;
    }
    Error fault = *faults[i];
    if (const std::string& name = loaded.recordings[i].name; !name.empty() && fault.where.rfind(name, 0) == 0)
      fault.where.replace(0, name.size(), loaded.paths[i]);
    if (!skip_broken || fault.where == kEveryRecording) return fault;
    skip(fault, skipped);
  }
  loaded = std::move(sound);
  return Done{};
}

// Says of each file that it is written as soon as it is.
Result<Done> write_diagnosis(const DiagnoseOptions& options, const Diagnosis& diagnosis, const FittedModel& model) {
  const auto write = [](const std::string& path, const std::function<Result<Done>()>& how) -> Result<Done> {
    if (path.empty()) return Done{};
    Result<Done> done = how();
    if (done) print_message("written: " + name_of_output(path));
    return done;
  };
  if (auto done = write(options.json, [&] { return write_json(options.json, diagnosis_json(diagnosis)); }); !done)
    return done;
  if (auto done = write(options.model, [&] { return write_model(options.model, model); }); !done) return done;
  return write(options.html, [&] { return write_report(options.html, diagnosis_report(diagnosis)); });
}

int execute_diagnose(const DiagnoseOptions& options) {
  std::vector<std::string> inputs = options.recordings;
  inputs.insert(inputs.end(), options.hold_out.begin(), options.hold_out.end());
  inputs.push_back(options.vehicle);
  if (const std::optional<Error> unusable = unusable_output({options.json, options.model, options.html}, inputs))
    return bad_input(*unusable);
  const Result<Vehicle> nominal = read_vehicle(options.vehicle);
  if (!nominal) return bad_input(nominal.error());
  if (const std::optional<Error> other = undiagnosed_kind(*nominal)) return bad_input(*other);
  for (const std::string& seen : options.recordings)
    for (const std::string& unseen : options.hold_out)
      if (is_same_file(seen, unseen))
        return bad_input(
            {unseen, "a recording to hold out that is also to be fitted", "runs that the fit does not see"});
  std::vector<std::string> skipped;
  Result<Loaded> train = load(options.recordings, *nominal, options.skip_broken, skipped);
  if (!train) return bad_input(train.error());
  Result<Loaded> held_out = load(options.hold_out, *nominal, options.skip_broken, skipped);
  if (!held_out) return bad_input(held_out.error());
  std::vector<Recording> given = train->recordings;
  given.insert(given.end(), held_out->recordings.begin(), held_out->recordings.end());
  if (interrupted()) return stopped_before_its_end();
  const std::vector<std::optional<Error>> faults = faults_in(given, *nominal);
  if (interrupted()) return stopped_before_its_end();
  const auto first_of_held_out = faults.begin() + static_cast<std::ptrdiff_t>(train->recordings.size());
  if (const auto done = leave_out_faulty(*train, {faults.begin(), first_of_held_out}, options.skip_broken, skipped);
      !done)
    return bad_input(done.error());
  if (const auto done = leave_out_faulty(*held_out, {first_of_held_out, faults.end()}, options.skip_broken, skipped);
      !done)
    return bad_input(done.error());
  if (train->recordings.empty())
    return bad_input({options.recordings.front(), "no recording that can be used", "one or more"});

  std::vector<Recording> all = train->recordings;
  all.insert(all.end(), held_out->recordings.begin(), held_out->recordings.end());
  std::vector<std::string> paths = train->paths;
  paths.insert(paths.end(), held_out->paths.begin(), held_out->paths.end());
  if (const std::optional<Error> twice = given_twice(all, paths)) return bad_input(*twice);
  make_names_differ(all, paths);
  if (interrupted()) return stopped_before_its_end();
  const auto first_held_out = all.begin() + static_cast<std::ptrdiff_t>(train->recordings.size());

  Result<Diagnosis> diagnosis = confirmed_diagnosis({all.begin(), first_held_out}, {first_held_out, all.end()},
                                                    *nominal, terminal_progress("diagnosing"));
  if (!diagnosis) return bad_input(diagnosis.error());
  if (interrupted()) return stopped_before_its_end();

  for (const std::string& line : summary_lines(*diagnosis)) std::printf("%s\n", line.c_str());
  std::fflush(stdout);
  for (const std::string& warning : merged_warnings(diagnosis->warnings)) print_message("warning: " + warning);
  diagnosis->warnings.insert(diagnosis->warnings.end(), skipped.begin(), skipped.end());
  if (Result<Done> written = write_diagnosis(options, *diagnosis, model_of(*diagnosis, all)); !written)
    return bad_input(written.error());
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
  command.files = std::string(kVehicleAndRecordings) +
                  "\n\nIn the JSON the verdict is found, too, where nothing but a clock, the truth's mounting or the data "
                  "is at fault:\nfindings of physics are those whose effect neither begins with truth_ nor is clock_rate "
                  "or encoder_data_fault.";
  command.declare = [options](Arguments& arguments) {
    arguments.option("--vehicle", options->vehicle, "the vehicle as it is believed to be (TOML)", true);
    arguments.files("RECORDING", options->recordings,
                    "one run each, with outside truth; OdoLab's CSV or a format that import knows", true);
    arguments.files("--hold-out", options->hold_out,
                    "recordings that are looked at only to prove what was found on the others", false);
    arguments.output("--json", options->json, "the diagnosis to write for scripts (JSON)");
    arguments.output("--model", options->model, "the fitted model to write, for predict --model (TOML)");
    arguments.output("--html", options->html, "the report with pictures to write, one page (HTML)");
    arguments.flag("--skip-broken", options->skip_broken, "go on without recordings that cannot be used");
  };
  command.execute = [options] { return execute_diagnose(*options); };
  return command;
}

}  // namespace odolab
