// Clocks that run apart, where no unit carries the truth. What the joints read then stands on the vehicle's clock and
// the truth on its own: a recording that was made of both shows a rate only in part (a tenth of it, of castors).
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

// By how much the vehicle's clock is fast.
struct ClockRate {
  double rate = 0.0, stderr_rate = 0.0;
};

// The truth's stamps as the vehicle's clock would give them, about the first.
void put_right(Track& tracked, double rate);

// Puts clocks right that run apart beyond doubt, and fits the geometry anew: how much later the truth is in a run's
// second half than in its first, each by the geometry alone. One rate for all runs, or one for each where they differ
// beyond chance; empty where they do not run apart.
std::vector<ClockRate> put_clocks_right(std::vector<JoinedRun>& runs, const Vehicle& nominal, GeometryFit& geometry);

// Those of other runs of the same vehicle, by what those said: by the one rate of all, or each by its own.
void put_clocks_right_as(const std::vector<ClockRate>& fitted, std::vector<JoinedRun>& runs, const Vehicle& nominal,
                         const GeometryFit& geometry);

Finding finding_of(const std::vector<ClockRate>& put_right);

}  // namespace odolab
