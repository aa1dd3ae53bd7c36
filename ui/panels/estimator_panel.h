// The estimators that a vehicle allows, side by side: which are shown, and how far each is from the truth.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/geometry/pose.h"
#include "ui/floor/scene.h"
#include "ui/look/theme.h"

namespace odolab::ui {

// Colour and dash of the estimators besides the one that the vehicle steers by, in their order.
struct EstimatorLook {
  ImU32 colour = 0;
  Dash dash = Dash::dots;
};
EstimatorLook estimator_look(std::size_t index, const Theme& theme);

struct EstimatorRow {
  std::string name, about;
  bool steers = false;  // the vehicle steers by it: always shown, in the estimate's colour
  EstimatorLook look;
  Pose gap;      // estimate as seen from the truth
  Vec2 error_m;  // true minus estimated position on the floor, as the report defines a return error
};

struct Estimators {
  std::vector<EstimatorRow> rows;
  bool finished = false;  // then the gaps are return errors
};

struct EstimatorState {
  // By name, so that they stay chosen from vehicle to vehicle. At first what the correction from inside is good for.
  std::set<std::string> shown{"truck A alone", "towing wheels", "tracks alone"};
};

void estimator_panel(const Estimators& estimators, EstimatorState& state, const Theme& theme);

}  // namespace odolab::ui
