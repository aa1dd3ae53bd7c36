// An encoder that stands still while the vehicle drives on.
#pragma once

#include "core/calibration/innovations.h"
#include "core/calibration/left_out.h"
#include "core/diagnosis/effects/effect.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// Where a wheel's readings hold while the truth carries that wheel on: further than the truth errs, about as fast as it
// turned before, and in the middle of that time as well, since a clock that is late lets the truth drive on into a
// rest. From the reading that holds to the one that does no more. `truth` by the wheels' clock.
TimeStretches standing_encoder(const std::vector<WheelSample>& wheels, Wheel wheel,
                               const std::vector<TruthSample>& truth, const Vehicle& vehicle);

// Where they hold and then catch up at once: no wheel does that, whatever the truth says.
TimeStretches catching_up_encoder(const std::vector<WheelSample>& wheels, Wheel wheel);

// Where they hold for two intervals and more between a pace and the same again, to and from which no wheel comes within
// one reading, while the other wheel goes on. The pace may change evenly, unless they hold for more than five.
TimeStretches halting_encoder(const std::vector<WheelSample>& wheels, Wheel wheel, const DifferentialDrive& drive);

// Where they hold for so many intervals and more between two paces, to neither of which any wheel comes within one
// reading. Whether the vehicle stood, something else must say.
TimeStretches abrupt_holds(const std::vector<WheelSample>& wheels, Wheel wheel, const DifferentialDrive& drive,
                           std::size_t fewest);

// Where a count moves in one short reading though both wheels rest in those before and behind it: whoever nudges a
// wheel takes longer.
TimeStretches moved_at_rest(const std::vector<WheelSample>& wheels, Wheel wheel);

// What a wheel turns meanwhile if it goes evenly from the pace before to that behind.
struct EvenlyBetween {
  double before_radps = 0.0, behind_radps = 0.0, lasts_s = 0.0;
  double gone_rad(double since_s) const {
    return since_s * (before_radps + 0.5 * since_s / lasts_s * (behind_radps - before_radps));
  }
};
inline constexpr std::size_t kReadingsOfPace = 5;

inline double rotation(const WheelSample& s, Wheel wheel) { return wheel == Wheel::left ? s.left_rad : s.right_rad; }

// Readings of a wheel that are alike: the first and the last of each two and more, from that reading on.
struct HeldReadings {
  std::size_t first, last;
};
std::vector<HeldReadings> held_readings(const std::vector<WheelSample>& wheels, Wheel wheel, std::size_t from = 0);

// The smallest step that was read of a wheel.
double least_count_rad(const std::vector<WheelSample>& wheels, Wheel wheel);

}  // namespace odolab
