// What the units of a vehicle tell together, in the place of what each could tell by itself. README.md in the folder
// above, "Together".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/others_way.h"
#include "core/diagnosis/units/together/joined_names.h"

namespace odolab {

struct ToldTogether {
  JoinedModel model;
  JoinedNames said;
};

// `runs`: with no truth in them where it is to be left out. Unset where there is one with headings that is no coarse
// one and comes three times a second: each unit by itself knows its own way better then.
std::optional<ToldTogether> told_together(std::vector<JoinedRun> runs, const Vehicle& nominal,
                                          std::vector<double> clock_s, std::vector<std::string> names,
                                          double family_wise_error, const Progress& progress);

// Whether a truth may err by so much that the units know better how they stand to each other; false where a look at it
// tells.
bool may_be_coarse(const std::vector<JoinedRun>& runs);

// Recordings without what was named; `runs` and `clock_s` are of these.
std::vector<Understood> understood_without(const ToldTogether& told, const std::vector<Recording>& recordings,
                                           const std::vector<JoinedRun>& runs, const std::vector<double>& clock_s,
                                           const Vehicle& nominal);

// A unit's answer without what is told together, and with those of its names in their place that act on it: `again` is
// its answer once these were taken off. Faults of the data are those of the readings as they were.
Diagnosis with_names(const ToldTogether& told, std::size_t unit, const Diagnosis& as_read, Diagnosis again);
bool acts_on(const ToldTogether& told, std::size_t unit);

// In the vehicle's own answer names stand once, in its own words; and what has none.
void put_names_into(const ToldTogether& told, Diagnosis& d);

}  // namespace odolab
