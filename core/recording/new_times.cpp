#include "core/recording/new_times.h"

#include <algorithm>
#include <cmath>

namespace odolab {

Recording with_new_times(const Recording& old, const std::vector<NewTimes>& moved) {
  struct Row {
    double time_s;
    std::size_t from;
    int part;  // which of `moved`; -1: what keeps its time
  };
  std::vector<Row> rows;
  for (std::size_t i = 0; i < old.time_s.size(); ++i) {
    bool keeps = false, moves = false;
    for (const Channel& c : old.channels) {
      if (std::isnan(c.values[i])) continue;
      bool is_moved = false;
      for (const NewTimes& e : moved) is_moved = is_moved || (e.belongs(c.name) && !std::isnan(e.time_s[i]));
      keeps = keeps || !is_moved;
      moves = moves || is_moved;
    }
    if (keeps || !moves) rows.push_back({old.time_s[i], i, -1});
    for (std::size_t p = 0; p < moved.size(); ++p)
      if (!std::isnan(moved[p].time_s[i])) rows.push_back({moved[p].time_s[i], i, static_cast<int>(p)});
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.time_s < b.time_s; });
  Recording made{old.name, old.provenance, {}, {}};
  for (const Row& r : rows) made.time_s.push_back(r.time_s);
  for (const Channel& c : old.channels) {
    Channel& values = made.add_channel(c.name);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      int part = -1;
      for (std::size_t p = 0; p < moved.size(); ++p)
        if (moved[p].belongs(c.name) && !std::isnan(moved[p].time_s[rows[k].from])) part = static_cast<int>(p);
      if (part == rows[k].part) values.values[k] = c.values[rows[k].from];
    }
  }
  return made;
}

}  // namespace odolab
