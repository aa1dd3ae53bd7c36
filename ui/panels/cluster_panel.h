// The return errors of both directions in millimetres, as in Fig. 3.4 of the UMBmark report; before and after in one
// plot.
#pragma once

#include "ui/actions.h"
#include "ui/bench.h"
#include "ui/look/theme.h"
#include "ui/plot/plot.h"

namespace odolab::ui {

struct ClusterState {
  PlotView view;
  PlotView enlarged;
  std::size_t points_seen = 0;  // a new point fits the view anew, unless a person has zoomed
};

void cluster_panel(const Bench& bench, ClusterState& state, const Theme& theme);

}  // namespace odolab::ui
