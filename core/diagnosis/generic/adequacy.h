// Whether the names given are enough: what they leave, and whether something that has no name would say more than they.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/generic/unnamed.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

constexpr int kParameters = 7;          // of the calibration
constexpr int kFewestInnovations = 40;  // beyond these: fewer cannot judge a model

struct Adequacy {
  std::vector<GenericTest> generic;    // of what the names leave, best first
  std::optional<Unnamed> unnamed;      // where the names are not enough
  bool shows_beside_held_out = false;  // and that only together with what was held out
  std::optional<Unnamed> as_likely;    // where they may be, but something without a name is not beaten by them either;
                                       // its gain is what it explains in their place
  bool something_small_is_left = false;
  // What comes and goes with time and may as well be a truth that sways; its wave in words.
  struct Sway {
    std::string wave;
    double to_either_side_m = 0.0;
  };
  std::optional<Sway> sway;
  // What a wheel does evenly often a turn beside names that stand, as a gear before it makes it do: of no way does it
  // add up to anything.
  struct Ripple {
    std::string channel;
    double times_a_turn = 0.0, amplitude = 0.0;  // of the way
  };
  std::vector<Ripple> ripples;
};

// Of all recordings that there are; `calibrated`: without any name.
Adequacy adequacy_of(const JointModel& joint, const JointModel& calibrated,
                     const std::vector<ScoredCandidate>& evidence, double error);

}  // namespace odolab
