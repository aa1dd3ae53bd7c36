// What is said of names, and of what has none.
#pragma once

#include <optional>
#include <vector>

#include "core/diagnosis/generic/adequacy.h"
#include "core/diagnosis/named.h"
#include "core/diagnosis/ready_recordings.h"

namespace odolab {

// Of names that stand, with where the truth sits and how late it is, strongest first; shares are of what `adequacy`
// finds besides, too.
std::vector<Finding> findings_of(const Named& names, const Adequacy& adequacy, const ReadyRecordings& ready,
                                 const Vehicle& nominal);

// The model with those names alone that are beyond doubt whatever else has none; unset where there are none.
std::optional<JointModel> beyond_doubt(const Named& names);

// Where names do not suffice: first what has no name, which they are said to resemble, then the truth's mounting and
// clock as the model `without` the names that did not suffice has them. `named`: what findings_of says.
std::vector<Finding> findings_beside_unnamed(const std::vector<Finding>& named, const Unnamed& more, const Named& names,
                                             JointModel without, const ReadyRecordings& ready, const Vehicle& nominal,
                                             double family_wise_error);

// Takes off the names of which each says too little of the evidence for it to be like them: no drive that tells it from
// these is worth driving.
void leave_out_what_it_hardly_resembles(Finding& unknown);

}  // namespace odolab
