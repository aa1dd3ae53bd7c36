// Whether dead reckoning bears a term out: what is significant need not matter, and what matters is not refuted by it.
#pragma once

#include <cstddef>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// Whether dead reckoning is better already than any floor or camera resolves, 0.02 mm and 0.02 mrad.
bool is_nothing(const JointModel::GatheredError& error);

// Whether less than that share of the squared error is left.
bool lowers(const JointModel::GatheredError& before, const JointModel::GatheredError& after, double most_left);
constexpr double kMaterial = 0.985;  // for each number that is fitted

// Whether a term of so many numbers is to be believed: one that moves dead reckoning nowhere by what a floor or camera
// resolves is not, however sure it is. Where the innovations are correlated the truth's noise is not what the likelihood
// takes it for, and small gains of likelihood mean little: the error must be lower by 1.5 % for each number, and by more
// where the truth was smoothed, since its own turns are then late. Where they are white the likelihood is believed,
// unless dead reckoning contradicts it: core/diagnosis/README.md, Eq. 7. `distrust`: of the joint model before.
bool is_material(double distrust, bool truth_noise_lasts, const JointModel::GatheredError& before,
                 const JointModel::GatheredError& after, std::size_t numbers = 1);
bool is_material(const JointModel& joint, const JointModel::GatheredError& before,
                 const JointModel::GatheredError& after);

// By what share of the squared error a term makes dead reckoning worse beyond what chance does where it is right:
// above zero it is contradicted. Zero where the windows of both are not the same.
double worse_than_chance(const JointModel::GatheredError& before, const JointModel::GatheredError& after);

}  // namespace odolab
