// A truth that errs by nothing, as a simulator's without noise.
#pragma once

#include <optional>
#include <string>

#include "core/recording/recording.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

struct AsIfMeasured {
  Recording recording;
  std::string said;  // for whoever reads the report
};

// The recording with the errors of a good motion capture added to its truth, as large as what wheels and whole counts
// leave, where that errs by nothing at all: what is left of such a truth is no noise but the trace of the vehicle's own
// counts and floor, and was taken for a tracker that smooths. They are drawn by what else was read: the same run gets
// the same, whenever it began and whichever it is of several. Nothing where the truth errs, has no headings, or the
// vehicle is no differential drive.
std::optional<AsIfMeasured> as_if_measured(const Recording& recording, const Vehicle& vehicle);

}  // namespace odolab
