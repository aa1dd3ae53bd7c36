#include "core/odometry/encoder_trailer.h"

namespace odolab {

Pose trailer_T_tow(const EncoderTrailer& vehicle, double hitch_reading_rad) {
  const Pose trailer_T_hitch{vehicle.drawbar_length_m, 0.0, hitch_reading_rad - vehicle.hitch_angle_offset_rad};
  const Pose hitch_T_tow{vehicle.hitch_offset_m, 0.0, 0.0};
  return trailer_T_hitch * hitch_T_tow;
}

Track trailer_reckoned(const std::vector<TrailerSample>& samples, const EncoderTrailer& vehicle, const Pose& start,
                       HeadingRule rule) {
  Track track;
  track.reserve(samples.size());
  Pose trailer;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const TrailerSample& now = samples[i];
    const Pose to_tow = trailer_T_tow(vehicle, now.hitch_angle_rad);
    if (i == 0) {
      trailer = start * inverse(to_tow);
    } else {
      trailer = dead_reckoned(trailer, samples[i - 1].trailer, now.trailer, vehicle.trailer, rule);
    }
    track.push_back({now.time_s, trailer * to_tow});
  }
  return track;
}

}  // namespace odolab
