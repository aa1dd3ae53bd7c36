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

// Whether so much of one motion and of another part by more than that.
bool part_by_more_than_counts(const std::function<Motions(const DriveView&)>& one,
                              const std::function<Motions(const DriveView&)>& other, double value, double count_rad,
                              const std::vector<DriveView>& views);

// Whether an effect changes how fast a vehicle goes for longer than a moment. A lag does so before all others
// (`as_it_lags`).
bool changes_speeds(const Effect& effect);

// The drive at the speeds and turn rates at which the vehicle goes, once what effects add to them is added to what the
// wheels say: a tyre is squeezed in the bend that is driven, not in the one that its wheels promise, which it makes
// wider. `motions`: what the effects that change speeds add to each step of such a drive.
DriveView as_it_goes(DriveView by_wheels, const std::function<std::vector<BodyMotion>(const DriveView&)>& motions);

// Of all effects that are switched on; what acts on clocks, on the truth or on commands that are not there adds
// nothing. The view is as the wheels say.
std::vector<BodyMotion> motions_of(const DriveView& view, const std::vector<ActiveEffect>& effects);

// Effects of a place act where the track is, and the track is where they put it: reckoned from the track before, none
// at first, until no pose is moved any more. Each time at least one more crossing is right.
Track settled(const std::function<Track(const Track& before)>& reckoned);

}  // namespace odolab
