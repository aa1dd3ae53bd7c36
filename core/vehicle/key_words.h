// The keys of files and findings as people say them.
#pragma once

#include <string>

namespace odolab {

// "floor" and "left_wheel" as "floor" and "left wheel".
std::string with_blanks(std::string key);

// A part of a vehicle: "truck_a" as "truck A", "castor2" and "castor[2]" as "castor 2".
std::string part_words(const std::string& part);

// What something acts on: "the left wheel of truck B", "truck A", "both wheels", "the vehicle".
std::string component_words(const std::string& component);

// A parameter without its unit: "truck_a.wheel_radius_left_m" as "truck A, wheel radius left". What only has a unit,
// "per_radps", is an "amount".
std::string parameter_words(const std::string& key);

// An entry of the catalogue of effects: "one_sided_drag" as "one-sided drag".
std::string effect_words(const std::string& effect);

}  // namespace odolab
