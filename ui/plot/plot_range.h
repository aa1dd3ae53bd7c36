// What a fitted plot shows.
#pragma once

#include "ui/plot/plot.h"

namespace odolab::ui {

// The view in which all data is in sight with a little air around, in a drawing area of that size.
void fit(const Plot& what, PlotView& view, float width, float height);

}  // namespace odolab::ui
