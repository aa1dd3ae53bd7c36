// Whether something happens on one line across the floor, wherever the vehicle crosses it: a cable, a sill, a joint
// between slabs, the seam between two maps or cameras.
#pragma once

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// One test for each channel, of the line whose score is largest for its way, of those that are crossed often enough:
// - each wheel that is on it rolls further than it goes;
// - the vehicle turns, by the angle at which it crosses the line;
// - the truth is carried across the floor, or turned, and back where the line is crossed the other way.
// What names describe happens at a point or all along, so lines are asked beside names and never in their place.
// p values are over `looked_at` tests and all lines.
std::vector<GenericTest> line_tests(const AskedModel& asked, double looked_at);

}  // namespace odolab
