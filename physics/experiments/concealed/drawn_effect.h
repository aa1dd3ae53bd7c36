// Physics that is to be found: drawn from the catalogue or from outside it, at a size that can be scaled.
#pragma once

#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/diagnosis/active_effect.h"

namespace odolab::concealed {

struct DrawnEffect {
  ActiveEffect active;
  bool outside = false;     // not in the catalogue
  bool at_a_place = false;  // acts by where the vehicle is
  int only_in_run = -1;     // an event happens in one of the given runs
  double largest = 10.0;    // factor on the drawn size beyond which it is no longer the effect that it was drawn as
  std::vector<std::string> amplitudes;  // parameters that grow with its size

  DrawnEffect scaled(double factor) const;
};

// The names that can be drawn: those that act on a differential drive's motion, seen from its encoders. What belongs to
// calibration by the catalogue's own words (the truth's mounting, a steady toe that is the same, the truth's clock) and
// faults of the data are no physics to conceal.
const std::vector<std::string>& drawable_effects();

// Size and component of an effect of medium size. A place or a moment is left to be chosen where the runs are known.
DrawnEffect drawn_effect(Random& random, const std::string& name, int given_runs);

}  // namespace odolab::concealed
