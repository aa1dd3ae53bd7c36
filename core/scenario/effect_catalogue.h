// The words by which effects are switched on in a scenario: names, components and parameters of the catalogue.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/active_effect.h"

namespace odolab {

struct EffectParameter {
  std::string name;  // its unit stands in the name; without one it is a fraction
  double at_least = -1e9;
  double at_most = 1e9;
  bool required = false;
};

// Whether it has to be given: what happens at a time needs no place.
bool is_wanted(const EffectParameter& parameter, bool at_a_time);

// An effect as it may be written down. physics/effects/README.md says what each one does.
struct EffectEntry {
  std::string name;
  std::vector<std::string> components;
  std::vector<EffectParameter> parameters;
};

// "truck_a.left_wheel" is the left wheel of truck A, "truck_a" that truck as a whole: the part, and what of it, in the
// words of a vehicle with two wheels. The part is empty where a component is of the vehicle itself.
struct PartComponent {
  std::string part, component;
};
PartComponent part_component(const std::string& component);

// Whether an effect may be switched on there: one of its components, or one of a part that has wheels.
bool may_act_on(const EffectEntry& entry, const std::string& component);

// Those of one part ("truck_b", "trailer", "castor2"), in its own words, and those of the floor, which all parts feel.
std::vector<ActiveEffect> effects_of_part(const std::vector<ActiveEffect>& effects, const std::string& part);

// Every effect; the last ones are those of linked and castor vehicles.
const std::vector<EffectEntry>& effect_catalogue();

// Null where there is no effect of this name.
const EffectEntry* effect_entry(const std::string& name);

// What is wrong with a list of effects, each a sentence that starts with the key, "effect[2].amplitude".
std::vector<std::string> problems_in(const std::vector<ActiveEffect>& effects);

// Whether the planar world has an effect of that name, in that form and of that size.
bool can_be_played(const ActiveEffect& fitted);

// What was found, as the planar world plays it: with those of its parameters that a scenario knows, its form among
// them. None where it has no such effect, or none of that size. Mounting, clock and smoothing of the truth are none of
// its effects.
std::optional<ActiveEffect> as_in_a_scenario(const ActiveEffect& fitted);

}  // namespace odolab
