// What all units of a vehicle, and the outside truth if there is one, tell together of its geometry: instead of what
// its own fit has, or beside it. README.md, "Positions alone", "Ends alone" and "From the inside".
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/together/joined_model.h"

namespace odolab {

// A vehicle that nothing is known of beside its file.
GeometryFit geometry_of_file(const Vehicle& nominal, std::size_t recordings);

// The joints, the wheels, where the truth sits, and its clocks. Without a truth the mean radius is the file's.
GeometryFit told_geometry(const JoinedModel& model, const Vehicle& nominal);

// The recording of a unit that no other judges, as the positions and what its joints read put its axle; without
// headings. `run` and `clock_s` are of this recording.
Recording recording_by_positions(const Recording& recording, const std::vector<UnitSample>& samples,
                                 const JoinedRun& run, double clock_s, const JoinedModel& model);

// Biased encoders, with how they err together, where all units together tell them better than what the geometry has.
void take_biases(const JoinedModel& model, const Vehicle& nominal, GeometryFit& fit);
// These and all other lengths, however well the geometry seems to have them: it did not know what was missing. Where
// the truth sits stays as it is.
void take_joints(const JoinedModel& model, const Vehicle& nominal, GeometryFit& fit);

// Where the vehicle's reference point is in the room when a recording starts.
Pose start_of(const JoinedModel& model, std::size_t run);

// Of a unit that was judged by the others: its wheels are known no better than all wheels together are, by this share.
void widen_by_scale(double share, Diagnosis& one);

}  // namespace odolab
