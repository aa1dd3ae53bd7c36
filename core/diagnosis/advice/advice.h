// What these recordings could not have shown, and which drive would decide what is still open:
// core/diagnosis/README.md, Eqs. 13 and 14.
#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/advice/visible.h"
#include "core/diagnosis/diagnosis.h"

namespace odolab {

// Two names for one thing: an effect that was let in, and what could have been said in its place.
struct Confusion {
  int accepted = 0;
  const Effect* alternative = nullptr;
  std::vector<double> shape;  // of the alternative
  std::vector<double> value;  // its amplitudes, were it the one
  double inflation = 1.0;     // of the evidence
};

struct Advice {
  std::vector<NotTestable> not_testable;
  std::string next_drive;           // in plain words; empty where nothing is open
  std::vector<DriveLeg> next_legs;  // the same to be driven; empty where words are all there is
};

// `dark`: what would not have been seen.
Advice advice(const JointModel& joint, const std::vector<Confusion>& confused, const std::vector<Visible>& dark);

// Whether less than a third of what the catalogue has for a vehicle with encoders could show: then that nothing did
// says nothing.
bool are_most_effects(const std::vector<NotTestable>& not_testable);

}  // namespace odolab
