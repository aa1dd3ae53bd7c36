// What is said of every effect that was asked for, named or not.
#pragma once

#include <vector>

#include "core/diagnosis/advice/visible.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

// `joint`: with the effects that were named; `visible`: of the same.
std::vector<AskedEffect> asked_effects(const JointModel& joint, const Selected& selected,
                                       const std::vector<Visible>& visible);

// By its p-value, and by what it gains where both have the same.
bool is_likelier(const AskedEffect& a, const AskedEffect& b);

}  // namespace odolab
