// What contradicts the names, or that there are none, without a group of terms that would describe it.
#pragma once

#include <optional>
#include <vector>

#include "core/diagnosis/generic/unnamed.h"
#include "core/diagnosis/model/joint_model.h"
#include "core/diagnosis/naming/scored_candidates.h"

namespace odolab {

// Where the truth contradicts the wheels time and again, names or no names. `noise`: that of samples which do not.
std::optional<Unnamed> what_contradicts(const JointModel& joint, const JointModel& calibrated,
                                        const FittedNoise& noise);

// Where recordings from that one on, which names were not looked for in, err by more than twice the noise although all
// is fitted to them too, and names mend less than half of that.
std::optional<Unnamed> what_was_not_foreseen(const JointModel& named, const JointModel& calibrated, int first_run);

// Where those that were fitted err by more than 1.4 times the noise, or twice where there are names and these mend less
// than half of that: what has no shape that is asked for, and yet takes the vehicle elsewhere.
std::optional<Unnamed> what_no_noise_makes(const JointModel& named, const JointModel& calibrated);

// Where so many pushes and bumps were found, each at a moment of its own, that one cause without a name is likelier; or two
// of them at one place of the floor.
std::optional<Unnamed> what_happens_too_often(const JointModel& joint);

// Three names and more, of which two are of what happens once or in one place, and one of these is not beyond doubt:
// one cause that no list holds, and that acts there, is likelier than so many that have come together. `evidence`: of
// each.
std::optional<Unnamed> what_so_many_names_stand_for(const std::vector<AcceptedEffect>& names,
                                                    const std::vector<ScoredCandidate>& evidence);

// Where what the wheels say scatters more than any wheel rolls, as if that were noise.
std::optional<Unnamed> what_scatters_too_much(const JointModel& joint);

}  // namespace odolab
