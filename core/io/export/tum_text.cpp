#include "core/io/export/tum_text.h"

#include <cmath>

#include "core/io/number_text.h"
#include "core/io/whole_file.h"

namespace odolab {

std::string tum_text(const Track& track) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const TimedPose& p : track) {
    const double half_rad = 0.5 * wrapped(p.pose.heading_rad);
    for (double value : {p.time_s, p.pose.x_m, p.pose.y_m, 0.0, 0.0, 0.0, std::sin(half_rad), std::cos(half_rad)}) {
      append_number(text, value);
      text += ' ';
    }
    text.back() = '\n';
  }
  return text;
}

Result<Done> write_tum(const std::string& path, const Track& track) { return write_whole_file(path, tum_text(track)); }

}  // namespace odolab
