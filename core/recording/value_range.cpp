#include "core/recording/value_range.h"

#include <cmath>
#include <limits>

#include "core/base/formatted.h"

namespace odolab {

namespace {

struct ColumnRange {
  std::string_view ending;
  const char* unit;
  double most;
};

constexpr ColumnRange kRanges[] = {
    {"_ticks", "counts", 2e19}, {"_radps", "rad/s", 1e6}, {"_mps", "m/s", 1e6}, {"_rad", "rad", 1e9}, {"_m", "m", 1e8}};

const ColumnRange* physical_range(std::string_view channel) {
  for (const ColumnRange& range : kRanges)
    if (channel.ends_with(range.ending)) return &range;
  return nullptr;
}

}  // namespace

double largest_value(std::string_view channel) {
  const ColumnRange* range = physical_range(channel);
  return range ? range->most : std::numeric_limits<double>::infinity();
}

std::string range_text(std::string_view channel) {
  const ColumnRange* range = physical_range(channel);
  return range ? formatted("a number from -%g to %g (%s)", range->most, range->most, range->unit) : "a number";
}

std::optional<Error> value_beyond_range(const Recording& recording) {
  for (const Channel& channel : recording.channels) {
    const double most = largest_value(channel.name);
    for (std::size_t i = 0; i < channel.values.size(); ++i)
      if (std::abs(channel.values[i]) > most)
        return Error{channel.name, formatted("%.9g in row %zu", channel.values[i], i + 1), range_text(channel.name)};
  }
  return std::nullopt;
}

}  // namespace odolab
