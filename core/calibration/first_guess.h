// Where a calibration starts, and whether wheels and truth speak of the same robot at all.
#pragma once

#include <string>
#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

// By plain least squares over stretches of half a second to a few: the truth's turn against the rotation of both
// wheels, and its way along the heading against the same. Rough, but it has one minimum and knows no start.
struct FirstGuess {
  DifferentialDrive drive;  // wheel radii and wheelbase; the nominal ones where nothing can be said
  bool trusted = false;     // most of the truth's motion is explained by it
};

FirstGuess first_guess(const std::vector<InnovationRun>& runs, const DifferentialDrive& nominal);

// What contradicts the truth in a way that no calibration mends, and what there should be instead.
struct Contradiction {
  std::string found;  // empty where there is none
  std::string expected = "wheels and truth of one robot, in the units that the columns are named after";
};

// Exchanged or reversed wheels, headings in degrees, lengths in millimetres, clocks that are seconds apart.
Contradiction contradiction_in(const std::vector<InnovationRun>& runs, const DifferentialDrive& nominal);

// Readings that jump by more than a hundred times the usual step: a sentence for each wheel that does.
std::vector<std::string> counter_jumps_in(const std::vector<InnovationRun>& runs);

}  // namespace odolab
