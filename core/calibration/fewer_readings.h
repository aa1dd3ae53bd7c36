// Readings that come faster than wheels change their speed: some of them left out.
#pragma once

#include "core/calibration/innovations.h"

namespace odolab {

constexpr double kReadingsApart_s = 0.034;  // sooner no wheel of a vehicle changes its speed

// The run with only so many of its readings that none are further apart than `longest_s` but where they were before. A
// reading is where the wheel is, so that nothing of its way is lost; its smoothed place and its acceleration stay those
// that all readings gave. Not of commands, whose speeds are held from one to the next.
InnovationRun with_fewer_readings(const InnovationRun& run, double longest_s);

}  // namespace odolab
