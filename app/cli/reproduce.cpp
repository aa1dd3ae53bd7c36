#include <algorithm>

#include "app/cli/command.h"
#include "app/cli/overwriting.h"
#include "app/cli/terminal.h"
#include "core/io/summary_json.h"
#include "physics/experiments/experiment.h"

namespace odolab {

namespace {

struct ReproduceOptions {
  std::vector<std::string> names;
  std::string json, recordings;
  int seed = 1;
  int cases = 0;
  bool list = false;
};

std::string number(double value) { return text_of("%.4g", value); }

std::string published_text(const Figure& figure) {
  if (!figure.published_low) return "";
  if (!figure.published_high || *figure.published_high == *figure.published_low) return number(*figure.published_low);
  return number(*figure.published_low) + " to " + number(*figure.published_high);
}

std::string ours_text(const Figure& figure) {
  return number(figure.ours) + (figure.seeds > 1 ? " +- " + number(figure.ours_spread) : "");
}

std::string verdict_of(const Claim& claim) {
  return claim.holds ? "holds" : claim.explained ? "does not hold, explained" : "DOES NOT HOLD";
}

void print_report(const Experiment& experiment, const ExperimentReport& report) {
  std::printf("%s: %s\n(%s)\n\n", experiment.name.c_str(), experiment.about.c_str(), experiment.source.c_str());
  if (!report.figures.empty()) {
    std::vector<std::vector<std::string>> rows{{"figure", "published", "ours", "seeds", "unit"}};
    for (const Figure& figure : report.figures)
      rows.push_back(
          {figure.name, published_text(figure), ours_text(figure), std::to_string(figure.seeds), figure.unit});
    print_table(rows);
    std::printf("\n");
  }
  for (const ResultTable& table : report.tables) {
    std::printf("%s\n", table.title.c_str());
    std::vector<std::vector<std::string>> rows{table.header};
    rows.insert(rows.end(), table.rows.begin(), table.rows.end());
    print_table(rows);
    std::printf("\n");
  }
  for (const Claim& claim : report.claims)
    std::printf("%s: %s (%s)\n", verdict_of(claim).c_str(), claim.sentence.c_str(), claim.because.c_str());
  for (const std::string& assumption : report.assumptions) std::printf("assumed: %s\n", assumption.c_str());
  for (const std::string& note : report.notes) std::printf("note: %s\n", note.c_str());
  std::printf("\n");
}

Json json_of(const Experiment& experiment, const ExperimentReport& report) {
  Json json = Json::object();
  json["name"] = experiment.name;
  json["about"] = experiment.about;
  json["source"] = experiment.source;
  json["succeeded"] = succeeded(report);
  json["figures"] = Json::array();
  for (const Figure& figure : report.figures) {
    Json& entry = json["figures"].push_back(Json::object());
    entry["name"] = figure.name;
    entry["unit"] = figure.unit;
    entry["published_low"] = figure.published_low ? Json(*figure.published_low) : Json();
    entry["published_high"] = figure.published_high  ? Json(*figure.published_high)
                              : figure.published_low ? Json(*figure.published_low)
                                                     : Json();
    entry["ours"] = figure.ours;
    entry["ours_spread"] = figure.ours_spread;
    entry["seeds"] = figure.seeds;
  }
  json["claims"] = Json::array();
  for (const Claim& claim : report.claims) {
    Json& entry = json["claims"].push_back(Json::object());
    entry["sentence"] = claim.sentence;
    entry["holds"] = claim.holds;
    entry["explained"] = claim.explained;
    entry["because"] = claim.because;
  }
  json["tables"] = Json::array();
  for (const ResultTable& table : report.tables) {
    Json& entry = json["tables"].push_back(Json::object());
    entry["title"] = table.title;
    entry["header"] = Json(table.header);
    entry["rows"] = Json::array();
    for (const auto& row : table.rows) entry["rows"].push_back(Json(row));
  }
  json["assumptions"] = Json(report.assumptions);
  json["notes"] = Json(report.notes);
  return json;
}

Result<std::vector<const Experiment*>> chosen(const std::vector<std::string>& names) {
  std::vector<const Experiment*> chosen;
  if (names.empty())
    for (const Experiment& experiment : experiments()) chosen.push_back(&experiment);
  for (const std::string& name : names) {
    const auto found = std::find_if(experiments().begin(), experiments().end(),
                                    [&](const Experiment& experiment) { return experiment.name == name; });
    if (found == experiments().end())
      return Error{"reproduce", "'" + name + "'", "one of those that odolab reproduce --list shows"};
    chosen.push_back(&*found);
  }
  return chosen;
}

int execute_reproduce(const ReproduceOptions& options) {
  if (options.list) {
    std::vector<std::vector<std::string>> rows;
    for (const Experiment& experiment : experiments()) rows.push_back({experiment.name + "   " + experiment.about});
    print_table(rows);
    return kDone;
  }
  if (options.seed < 0) return bad_input({"--seed", std::to_string(options.seed), "0 or more"});
  if (options.cases < 0) return bad_input({"--cases", std::to_string(options.cases), "0 (its own number) or more"});
  const Result<std::vector<const Experiment*>> list = chosen(options.names);
  if (!list) return bad_input(list.error());
  if (const std::optional<Error> unusable = unusable_output({options.json}, {})) return bad_input(*unusable);
  const ExperimentOptions drawn{static_cast<std::uint64_t>(options.seed), options.cases, options.recordings};
  Json json = Json::object();
  json["schema"] = "odolab.reproduction/1";
  json["seed"] = options.seed;
  json["experiments"] = Json::array();
  bool all_succeeded = true;
  for (const Experiment* experiment : *list) {
    const Result<ExperimentReport> report = experiment->run(drawn, terminal_progress(experiment->name));
    if (!report) return bad_input(report.error());
    if (interrupted()) return stopped_before_its_end();
    print_report(*experiment, *report);
    std::fflush(stdout);
    json["experiments"].push_back(json_of(*experiment, *report));
    all_succeeded = all_succeeded && succeeded(*report);
  }
  if (!options.json.empty())
    if (Result<Done> written = write_json(options.json, json); !written) return bad_input(written.error());
  return all_succeeded ? kDone : kCheckFailed;
}

}  // namespace

Command reproduce_command() {
  const auto options = std::make_shared<ReproduceOptions>();
  Command command;
  command.name = "reproduce";
  command.about = "Repeats published experiments and prints their figures beside ours; all of them where none is named";
  command.example = "odolab reproduce umbmark-one-direction --json figures.json";
  command.declare = [options](Arguments& arguments) {
    arguments.files("NAME", options->names, "which; all where none is given", false);
    arguments.flag("--list", options->list, "only say which there are");
    arguments.option("--seed", options->seed, "of all that is drawn");
    arguments.option("--cases", options->cases,
                     "how many cases are drawn, where an experiment draws; 0: its own number");
    arguments.option("--recordings", options->recordings,
                     "the folder of real recordings; else ODOLAB_RECORDINGS or ../shared/recordings");
    arguments.output("--json", options->json, "the reports to write for scripts (JSON)");
  };
  command.execute = [options] { return execute_reproduce(*options); };
  return command;
}

}  // namespace odolab
