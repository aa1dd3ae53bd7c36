// The vehicle: what its odometry believes beside what it is, and the motor.
#pragma once

#include "ui/actions.h"
#include "ui/look/theme.h"
#include "ui/look/widgets.h"

namespace odolab::ui {

// Edits the draft; returns the draft as an EditScenario once a person has finished with a field.
Actions vehicle_panel(Scenario& draft, bool& editing, const Theme& theme);

}  // namespace odolab::ui
