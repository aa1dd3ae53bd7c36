#include "core/diagnosis/unnamed_part.h"

#include <string>

namespace odolab {

namespace {

// Empty where the channel is of the vehicle as a whole.
std::string part_of_vehicle(const std::string& channel) {
  if (channel.rfind("truth", 0) == 0 || channel.find("the truth's frame") != std::string::npos) return "truth";
  const bool left = channel.find("left wheel") != std::string::npos,
             right = channel.find("right wheel") != std::string::npos;
  if (channel.find("left and the right") != std::string::npos || left == right) return "";
  return left ? "left_wheel" : "right_wheel";
}

}  // namespace

void say_parts_of_unnamed(Diagnosis& diagnosis, bool has_units) {
  for (Finding& f : diagnosis.findings) {
    if (f.effect != "unknown" || f.is_parted) continue;
    const std::string part = part_of_vehicle(f.where.regime.substr(0, f.where.regime.find(" that depends on ")));
    if (part.empty()) continue;
    if (!has_units && f.component == "vehicle") f.component = part;
    const bool is_of_one_frame = has_units && f.component != "vehicle" && f.component != "truth" &&
                                 f.component != "floor" && f.component.find('.') == std::string::npos;
    if (is_of_one_frame && part != "truth") f.component += "." + part;
  }
}

}  // namespace odolab
