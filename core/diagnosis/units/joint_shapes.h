// What an encoder of a joint may err by, as functions of its reading and of the way it went.
#pragma once

#include <vector>

#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

// A turn holds so many waves, the range of a reading that goes less far so many half waves twice.
constexpr int kWavesOfReading = 4;

// A joint's readings, each the mean of those within a quarter of a second: by a single reading, which errs at random
// and by its rounding, a joint that hardly moves would err by what it reads.
std::vector<double> mean_readings(const std::vector<UnitSample>& samples, std::size_t joint);

// The mean readings of a joint over all recordings.
struct ReadingRange {
  double low = 1e300, high = -1e300;
  bool is_length = false;

  void take_in(const std::vector<UnitSample>& samples, std::size_t joint);
  bool goes_around() const { return !is_length && high - low > kPi; }
  // Over which a picture shows it.
  double first() const { return goes_around() ? -kPi : low; }
  double last() const { return goes_around() ? kPi : high; }
};

// Two values for each wave.
std::vector<double> waves_of_reading(double reading, const ReadingRange& range);

// Which way a reading went last, by more than it rounds: a half, less a half, 0 where it has not moved yet.
std::vector<double> ways_of_reading(const std::vector<UnitSample>& samples, std::size_t joint, double step);

}  // namespace odolab
