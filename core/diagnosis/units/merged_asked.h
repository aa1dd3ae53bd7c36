// What is said of every effect that the units were asked for, and of every biased encoder between them.
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

// Each effect once, of the unit in which it is likeliest, in the vehicle's words; the likeliest first.
std::vector<AskedEffect> merged_asked(const std::vector<Diagnosis>& diagnoses, const GeometryFit& geometry,
                                      const std::vector<VehicleUnit>& units);

// Which of them are among the findings of the vehicle, once these are settled.
void mark_named(Diagnosis& of_vehicle);

}  // namespace odolab
