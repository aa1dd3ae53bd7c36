// What one driven wheel does in a step.
#pragma once

namespace odolab {

struct WheelState {
  double rotation_rad = 0.0;  // true, since the start
  double counted_rad = 0.0;   // by an encoder of endless resolution: the same, but for effects between the two
  double speed_radps = 0.0;
  double steered_rad = 0.0;     // of a steered wheel: its direction against its body
  double slip_speed_mps = 0.0;  // tread against floor, along the wheel
  double traction_n = 0.0;      // force of the floor on the wheel, along it
  bool on_bump = false;
  bool in_slip_zone = false;
};

}  // namespace odolab
