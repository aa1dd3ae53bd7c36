// What a person wants done in Diagnose.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace odolab::ui {

struct HoldOut {  // the run is looked at only to prove what was found on the others
  std::size_t run = 0;
  bool on = true;
};
struct RemoveRun {
  std::size_t run = 0;
};
struct ClearRuns {};  // and the mystery; the vehicle stays
struct FindMissing {};
struct SwitchFinding {  // in the simulation
  std::size_t finding = 0;
  bool on = true;
};
struct DrawMystery {
  std::uint64_t seed = 1;
};
struct GuessMystery {
  std::string guess;  // of DiagnosisView::guesses
};
struct RevealMystery {};
struct SimulateAdvice {};
struct ShowUnit {  // of a linked or castor vehicle: its mismatch is drawn
  std::string unit;
};
enum class DiagnosisExport { report, model, json, csv };
struct ExportDiagnosis {
  DiagnosisExport what = DiagnosisExport::report;
  std::string path;
  // Of the CSV: which run, and which of it; all where there are none.
  std::size_t run = 0;
  std::vector<std::pair<double, double>> stretches;
};

using DiagnosisAction = std::variant<HoldOut, RemoveRun, ClearRuns, FindMissing, SwitchFinding, DrawMystery,
                                     GuessMystery, RevealMystery, SimulateAdvice, ShowUnit, ExportDiagnosis>;

}  // namespace odolab::ui
