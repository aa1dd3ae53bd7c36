// What the encoders of linked and castor vehicles read, sample by sample: recordings made typed. Columns that were read
// at other times than the rest are interpolated; see aligned_rows.h.
#pragma once

#include <string>
#include <vector>

#include "core/recording/aligned_rows.h"
#include "core/recording/recording.h"
#include "core/vehicle/multi_castor.h"
#include "core/vehicle/vehicle.h"

namespace odolab {

// Rotation of two wheels since the start.
struct WheelRotation {
  double left_rad = 0.0;
  double right_rad = 0.0;
};

// drive_wheel_rad and steering_rad: what the encoders of a synchro drive's two motors read, at the wheel and the
// turret.
struct SynchroSample {
  double time_s = 0.0;
  double wheel_rad = 0.0;
  double steering_rad = 0.0;
};
std::vector<SynchroSample> synchro_samples(const Recording& recording);

// a_left_wheel_rad …, b_…, link_angle_a_rad, link_angle_b_rad, link_length_m: as read, offsets included.
struct LinkedSample {
  double time_s = 0.0;
  WheelRotation a, b;
  double link_angle_a_rad = 0.0;
  double link_angle_b_rad = 0.0;
  double link_length_m = 0.0;
};
std::vector<LinkedSample> linked_samples(const Recording& recording);

// left_wheel_rad, right_wheel_rad, trailer_left_wheel_rad, trailer_right_wheel_rad, hitch_angle_rad.
struct TrailerSample {
  double time_s = 0.0;
  WheelRotation tow, trailer;
  double hitch_angle_rad = 0.0;
};
std::vector<TrailerSample> trailer_samples(const Recording& recording);

// castor1_left_wheel_rad, castor1_right_wheel_rad, castor1_pivot_rad, … as many as there are.
struct CastorReading {
  WheelRotation wheels;
  double pivot_rad = 0.0;  // as read, the encoder's offset included; unwrapped
};
struct CastorSample {
  double time_s = 0.0;
  std::vector<CastorReading> castors;
};
std::vector<CastorSample> castor_samples(const Recording& recording, std::size_t castors);

// The other way: a recording that holds these samples and nothing else.
Recording recording_of(const std::vector<SynchroSample>& samples);
Recording recording_of(const std::vector<LinkedSample>& samples);
Recording recording_of(const std::vector<TrailerSample>& samples);
Recording recording_of(const std::vector<CastorSample>& samples);

// What a vehicle's encoders read, in the order of the samples above.
std::vector<AlignedChannel> encoders_of(const VehicleKind& kind);

// The columns of a linked or castor vehicle's encoders; none of any other.
std::vector<std::string> encoder_columns(const Vehicle& vehicle);

// The columns that an encoder-based estimate of such a vehicle needs and this recording lacks, e.g. "link_angle_a_rad,
// link_length_m"; empty where nothing is missing.
std::string missing_columns(const Recording& recording, const Vehicle& vehicle);
// The same as an error of the recording; none where nothing is missing.
std::optional<Error> lacks_encoders(const Recording& recording, const Vehicle& vehicle);

}  // namespace odolab
