// Whether the names given are enough: what they leave, and whether something that has no name would say more than they.
#pragma once

#include <optional>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

// What no name describes.
struct Unnamed {
  WhereFound where;
  double gain = 0.0;   // twice the log-likelihood that it explains beyond the names and beyond chance
  double share = 1.0;  // of all that calibration leaves
  double p_value = 0.0;
  std::vector<Response> shape;  // as fitted, where it has one beside the responses to its variable
};

struct Adequacy {
  std::vector<GenericTest> generic;  // of what the names leave, best first
  std::optional<Unnamed> unnamed;    // where the names are not enough
  bool something_small_is_left = false;
};

// `calibrated`: without any name; `calibration`: its noise, that of samples which do not contradict it. `of_mounting`:
// twice the log-likelihood that a turned mounting or a toe explains, which slips in turns besides.
Adequacy adequacy_of(const JointModel& joint, const JointModel& calibrated, const LeastSquaresCalibration& calibration,
                     const std::vector<ScoredCandidate>& evidence, double of_mounting, double error);

}  // namespace odolab
