// A robot that is pushed once.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "test/support/missing_physics.h"

namespace odolab::test {

// Three runs of 40 s, in the second of which something shoves the robot along the room's x axis for a tenth of a
// second.
inline std::vector<Recording> runs_with_a_push(double push_m, double at_s) {
  Random random(21);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0005, 0.01);
  g.duration_s = 40.0;
  return three_runs(
      g, random, [&](int) { return varied_driving(random, 40.0); },
      [=](int run) -> std::function<void(InjectedStep&)> {
        return [=](InjectedStep& s) {
          if (run == 1 && std::abs(s.time_s - at_s) < 0.05) s.room_m.x_m += push_m * s.dt_s / 0.1;
        };
      });
}

}  // namespace odolab::test
