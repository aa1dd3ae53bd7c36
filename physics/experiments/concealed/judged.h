// What diagnosis says of a drawn case, against what was drawn.
#pragma once

#include <string>
#include <vector>

#include "physics/experiments/concealed/drawn_case.h"

namespace odolab::concealed {

// How a case is concealed, each measured.
struct Concealment {
  // Calibration fits the given runs as well as the true model does (within 5 %), and a held-out run is predicted worse
  // by more than 20 %.
  bool absorbed = false;
  // What it adds to the pose errors over a metre, after calibration, is less than half as large as their noise.
  bool under_noise = false;
  bool seldom = false;  // it acts in under a tenth of the time
  bool cancels =
      false;  // at the return of a given run two effects together leave less than a quarter of the smaller one
  bool any() const { return absorbed || under_noise || seldom || cancels; }
};

struct JudgedParameter {
  std::string name;  // "turn_scrub per_radps"
  double truth = 0.0, found = 0.0, stderr_value = 0.0;
  bool held() const;  // by the 95 % interval
};

struct Judged {
  int number = 0;
  Kind kind = Kind::nothing;
  Level level = Level::medium;
  bool poor = false;
  std::vector<std::string> truth;   // "wheel_eccentricity.left_wheel"; wheels only where it is one of the two
  std::vector<std::string> found;   // the findings in their order; "unknown" where that is what was said
  std::vector<std::string> listed;  // alternatives of the first
  std::string regime;               // where the first acts, in its own words
  Verdict verdict = Verdict::cannot_say;
  std::vector<double> significance;
  double counts_per_turn = 0.0;      // of the wheel's encoder
  std::vector<double> oracle_sigma;  // how far the oracle's own sizes are off, in its own standard errors
  Concealment concealed;
  std::string failed;  // the error, where diagnosis gave one

  std::vector<double> asked_p;  // of each effect of the truth, by itself beside the calibration alone; family-wise

  bool named_first = false;   // the strongest finding is one of the truth
  bool named_all = false;     // all of the truth is among the findings
  bool only_those = false;    // and nothing else
  bool wrong_alone = false;   // a finding that is not of the truth stands without alternatives
  bool truth_listed = false;  // the truth is among the alternatives of the first finding

  std::vector<JudgedParameter> parameters;            // of the findings that are right
  std::optional<double> place_error_m, time_error_s;  // of events and zones that were named first
  // What an event does in its first half second, in sigma for a fit that knows everything else: how well any method
  // can know its time.
  std::optional<double> first_half_second_sigma;
  // Mean squared error gathered over a metre on held-out runs, of the points where the wheels touch the floor.
  double calibrated_m2 = 0.0, with_findings_m2 = 0.0, oracle_m2 = 0.0;
  double seconds = 0.0;  // that diagnosis took
  int thrown_away = 0;

  std::string first() const { return found.empty() ? "" : found.front(); }
  std::string line() const;  // everything that matters of it in one line, for people who look for failures
};

Judged judged(const DrawnCase& drawn, const Progress& progress = {});

}  // namespace odolab::concealed
