#include "core/diagnosis/units/axle_put_off.h"

#include <algorithm>

namespace odolab {

Pose AxlePutOff::at(double t) const {
  const auto after = std::upper_bound(time_s.begin() + 1, time_s.end() - 1, t);
  const auto b = static_cast<std::size_t>(after - time_s.begin()), a = b - 1;
  const double u = std::clamp((t - time_s[a]) / (time_s[b] - time_s[a]), 0.0, 1.0);
  return {by[a].x_m + u * (by[b].x_m - by[a].x_m), by[a].y_m + u * (by[b].y_m - by[a].y_m),
          by[a].heading_rad + u * (by[b].heading_rad - by[a].heading_rad)};
}

BodyMotion AxlePutOff::moved(double middle_s, double duration_s, double forward_m, double turn_rad) const {
  const Pose before = at(middle_s - 0.5 * duration_s), after = at(middle_s + 0.5 * duration_s);
  return {after.x_m - turn_rad * after.y_m - before.x_m,
          after.y_m + turn_rad * after.x_m - before.y_m - before.heading_rad * forward_m,
          after.heading_rad - before.heading_rad};
}

AxlePutOff axle_put_off(const std::vector<UnitSample>& samples, const Vehicle& vehicle, std::size_t unit,
                        const std::function<void(Vehicle& vehicle, std::vector<double>& joints, double by)>& changed) {
  constexpr double kStep = 1e-5;
  AxlePutOff off;
  Vehicle other;
  for (const UnitSample& s : samples) {
    other = vehicle;
    std::vector<double> joints = s.joints;
    changed(other, joints, kStep);
    const Pose by = between(tracked_T_axle(vehicle, unit, s.joints), tracked_T_axle(other, unit, joints));
    off.time_s.push_back(s.time_s);
    off.by.push_back({by.x_m / kStep, by.y_m / kStep, by.heading_rad / kStep});
  }
  return off;
}

}  // namespace odolab
