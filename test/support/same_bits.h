// Whether two recordings hold the same numbers, to the bit.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/recording/recording.h"

namespace odolab {

inline std::uint64_t bits(double value) {
  std::uint64_t b = 0;
  std::memcpy(&b, &value, sizeof b);
  return b;
}

inline void expect_same_bits(const Recording& a, const Recording& b) {
  ASSERT_EQ(a.time_s.size(), b.time_s.size());
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    EXPECT_EQ(a.channels[c].name, b.channels[c].name);
    for (std::size_t i = 0; i < a.time_s.size(); ++i)
      if (!(std::isnan(a.channels[c].values[i]) && std::isnan(b.channels[c].values[i]))) {
        ASSERT_EQ(bits(a.channels[c].values[i]), bits(b.channels[c].values[i])) << a.channels[c].name << " row " << i;
      }
  }
}

}  // namespace odolab
