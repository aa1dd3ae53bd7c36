#include "core/diagnosis/model/counts_at_rest.h"

#include "core/calibration/rests.h"

namespace odolab {

std::array<Motions, 2> counts_at_rest(const InnovationRun& run, const DifferentialDrive& drive) {
  const std::size_t n = run.wheels.size() - 1;
  std::array<Motions, 2> of_wheel{Motions(n), Motions(n)};
  const double half_count_rad = 0.5 * count_rad(run, drive);
  if (half_count_rad <= 0.0) return of_wheel;
  for (const Wheel wheel : {Wheel::left, Wheel::right}) {
    const bool left = wheel == Wheel::left;
    const double radius_m = left ? drive.wheel_radius_left_m : drive.wheel_radius_right_m;
    for (const RestEdge& edge : rest_edges(run.wheels, left ? &WheelSample::left_rad : &WheelSample::right_rad)) {
      const double way = (edge.sets_off ? 1.0 : -1.0) * edge.direction * half_count_rad * radius_m;
      const BodyMotion m = by_wheel(wheel, way, drive.wheelbase_m);
      BodyMotion& sum = of_wheel[left ? 0 : 1][static_cast<std::size_t>(edge.interval)];
      sum.forward_m += m.forward_m;
      sum.turn_rad += m.turn_rad;
    }
  }
  return of_wheel;
}

}  // namespace odolab
