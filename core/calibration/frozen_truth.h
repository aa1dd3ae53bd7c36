// A truth that repeats itself.
#pragma once

#include <string>

#include "core/calibration/innovations.h"
#include "core/calibration/left_out.h"
#include "core/vehicle/differential_drive.h"

namespace odolab {

// By the truth's stamps, which are `truth_late_s` behind the wheels': stretches of three samples and more that are the
// same to the bit, the first sample's stamp to the last one's; none where the wheels stand in all of them. At rest a
// truth may repeat itself; where it does so on the way, a rest is no more to be believed.
TimeStretches frozen_truth(const std::vector<TruthSample>& truth, const std::vector<WheelSample>& wheels,
                           const DifferentialDrive& drive, double truth_late_s);

// The least by which neighbours differ along an axis: of a truth that is rounded, the step to which it is. Infinite
// where none differ.
double least_step_m(const std::vector<TruthSample>& truth);

// What is said of so many of them.
std::string in_words_of_frozen(std::size_t times);

}  // namespace odolab
