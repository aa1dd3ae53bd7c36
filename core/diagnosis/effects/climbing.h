// What wheels do that climb something: the way on which they do, and how far they turn beyond what they travel.
#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/forms.h"

namespace odolab::effects {

// The entry "bump" of that wheel, of both or of whichever comes there, with neither shape nor motion yet.
Effect bump_of(Wheel wheel);

// Of the way over something a wheel takes two thirds at most: one that climbs as high as its axle takes one.
bool is_climbed(double extra_m, const Climb& climb);

double radius_m(Wheel wheel, const DriveView& view);

struct Steps {
  std::size_t first, last;
};

// So much of a wheel's way about the middle of a step.
Steps steps_about(const DriveView& view, Wheel wheel, std::size_t middle, double length_m);

// One wheel's climb.
struct Climbing {
  Wheel wheel;
  Steps over;
};

// An extra distance of each climb, one metre of it, spread over the steps as they are travelled; of a mound that is so
// far across, one metre for as much way.
void spread(Motions& motions, const DriveView& view, const Climbing& climbing, const Climb& climb,
            double across_m = 0.0);
Motions motions_of(const DriveView& view, const std::vector<Climbing>& climbs, const Climb& climb,
                   double across_m = 0.0);

}  // namespace odolab::effects
