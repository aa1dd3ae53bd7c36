// By what the encoders of a unit's joints may err beside a bias: by what they read, as a crooked spindle or a scale
// does; by which way they went last, as play does; by how fast they turn, as one that is read late does; and by how
// hard the unit is pulled aside, as a link that bends does. The catalogue has no name for any of them.
#pragma once

#include <memory>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/generic/truth_errors.h"
#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

inline constexpr const char* kWhatItReads = "what it reads";

// Of a unit that carries no truth, whose truth the joints tell; null where none does. `samples`: of each recording, and
// `names` what these are called; null too where two have one name.
std::shared_ptr<const std::vector<TruthError>> joint_errors(const std::vector<std::vector<UnitSample>>& samples,
                                                            const std::vector<std::string>& names,
                                                            const Vehicle& vehicle, std::size_t unit);

// Whether a finding has no name and is of such an encoder; its component is the vehicle's already.
bool is_of_a_joint(const Finding& f);
// Whether it has none and is no unit's: the one that carries the truth sees it.
bool is_of_floor_or_truth(const Finding& f);

// "the link angle A", "the pivot of castor 2"; and the contract's component of its bias.
struct JointName {
  std::string words, component, unit;
};
JointName name_of_joint(const Vehicle& vehicle, std::size_t joint);

}  // namespace odolab
