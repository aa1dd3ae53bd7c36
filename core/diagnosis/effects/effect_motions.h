// What effects add to a drive's motion.
#pragma once

#include <functional>
#include <vector>

#include "core/diagnosis/effects/effect.h"

namespace odolab {

// For each wheel interval of the view, of one effect with one value for each of its amplitudes.
Motions motion_of(const Effect& effect, const DriveView& view, const std::vector<double>& shape,
                  const std::vector<double>& value);

// How far a motion that comes back, each part by itself, displaces a rim, or the vehicle sideways, in the tenth of the
// time in which it does so most. Of one that is less than 0.6 counts the steps in which an encoder shows a smooth
// start do as much.
double displaces_m(const std::vector<DriveView>& views, const std::function<Motions(const DriveView&)>& motion);
bool is_more_than_counts(double displaces_m, double count_rad, const std::vector<DriveView>& views);

// Of all effects that are switched on; what acts on clocks, on the truth or on commands that are not there adds
// nothing.
std::vector<BodyMotion> motions_of(const DriveView& view, const std::vector<ActiveEffect>& effects);

}  // namespace odolab
