// The electrical noise of a slip ring through which two encoders' pulses come: now and then a burst of false pulses in
// one of them, which the counters keep.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/base/random.h"
#include "physics/wheel_pair.h"

namespace odolab {

class SlipRing {
 public:
  // Bursts come at random, this often in the mean; each has up to `largest_counts` false counts of either sign.
  SlipRing(double bursts_per_s, int largest_counts, std::uint64_t seed)
      : bursts_per_s_(bursts_per_s), largest_counts_(largest_counts), random_(seed) {
    if (bursts_per_s_ > 0.0) next_s_ = waiting_s();
  }

  // False counts of both encoders so far. Times must be asked for in order.
  WheelPair false_counts(double time_s) {
    while (bursts_per_s_ > 0.0 && next_s_ <= time_s) {
      const bool left = random_.uniform() < 0.5;
      const double counts = std::floor(random_.uniform(-largest_counts_, largest_counts_ + 1.0));
      (left ? sum_.left : sum_.right) += counts;
      next_s_ += waiting_s();
    }
    return sum_;
  }

 private:
  double waiting_s() { return -std::log(1.0 - random_.uniform()) / bursts_per_s_; }

  double bursts_per_s_;
  int largest_counts_;
  Random random_;
  double next_s_ = 0.0;
  WheelPair sum_;
};

}  // namespace odolab
