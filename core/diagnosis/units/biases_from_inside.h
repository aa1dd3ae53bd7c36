// What trucks say of their joints by themselves, beside an outside truth: how they stand to each other they know better
// than a truth knows where they are.
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

// The joints of a clapper, an OmniMate or a smart trailer, known by the truth and from the inside, each by how well:
// with the wheels as the truth calibrated them, which gives the link its scale, and what was found on them taken off.
// From the inside a joint is known no better than it comes out alike without one run or another. Where the two
// contradict each other, and with fewer than three runs, the truth alone is believed. Whether any joint changed.
bool put_inside_beside_truth(GeometryFit& geometry, const std::vector<Recording>& train, const Vehicle& nominal,
                             const std::vector<Diagnosis>& of_units, const Progress& progress);

}  // namespace odolab
