// What a unit's diagnosis may not say: the joints that tell where it was are rounded, and units on one frame drag each
// other along.
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

// Whether an encoder of the joint that goes on by one step would look the same: a push or a bump that small.
bool may_be_rounding(const Finding& finding, const VehicleUnit& unit, const JointRounding& rounding);

// The same where no outside truth is known: the joint moves whichever side is judged, and twice, since the other unit's
// place is told by it too; and of two units one is all that the other is held against, whose counts turn it, and with
// it the joint's far end.
JointRounding rounding_from_inside(const Vehicle& vehicle);

// Takes out encoder faults at which the wheel only stood: readings that hold and then catch up are a fault only where
// the axle went on meanwhile. Castors and trucks that stand may set off within a sample.
void leave_out_standing(Diagnosis& d, const std::vector<Recording>& recordings, const DifferentialDrive& drive);

// Takes out what has no name and predicts nothing, and names of hardly any evidence. `castor`: more of them, since the
// wheels of castors that share a frame slip wherever their lengths are not quite the file's.
void leave_out_traces(Diagnosis& d, bool castor);

// Whether that would take out names, too: what has none predicts nothing, and is most of it what one name explains.
bool has_a_name_beside_a_trace(const Diagnosis& d, bool castor);
inline constexpr const char* kTraceBesideAName =
    "beside what was named something is left that is as small as the rounding of the joints or the slip of wheels on "
    "one "
    "frame, and that predicts no run it was not fitted on";

}  // namespace odolab
