// What an absolute encoder of finite resolution says against an expected angle.
#pragma once

namespace odolab {

// How far an estimate is moved towards a reading that only tells in which step of the encoder the angle lies.
enum class ResolutionRule {
  as_printed,        // all the way to the reading, Eq. 13 to the letter: its rounding enters every time
  dead_band,         // all the way, but only where they differ by more than a step (CLAPPER paper, section 5.1)
  least_correction,  // just into the range of angles that round to the reading
};

// The correction of an expected angle, from the difference `reading minus expected` (modulo a turn) and the encoder's
// step; a step of 0 is an encoder without rounding, and all rules agree.
double correction_rad(double difference_rad, double step_rad, ResolutionRule rule);

}  // namespace odolab
