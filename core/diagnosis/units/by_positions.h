// Linked and castor vehicles whose truth has places and no headings, or poses at both ends of a run alone: what all
// units and these tell together. README.md, "Positions alone" and "Ends alone".
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/together/joined_model.h"

namespace odolab {

// Places that are read once a second or more in every recording; true where there is none.
bool have_positions(const std::vector<Recording>& recordings);
// Poses, at both ends of every recording or more; true where there is none.
bool have_ends(const std::vector<Recording>& recordings);

// The joints, the wheels, where the truth sits, and its clocks.
GeometryFit geometry_by_positions(const JoinedModel& model, const Vehicle& nominal);

// The recording of a unit that no other judges, as the positions and what its joints read put its axle; without
// headings. `run` and `clock_s` are of this recording.
Recording recording_by_positions(const Recording& recording, const std::vector<UnitSample>& samples,
                                 const JoinedRun& run, double clock_s, const JoinedModel& model);

// Biased encoders, where all units together tell them better than what the geometry has. `and_lengths`: of a link's
// length, too, which without a truth is the wheels' size.
void take_biases(const JoinedModel& model, GeometryFit& fit, bool and_lengths);

// Where the lines through the pivots meet the axles, with or without a truth; other vehicles' fits stay as they are.
void take_asides(const JoinedModel& model, GeometryFit& fit);

// A vehicle that nothing is known of beside its file.
GeometryFit geometry_of_file(const Vehicle& nominal, std::size_t recordings);

// Where the vehicle's reference point is in the room when a recording starts.
Pose start_of(const JoinedModel& model, std::size_t run);

// Of a unit that was judged by the others: its wheels are known no better than all wheels together are, by this share.
void widen_by_scale(double share, Diagnosis& one);

}  // namespace odolab
