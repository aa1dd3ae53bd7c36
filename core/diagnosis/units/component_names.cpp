#include "core/diagnosis/units/component_names.h"

#include <algorithm>

namespace odolab {

namespace {

bool is_name_of_wheels(const std::string& component) {
  return component == "left_wheel" || component == "right_wheel" || component == "both_wheels";
}

}  // namespace

std::string component_of_unit(const std::string& unit, const std::string& component) {
  if (unit.empty() || component == "floor" || component == "truth") return component;
  return is_name_of_wheels(component) ? unit + "." + component : component == "vehicle" ? unit : component;
}

std::optional<std::string> component_in_unit(const std::string& unit, const std::string& component,
                                             const std::vector<VehicleUnit>& all) {
  if (component == "floor" || component == "truth" || component == "vehicle") return component;
  if (!unit.empty() && component == unit) return "vehicle";
  if (!unit.empty() && component.rfind(unit + ".", 0) == 0) return component.substr(unit.size() + 1);
  if (unit.empty() && is_name_of_wheels(component)) return component;
  // of both wheels everywhere, where nothing says whose
  if (is_name_of_wheels(component) &&
      std::none_of(all.begin(), all.end(), [](const VehicleUnit& u) { return u.name.empty(); }))
    return component;
  return std::nullopt;
}

}  // namespace odolab
