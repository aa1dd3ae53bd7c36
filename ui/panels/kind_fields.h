// The parameters of a vehicle of any kind, nominal beside true, as fields.
#pragma once

#include "core/scenario/scenario.h"
#include "ui/look/theme.h"
#include "ui/look/widgets.h"

namespace odolab::ui {

// Edits the draft's nominal vehicle, its true lengths and what no drawing says of the machine. True lengths come to be
// once they, or the nominal ones, are edited: until then the machine is just as its drawing says.
Edited kind_fields(Scenario& draft, const Theme& theme);

}  // namespace odolab::ui
