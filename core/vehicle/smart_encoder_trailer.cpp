#include "core/vehicle/smart_encoder_trailer.h"

#include "core/vehicle/demands.h"

namespace odolab {

std::vector<std::string> problems_in(const SmartEncoderTrailer& v) {
  Demands demands;
  demands.above_zero("drawbar_length_m", v.drawbar_length_m, "a length in metres");
  demands.length_below("drawbar_length_m", v.drawbar_length_m, 50.0);
  demands.zero_or_more("hitch_angle_resolution_rad", v.hitch_angle_resolution_rad, "an angle");
  demands.within("hitch_angle_resolution_rad", v.hitch_angle_resolution_rad, 1.0, "an angle in radians");
  demands.within("hitch_angle_offset_rad", v.hitch_angle_offset_rad, 7.0, "an angle in radians");
  demands.add(problems_in_truck("tow", v.tow));
  demands.add(problems_in_truck("trailer", v.trailer));
  return std::move(demands).problems();
}

}  // namespace odolab
