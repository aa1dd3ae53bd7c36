// What the moment says: true and estimated pose, the gap between them, and the wheels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "physics/simulation.h"
#include "ui/actions.h"
#include "ui/look/theme.h"
#include "ui/panels/estimator_panel.h"

namespace odolab::ui {

struct Readout {
  SimulationState state;
  // The gap, measured by whoever owns the run: estimated against true.
  double gap_m = 0.0;
  double gap_heading_rad = 0.0;
  double gap_along_m = 0.0;   // ahead of the true pose
  double gap_across_m = 0.0;  // left of it
  const VehicleShape* shape = nullptr;
  VehiclePosture posture;
  Estimators estimators;
  bool by_hand = false;   // the arrow keys drive
  bool sideways = false;  // and Q and E, where the vehicle can
};

// The state says which estimators a person has chosen to see.
Actions readout_panel(const Readout& readout, EstimatorState& estimators, const Theme& theme);

// The card of the first start.
struct Welcome {
  bool open = false;
};
Actions welcome_card(Welcome& welcome, const Theme& theme);

}  // namespace odolab::ui
