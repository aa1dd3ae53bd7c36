// A straight scale from values to pixels with round ticks.
#pragma once

#include <string>
#include <vector>

namespace odolab {

// The distance between ticks: 1, 2 or 5 times a power of ten, such that about `wanted` of them fit into the range.
double round_step(double range, int wanted);

struct Axis {
  double low = 0.0, high = 1.0;        // values at the ends, low < high
  double low_px = 0.0, high_px = 1.0;  // where they are drawn

  double px(double value) const { return low_px + (value - low) / (high - low) * (high_px - low_px); }
  std::vector<double> ticks(int wanted) const;
};

// The axis over all values with a little air; a single value gets some room around it.
Axis axis_over(double low, double high, double low_px, double high_px);

// A tick's label with just the decimals that the step needs.
std::string tick_text(double value, double step);

}  // namespace odolab
