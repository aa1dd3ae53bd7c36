// Cases of three runs of forty seconds, what diagnosis says of them, and a truth that is changed sample by sample.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {

inline CaseSettings short_case(const std::string& effect, double size) {
  CaseSettings c;
  c.effect = effect;
  c.size = size;
  c.runs = 3;
  c.duration_s = 40.0;
  return c;
}

inline Diagnosis diagnosed(const Case& c) {
  Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  EXPECT_TRUE(d) << (d ? "" : d.error().message());
  return d ? std::move(*d) : Diagnosis{};
}

// Effects and their components.
inline std::string said(const Diagnosis& d) {
  std::string s;
  for (const Finding& f : d.findings) s += f.effect + ":" + f.component + " ";
  return s;
}

// Calls `change(k, x, y, heading)` for the k-th truth sample.
template <typename Change>
void change_truth(Recording& r, Change&& change) {
  Channel *x = nullptr, *y = nullptr, *heading = nullptr;
  for (Channel& channel : r.channels) {
    if (channel.name == "truth_x_m") x = &channel;
    if (channel.name == "truth_y_m") y = &channel;
    if (channel.name == "truth_heading_rad") heading = &channel;
  }
  for (std::size_t i = 0, k = 0; i < r.time_s.size(); ++i)
    if (!std::isnan(x->values[i])) change(k++, x->values[i], y->values[i], heading->values[i]);
}

}  // namespace odolab::test
