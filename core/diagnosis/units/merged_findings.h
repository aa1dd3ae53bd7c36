// What the units found, as findings of the vehicle: README.md in this folder, 4.
#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/measurement_findings.h"
#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

// The findings of one unit in the vehicle's words. What remains of the truth's mounting is a biased encoder, or lengths
// that are calibration.
void add_findings_of(const Diagnosis& d, const VehicleUnit& unit, const JointRounding& rounding,
                     std::vector<Finding>& all);

// A patch of floor that one unit names looks like pushes and bumps to units that only touch it.
void put_events_into_their_zones(std::vector<Finding>& all);

// A push that several units feel at once is one of the whole vehicle, as the unit that carries the truth felt it, or
// the one that tells most of it.
void put_pushes_together(std::vector<Finding>& all, const std::vector<VehicleUnit>& units);

// As with one drive: what is left without a name beside names that stand must be a fair part of the evidence.
// Whether something was taken out.
bool leave_out_small_rest(std::vector<Finding>& all);

// Biased encoders by the geometry's fit. What something else may feign is no finding, but said in the sentences
// returned.
std::vector<std::string> add_biases(const GeometryFit& geometry, const std::vector<VehicleUnit>& units,
                                    std::vector<Finding>& all);

// Where an encoder of a joint errs in a way that has no name, a bias of it is what its mean makes of it, and stands
// among what it resembles; a bias of another is left out where it says less.
void leave_out_biases_beside_erring_joints(std::vector<Finding>& all);

// What has no name first, then the strongest; and of the evidence of all the share of each that has one.
void put_in_order(std::vector<Finding>& all);

// Of the truth, where no unit by itself is held against it: where it sits, and its clock.
void add_mounting(const GeometryFit& geometry, const Vehicle& nominal, std::vector<Finding>& all);
void add_clock(const GeometryFit& geometry, const Vehicle& nominal, std::vector<Finding>& all);

}  // namespace odolab
