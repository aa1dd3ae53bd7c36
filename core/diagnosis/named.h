// Names for what is missing that stand: chosen, asked of what was held out, and well away from nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/naming/intervals.h"
#include "core/diagnosis/naming/late_wheel.h"
#include "core/diagnosis/naming/select.h"
#include "core/diagnosis/proof.h"

namespace odolab {

struct Named {
  JointModel joint;
  Selected selected;  // of the joint model's effects
  Intervals intervals;
  Predicted by_joint, by_calibrated;  // under the joint model's noise
  std::optional<JointModel>
      with_held_out;                  // the same model fitted to what was held out as well (Predictor::fitted_to_all)
  std::vector<std::string> warnings;  // what was named and refuted
  OlderCounts older_counts;           // that were taken for a name, which is no part of the warnings
};

// Beside a model that is calibrated only. Unset where `progress` stops it. `asks_what_is_undone`: where something is
// undone (select.h), no more than that is filled in.
std::optional<Named> named(const JointModel& calibrated, const Predictor& predictor, double family_wise_error,
                           const Progress& progress, bool asks_what_is_undone = false);

}  // namespace odolab
