// Physics that no scenario can name: wheels that roll unevenly, and effects outside the catalogue.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/diagnosis/active_effect.h"
#include "physics/effects/effect.h"

namespace odolab::concealed {

// Each wheel slips by a share that is drawn every 2 cm and goes evenly from one to the next: its way errs by a standard
// deviation that grows with the square root of what was rolled. A function of the wheels' rotation alone, so that two
// runs with the same wheels err alike, whatever else acts on them.
std::shared_ptr<planar::Effect> rolling_noise(double m_per_sqrt_m, double radius_m, std::uint64_t seed, double step_s);

// An effect that the catalogue does not have. All but `amplitude` are parameters of its form.
struct OutsideEffect {
  std::string name;
  std::string about;
  double medium = 0.0;      // amplitude
  bool at_a_place = false;  // acts by where the vehicle is
  std::shared_ptr<planar::Effect> (*make)(const ActiveEffect& active, double step_s);
};
const std::vector<OutsideEffect>& outside_effects();
const OutsideEffect* outside_effect(const std::string& name);  // null where there is none

}  // namespace odolab::concealed
