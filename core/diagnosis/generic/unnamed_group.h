// What is said of a group of generic terms that stands for something without a name.
#pragma once

#include <vector>

#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/generic/unnamed.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// The group's curves as fitted, with bands of two standard errors. `with`: a model into which it was let in last.
std::vector<Response> shape_of(const GenericTest& group, const JointModel& with);

// `without`: a model that has neither the group nor names; `gain`: twice the log-likelihood that it explains.
Unnamed unnamed_by(const GenericTest& group, const JointModel& with, const JointModel& without,
                   std::vector<Response> shape, double gain);

}  // namespace odolab
