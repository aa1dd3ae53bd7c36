// An effect of the catalogue that is switched on: in a simulation, or in a fitted model.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/vehicle/vehicle.h"

namespace odolab {

struct ActiveEffect {
  std::string effect;     // a name of the catalogue: "wheel_eccentricity", "slip_zone", ...
  std::string component;  // "left_wheel", "right_wheel", "both_wheels", "vehicle", "truth", "floor"
  // By the catalogue's parameter names, units in the name or as the catalogue says: {"amplitude", 0.006},
  // {"phase_rad", 1.2}. Effects with a place have x_m, y_m, radius_m (bumps and zones) or at_s (events) too.
  std::vector<std::pair<std::string, double>> parameters;

  double parameter(const std::string& name, double otherwise = 0.0) const {
    for (const auto& [key, value] : parameters)
      if (key == name) return value;
    return otherwise;
  }
};

// How the truth is measured, where it is otherwise than the vehicle's file says: nothing that drives.
inline bool is_of_the_truth(const std::string& effect) {
  return effect == "truth_mounting_offset" || effect == "truth_time_offset" || effect == "truth_smoothing";
}

// Biased encoders of a joint are of a part as such, and not of the vehicle that it is.
inline bool is_bias_of_a_joint(const std::string& effect) {
  return effect == "link_angle_bias" || effect == "link_length_bias" || effect == "pivot_angle_bias";
}

// How the truth is measured with those of the effects that say so.
TruthMounting truth_under(const std::vector<ActiveEffect>& effects, TruthMounting truth);

// What is wrong with the recorded numbers themselves.
inline bool is_data_fault(const std::string& effect) {
  return effect == "truth_frozen" || effect == "encoder_data_fault";
}

}  // namespace odolab
