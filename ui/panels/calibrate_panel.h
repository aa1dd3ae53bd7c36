// The guide through UMBmark: drive squares both ways, calibrate, drive again.
#pragma once

#include "ui/actions.h"
#include "ui/bench.h"
#include "ui/look/theme.h"

namespace odolab::ui {

struct CalibrateState {
  int runs_each_way = 5;
  bool keep_things = false;
};

Actions calibrate_panel(const Bench& bench, CalibrateState& state, const Theme& theme);

}  // namespace odolab::ui
