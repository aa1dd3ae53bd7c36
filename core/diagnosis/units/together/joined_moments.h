// What happens at one moment: how much every moment of every run has to say of a wheel that went further, and of a
// push.
#pragma once

#include <cstddef>
#include <vector>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/units/together/joined_model.h"

namespace odolab {

struct JoinedMoment {
  int run = 0;
  double time_s = 0.0;  // of the encoders
  double statistic = 0.0;
};

// One wheel of one unit; or a push of one unit, or of all of them.
struct JoinedMoments {
  std::vector<std::size_t> units;
  Wheel wheel = Wheel::both;  // both: a push
  std::vector<JoinedMoment> strongest;
  double count = 0.0;      // moments that were looked at
  double inflation = 1.0;  // of the statistics of all against chi-square: by the middle and by the strongest tenth
};

// How much wider statistics of so many degrees of freedom scatter than chi-square, 1 at least; 1 where fewer than
// twenty say too little of it.
double inflation_of(const std::vector<double>& statistics, int freedom);

// Of what the model leaves with all that was let in; so many of the strongest, half a second apart.
std::vector<JoinedMoments> joined_moments(const JoinedModel& model, std::size_t most = 3);

}  // namespace odolab
