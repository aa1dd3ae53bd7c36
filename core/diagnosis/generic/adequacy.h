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
  std::optional<Unnamed> as_likely;  // where they may be, but something without a name is not beaten by them either
  bool something_small_is_left = false;
};

// Of all recordings that there are; `calibrated`: without any name. `of_mounting`: twice the log-likelihood that a
// turned mounting or a toe explains, which slips in turns besides.
Adequacy adequacy_of(const JointModel& joint, const JointModel& calibrated,
                     const std::vector<ScoredCandidate>& evidence, double of_mounting, double error);

// Where the truth contradicts the wheels time and again, names or no names. `noise`: that of samples which do not.
std::optional<Unnamed> what_contradicts(const JointModel& joint, const JointModel& calibrated,
                                        const FittedNoise& noise);

// Where recordings from that one on, which names were not looked for in, err by more than twice the noise although all
// is fitted to them too, and names mend less than half of that.
std::optional<Unnamed> what_was_not_foreseen(const JointModel& named, const JointModel& calibrated, int first_run);

// Where what the wheels say scatters more than any wheel rolls, as if that were noise.
std::optional<Unnamed> what_scatters_too_much(const JointModel& joint);

}  // namespace odolab
