// What a run of a scenario leaves behind: figures, files and a report.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/geometry/track.h"
#include "core/io/report_html.h"
#include "core/io/summary_json.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace odolab {

struct RunOutputs {
  std::vector<std::pair<std::string, double>> figures;  // for summary.json and its expectations; units in the names
  Json details = Json::object();                        // the rest of summary.json
  std::vector<std::string> sentences;                   // the result in words
  HtmlReport report{""};
  std::vector<std::pair<std::string, Recording>> recordings;  // file name without ending
  std::vector<std::pair<std::string, Track>> tracks;
  std::vector<std::pair<std::string, std::string>> pictures;  // SVG

  void figure(const std::string& name, double value) { figures.emplace_back(name, value); }
};

// The run that a scenario asks for, whatever its kind.
Result<RunOutputs> run_outputs(const Scenario& scenario, const std::string& scenario_path, const Progress& progress);

// The kinds of run, one file each. `scenario_path` is where the scenario's own files are looked for.
Result<RunOutputs> drive_outputs(const Scenario& scenario, std::uint64_t seed, const Progress& progress);
Result<RunOutputs> replay_outputs(const Scenario& scenario, const std::string& scenario_path, const Progress& progress);
Result<RunOutputs> umbmark_outputs(const Scenario& scenario, std::uint64_t seed, const Progress& progress);
Result<RunOutputs> extended_umbmark_outputs(const Scenario& scenario, std::uint64_t seed, const Progress& progress);

}  // namespace odolab
