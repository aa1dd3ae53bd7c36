// What all units of a vehicle say together that is missing: names of what lasts, on a unit or on all alike, and whether
// something is left that has none. README.md in the folder above, "Together".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/together/joined_asked.h"
#include "core/diagnosis/units/together/joined_model.h"

namespace odolab {

// A cause that lasts.
struct JoinedName {
  Finding finding;                 // in the vehicle's words
  std::vector<std::size_t> units;  // on which it acts
  bool is_usual = false;           // usual.h: no finding
};

struct JoinedNames {
  std::vector<JoinedName> names;
  std::optional<Finding> unknown;  // what is left beside them, or instead of them
  std::vector<AskedTogether> asked;
};

// Of a model as it was fitted with nothing let in; what is named acts in `model` afterwards, all else fitted beside it.
JoinedNames joined_names(JoinedModel& model, double family_wise_error, const Progress& progress = {});

}  // namespace odolab
