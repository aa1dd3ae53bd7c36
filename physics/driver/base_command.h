// What a driver asks of a base.
#pragma once

namespace odolab {

struct BaseCommand {
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
  double sideways_mps = 0.0;  // to the left; only bases that can go every way look at it
};

}  // namespace odolab
