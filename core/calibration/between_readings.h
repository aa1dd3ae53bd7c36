// Truth that comes more often than the encoders are read: what the wheels did meanwhile nobody knows quite.
#pragma once

#include "core/calibration/innovations.h"

namespace odolab {

// Of a run whose readings are so far apart that what its wheels did meanwhile is no noise.
constexpr double kReadingsFarApart_s = 0.075;
bool is_read_seldom(const InnovationRun& run);

// Lets samples of the truth that lie between two readings so far apart count for less where the wheels
// speed up: by what a cubic through the readings beside it misses of each, a quarter of which is missed between
// readings that are half as far apart (half as far, where acceleration jumps: a quarter; less where it is smooth).
void trust_less_between_readings(InnovationRun& run, const InnovationModel& model);

}  // namespace odolab
