#include "core/recording/aligned_rows.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angles.h"

namespace odolab {

namespace {

bool holds_anything(const Channel* channel) {
  return channel &&
         std::any_of(channel->values.begin(), channel->values.end(), [](double v) { return !std::isnan(v); });
}

void unwrap(std::vector<double>& values) {
  double previous = std::nan("");
  for (double& v : values) {
    if (std::isnan(v)) continue;
    if (!std::isnan(previous)) v = unwrapped(v, previous);
    previous = v;
  }
}

}  // namespace

AlignedRows aligned_rows(const Recording& recording, const std::vector<AlignedChannel>& channels) {
  AlignedRows rows;
  if (channels.empty() || !missing_of(recording, channels).empty()) return rows;
  const std::size_t n = recording.time_s.size();
  std::vector<std::vector<double>> columns;
  std::vector<char> read(n, 0);
  for (const AlignedChannel& wanted : channels) {
    columns.push_back(recording.channel(wanted.name)->values);
    for (std::size_t i = 0; i < n; ++i) read[i] = read[i] || !std::isnan(columns.back()[i]);
    if (wanted.is_angle) unwrap(columns.back());
    fill_between(recording.time_s, columns.back());
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> row;
    for (const std::vector<double>& column : columns) row.push_back(column[i]);
    if (!read[i] || std::any_of(row.begin(), row.end(), [](double v) { return std::isnan(v); })) continue;
    rows.time_s.push_back(recording.time_s[i]);
    rows.values.push_back(std::move(row));
  }
  return rows;
}

std::string missing_of(const Recording& recording, const std::vector<AlignedChannel>& channels) {
  std::string names;
  for (const AlignedChannel& wanted : channels)
    if (!holds_anything(recording.channel(wanted.name))) names += (names.empty() ? "" : ", ") + wanted.name;
  return names;
}

}  // namespace odolab
