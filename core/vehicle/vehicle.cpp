#include "core/vehicle/vehicle.h"

namespace odolab {

std::string kind_name(const Vehicle& vehicle) {
  return std::visit([](const auto& kind) { return std::string(kind.kKind); }, vehicle.kind);
}

std::vector<std::string> problems_in(const VehicleKind& kind) {
  return std::visit([](const auto& k) { return problems_in(k); }, kind);
}

std::optional<Error> other_than_differential_drive(const Vehicle& vehicle, const std::string& what) {
  if (std::holds_alternative<DifferentialDrive>(vehicle.kind)) return std::nullopt;
  return Error{vehicle.name + ": kind", "'" + kind_name(vehicle) + "'",
               "'differential_drive', the only kind that " + what};
}

}  // namespace odolab
