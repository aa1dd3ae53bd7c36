#include <filesystem>

#include "app/cli/command.h"
#include "app/cli/run/outputs.h"
#include "app/cli/terminal.h"
#include "core/io/recording_csv.h"
#include "core/io/scenario_toml.h"
#include "core/io/track_csv.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

struct RunOptions {
  std::string scenario, out;
  std::uint64_t seed = 1;
  bool seed_given = false;
  bool check = false;
};

Result<RunOutputs> run(const Scenario& scenario, const std::string& path, const Progress& progress) {
  if (scenario.benchmark && scenario.benchmark->extended) return extended_umbmark_outputs(scenario, scenario.seed, progress);
  if (scenario.benchmark) return umbmark_outputs(scenario, scenario.seed, progress);
  if (std::holds_alternative<ReplayPath>(scenario.path)) return replay_outputs(scenario, path, progress);
  return drive_outputs(scenario, scenario.seed, progress);
}

Result<Done> write(const RunOutputs& out, const Scenario& scenario, const std::string& folder) {
  Json summary = Json::object();
  summary["scenario"] = scenario.name;
  summary["seed"] = scenario.seed;
  summary["step_s"] = scenario.step_s;
  for (const auto& [name, value] : out.figures) summary["figures"][name] = value;
  summary["details"] = out.details;
  HtmlReport report = out.report;
  for (const auto& [name, picture] : out.pictures) report.picture(picture);

  for (const auto& [name, recording] : out.recordings)
    if (auto done = write_recording_csv(folder + "/" + name + ".csv", recording); !done) return done;
  for (const auto& [name, track] : out.tracks)
    if (auto done = write_track_csv(folder + "/" + name + ".csv", track); !done) return done;
  for (const auto& [name, picture] : out.pictures)
    if (auto done = write_whole_file(folder + "/" + name + ".svg", picture); !done) return done;
  if (auto done = write_report(folder + "/report.html", report); !done) return done;
  return write_json(folder + "/summary.json", summary);
}

// Prints how each expectation fared. An Error where one asks for a figure that this run does not have.
Result<bool> judge(const Scenario& scenario, const RunOutputs& out, const std::string& path) {
  bool all_hold = true;
  for (const Expectation& e : scenario.expectations) {
    const double* value = nullptr;
    std::string known;
    for (const auto& [name, figure] : out.figures) {
      if (name == e.figure) value = &figure;
      known += (known.empty() ? "" : ", ") + name;
    }
    if (!value) return Error{path + ": expect", "the figure '" + e.figure + "'", "one of " + known};
    const bool holds = (!e.at_least || *value >= *e.at_least) && (!e.at_most || *value <= *e.at_most);
    all_hold = all_hold && holds;
    std::string range;
    if (e.at_least) range += text_of(" at least %g", *e.at_least);
    if (e.at_most) range += text_of("%s at most %g", e.at_least ? " and" : "", *e.at_most);
    std::printf("%s: %s is %g, expected%s\n", holds ? "ok" : "FAILED", e.figure.c_str(), *value, range.c_str());
  }
  return all_hold;
}

int execute(const RunOptions& options) {
  Result<Scenario> scenario = read_scenario(options.scenario);
  if (!scenario) return bad_input(scenario.error());
  if (options.seed_given) scenario->seed = options.seed;
  Result<RunOutputs> out = run(*scenario, options.scenario, terminal_progress("running"));
  if (!out) return bad_input(out.error());

  HtmlReport report(scenario->name);
  if (!scenario->about.empty()) report.paragraph(scenario->about);
  for (const std::string& sentence : out->sentences) {
    std::printf("%s\n", sentence.c_str());
    report.paragraph(sentence);
  }
  report.append(out->report);
  out->report = report;

  const std::string folder =
      options.out.empty() ? "out/" + std::filesystem::path(options.scenario).stem().string() : options.out;
  if (Result<Done> written = write(*out, *scenario, folder); !written) return bad_input(written.error());
  std::printf("written: %s/report.html, summary.json, recordings and pictures\n", folder.c_str());
  if (!options.check) return kDone;
  const Result<bool> holds = judge(*scenario, *out, options.scenario);
  if (!holds) return bad_input(holds.error());
  return *holds ? kDone : kCheckFailed;
}

}  // namespace

Command run_command() {
  const auto options = std::make_shared<RunOptions>();
  Command command;
  command.name = "run";
  command.about = "Simulates a scenario without a window and writes recordings, tracks, pictures and a report";
  command.example = "odolab run assets/scenarios/umbmark.toml --seed 7 --out out/umbmark --check";
  command.declare = [options](Arguments& arguments) {
    arguments.file("SCENARIO", options->scenario, "what to simulate (TOML)");
    arguments.option("--seed", options->seed, options->seed_given, "seed of all that is random; the scenario's own if not given");
    arguments.option("--out", options->out, "folder for what it writes; out/SCENARIO if not given");
    arguments.flag("--check", options->check, "judge the scenario's own expectations; exit 1 where one fails");
  };
  command.execute = [options] { return execute(*options); };
  return command;
}

}  // namespace odolab
