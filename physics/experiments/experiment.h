// A published experiment repeated: their figures beside ours, and whether the claims hold.
//
// An experiment is one file in this folder and one line in the list of experiments.cpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"

namespace odolab {

// Metres as most figures are printed.
inline double mm(double m) { return 1e3 * m; }

// One figure, theirs and ours. A figure that the paper's text does not give has no published value.
struct Figure {
  std::string name;                                               // "Emax,syst before calibration"
  std::string unit;                                               // "mm", "degrees", "1"; spelled as it is printed
  std::optional<double> published_low = {}, published_high = {};  // the same where it is one number
  double ours = 0.0;                                              // mean over the seeds
  double ours_spread = 0.0;  // standard deviation over the seeds; 0 where there is one alone
  int seeds = 1;
};

// What the paper says, and what came out here.
struct Claim {
  std::string sentence;  // "each of the eight calibrations improves Emax,syst tenfold"
  bool holds = false;
  std::string because;     // the figures that decide it; where it does not hold, the reason that a run shows
  bool explained = false;  // a claim that does not hold, with its reason shown by a run: a result, not a failure
};

// A table that is wider than figures are: a confusion matrix, one row per run. Cells are what is printed.
struct ResultTable {
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

struct ExperimentReport {
  std::vector<Figure> figures;
  std::vector<Claim> claims;
  std::vector<ResultTable> tables;
  std::vector<std::string> assumptions;  // what the paper does not give and had to be chosen
  std::vector<std::string> notes;        // why figures disagree, and anything that a reader must know
};

struct ExperimentOptions {
  std::uint64_t seed = 1;
  int cases = 0;  // how many are drawn, where the experiment draws; 0: its own number
  // The folder of real recordings, where the experiment reads such; empty: where they are by habit.
  std::string recordings = {};
};

// The result depends on the options alone, not on the number of threads. Where `progress` says stop the report holds
// what was done until then. An error where something the experiment reads (recordings) is not there.
struct Experiment {
  std::string name;    // "umbmark-table3"
  std::string about;   // one line
  std::string source;  // paper and section
  Result<ExperimentReport> (*run)(const ExperimentOptions& options, const Progress& progress);
};

// All of them, in the order in which they are printed.
const std::vector<Experiment>& experiments();

// False where a claim neither holds nor is explained.
bool succeeded(const ExperimentReport& report);

}  // namespace odolab
