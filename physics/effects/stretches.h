// Stretches of time in which something is wrong: once, or again and again.
#pragma once

#include <cmath>

#include "core/diagnosis/active_effect.h"

namespace odolab::planar {

// From `at_s` on for `lasts_s`, and with `every_s` again after each such time; without `at_s` first after `every_s`.
class Stretches {
 public:
  Stretches(const ActiveEffect& a, double lasts_otherwise_s)
      : every_s_(a.parameter("every_s")),
        at_s_(a.parameter("at_s", every_s_)),
        lasts_s_(a.parameter("lasts_s", lasts_otherwise_s)) {}

  bool hold(double time_s) const {
    const double since_s = time_s - at_s_;
    if (since_s < -kSame_s) return false;
    const double into_s = every_s_ > 0.0 ? since_s - every_s_ * std::floor((since_s + kSame_s) / every_s_) : since_s;
    return into_s < lasts_s_ - kSame_s;
  }

 private:
  static constexpr double kSame_s = 1e-9;  // times that differ by rounding alone
  double every_s_, at_s_, lasts_s_;
};

}  // namespace odolab::planar
