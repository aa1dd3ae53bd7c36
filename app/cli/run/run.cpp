#include <charconv>
#include <filesystem>

#include "app/cli/command.h"
#include "app/cli/overwriting.h"
#include "app/cli/run/judge.h"
#include "app/cli/run/lesson.h"
#include "app/cli/run/outputs.h"
#include "app/cli/terminal.h"
#include "core/io/file_kind.h"
#include "core/io/recording_csv.h"
#include "core/io/scenario_toml.h"
#include "core/io/track_csv.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

struct RunOptions {
  std::string scenario, out, seed;
  bool check = false;
};

Result<Done> write_run(const RunOutputs& out, const Scenario& scenario, const std::string& folder) {
  Json summary = Json::object();
  summary["scenario"] = scenario.name;
  summary["seed"] = scenario.seed;
  summary["step_s"] = scenario.step_s;
  for (const auto& [name, value] : out.figures) summary["figures"][name] = value;
  summary["details"] = out.details;
  HtmlReport report = out.report;
  for (const auto& [name, picture] : out.pictures) report.picture(picture);

  std::vector<std::string> written;
  std::optional<Error> failure;
  const auto keep = [&](const std::string& path, const Result<Done>& done) {
    if (done)
      written.push_back(path);
    else if (!failure)
      failure = done.error();
  };
  const auto put = [&](const std::string& name, const auto& writer) {
    if (!failure) keep(folder + "/" + name, writer(folder + "/" + name));
  };
  for (const auto& entry : out.recordings)
    put(entry.first + ".csv", [&](const std::string& path) { return write_recording_csv(path, entry.second); });
  for (const auto& entry : out.tracks)
    put(entry.first + ".csv", [&](const std::string& path) { return write_track_csv(path, entry.second); });
  for (const auto& entry : out.pictures)
    put(entry.first + ".svg", [&](const std::string& path) { return write_whole_file(path, entry.second); });
  put("report.html", [&](const std::string& path) { return write_report(path, report); });
  put("summary.json", [&](const std::string& path) { return write_json(path, summary); });
  if (!failure) return Done{};
  for (const std::string& path : written) std::filesystem::remove(path);  // nothing half-written
  return *failure;
}

std::vector<std::vector<std::string>> what_was_run(const Scenario& scenario) {
  const ActualDrive& actual = scenario.actual;
  if (!std::holds_alternative<DifferentialDrive>(scenario.vehicle.kind))
    return {{"kind", kind_name(scenario.vehicle), scenario.machine.lengths ? "with lengths of its own" : "as drawn"},
            {"mass_kg", "", text_of("%.4g", actual.mass_kg)}};
  const auto& nominal = std::get<DifferentialDrive>(scenario.vehicle.kind);
  const auto row = [](const char* name, double believed, double real) {
    return std::vector<std::string>{name, text_of("%.7g", believed), text_of("%.7g", real)};
  };
  return {row("wheel_radius_left_m", nominal.wheel_radius_left_m, actual.wheel_radius_left_m),
          row("wheel_radius_right_m", nominal.wheel_radius_right_m, actual.wheel_radius_right_m),
          row("wheelbase_m", nominal.wheelbase_m, actual.wheelbase_m),
          {"mass_kg", "", text_of("%.4g", actual.mass_kg)}};
}

int execute_run(const RunOptions& options) {
  if (options.out == "-") return bad_input({"--out", "'-'", "a folder: a run writes several files"});
  if (file_kind(options.scenario) == FileKind::lesson) return run_lesson(options.scenario, options.out, options.check);
  Result<Scenario> scenario = read_scenario(options.scenario);
  if (!scenario) return bad_input(scenario.error());
  if (!options.seed.empty()) {
    const auto end = options.seed.data() + options.seed.size();
    if (const auto read = std::from_chars(options.seed.data(), end, scenario->seed);
        read.ec != std::errc() || read.ptr != end)
      return bad_input({"--seed", "'" + options.seed + "'", "a whole number from 0 to 18446744073709551615"});
  }
  const std::string folder =
      options.out.empty() ? "out/" + std::filesystem::path(options.scenario).stem().string() : options.out;
  if (const std::optional<Error> unusable = unusable_output({folder + "/summary.json"}, {}))
    return bad_input(*unusable);
  Result<RunOutputs> out = run_outputs(*scenario, options.scenario, terminal_progress("running"));
  if (!out) return bad_input(out.error());

  const Result<Judgement> judgement = judge(scenario->expectations, out->figures, options.scenario + ": expect");
  if (!judgement) return bad_input(judgement.error());
  HtmlReport report(scenario->name);
  if (!scenario->about.empty()) report.paragraph(scenario->about);
  for (const std::string& sentence : out->sentences) report.paragraph(sentence);
  report.append(out->report);
  report.heading("Figures");
  std::vector<std::vector<std::string>> figures;
  for (const auto& [name, value] : out->figures) figures.push_back({name, text_of("%.6g", value)});
  report.table({"figure", "value"}, figures);
  report.heading("What was run");
  report.table({"parameter", "nominal", "actual"}, what_was_run(*scenario));
  report.paragraph(text_of("odolab run %s --seed %llu (OdoLab " ODOLAB_VERSION ", step %g s, friction %g)",
                           options.scenario.c_str(), static_cast<unsigned long long>(scenario->seed), scenario->step_s,
                           scenario->floor.friction));
  out->report = report;

  if (interrupted()) return stopped_before_its_end();
  if (Result<Done> written = write_run(*out, *scenario, folder); !written) return bad_input(written.error());
  for (const std::string& sentence : out->sentences) std::printf("%s\n", sentence.c_str());
  std::printf("written: %s/report.html, summary.json, recordings and pictures\n", folder.c_str());
  if (!options.check) return kDone;
  if (scenario->expectations.empty())
    print_message("warning: " + options.scenario + " has no [[expect]]: nothing was judged");
  std::printf("%s", judgement->lines.c_str());
  return judgement->all_hold ? kDone : kCheckFailed;
}

}  // namespace

Result<RunOutputs> run_outputs(const Scenario& scenario, const std::string& path, const Progress& progress) {
  if (scenario.benchmark && scenario.benchmark->extended)
    return extended_umbmark_outputs(scenario, scenario.seed, progress);
  if (scenario.benchmark) return umbmark_outputs(scenario, scenario.seed, progress);
  if (std::holds_alternative<ReplayPath>(scenario.path)) return replay_outputs(scenario, path, progress);
  return drive_outputs(scenario, scenario.seed, progress);
}

Command run_command() {
  const auto options = std::make_shared<RunOptions>();
  Command command;
  command.name = "run";
  command.about = "Simulates a scenario without a window and writes recordings, tracks, pictures and a report";
  command.example = "odolab run assets/scenarios/umbmark.toml --seed 7 --out out/umbmark --check";
  command.declare = [options](Arguments& arguments) {
    arguments.file("SCENARIO", options->scenario, "what to simulate (TOML)");
    arguments.option("--seed", options->seed, "seed of all that is random; the scenario's own if not given");
    arguments.option("--out", options->out, "folder for what it writes; out/SCENARIO if not given");
    arguments.flag("--check", options->check, "judge the scenario's own expectations; exit 1 where one fails");
  };
  command.execute = [options] { return execute_run(*options); };
  return command;
}

}  // namespace odolab
