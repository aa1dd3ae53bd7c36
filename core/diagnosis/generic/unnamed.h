// Something that is missing and has no name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/calibration/left_out.h"
#include "core/diagnosis/diagnosis.h"

namespace odolab {

// What no name describes.
struct Unnamed {
  std::string component = "vehicle";
  WhereFound where;
  double gain = 0.0;  // twice the log-likelihood that it explains beyond the names and beyond chance
  double p_value = 0.0;
  std::vector<Response> shape;  // as fitted, where it has one beside the responses to its variable
  GatheredEvidence gathered;    // of what stands for it; empty where nothing does
  std::optional<MovedTrack> moves;
  bool is_of_the_clock = false;  // of which then no rate is known
  std::vector<TimeStretches> incidents;  // in each run that was fitted, where it acts there and nowhere else
};

}  // namespace odolab
