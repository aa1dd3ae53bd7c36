#include "core/diagnosis/counts_at_rest.h"

namespace odolab {

std::array<Motions, 2> counts_at_rest(const InnovationRun& run, const DifferentialDrive& drive) {
  constexpr double kRest_s = 0.2;  // a slow wheel also waits for its next count, but not as long
  const int n = static_cast<int>(run.wheels.size()) - 1;
  std::array<Motions, 2> of_wheel{Motions(n), Motions(n)};
  const double half_count_rad = 0.5 * count_rad(run, drive);
  if (half_count_rad <= 0.0) return of_wheel;
  for (const Wheel wheel : {Wheel::left, Wheel::right}) {
    const bool left = wheel == Wheel::left;
    const double radius_m = left ? drive.wheel_radius_left_m : drive.wheel_radius_right_m;
    const auto by = [&](int i) {
      const WheelSample &a = run.wheels[i], &b = run.wheels[i + 1];
      return left ? b.left_rad - a.left_rad : b.right_rad - a.right_rad;
    };
    const auto add = [&](int i, double half_counts) {
      const BodyMotion m = by_wheel(wheel, half_counts * half_count_rad * radius_m, drive.wheelbase_m);
      BodyMotion& sum = of_wheel[left ? 0 : 1][i];
      sum.forward_m += m.forward_m;
      sum.turn_rad += m.turn_rad;
    };
    int moved = -1;  // the last interval in which the wheel turned
    for (int i = 0; i < n; ++i) {
      if (by(i) == 0.0) continue;
      const double way = moved >= 0 && by(moved) < 0.0 ? -1.0 : 1.0;
      if (moved >= 0 && run.wheels[i].time_s - run.wheels[moved + 1].time_s > kRest_s) {
        add(moved, -way);
        add(i, way);
      }
      moved = i;
    }
    if (moved >= 0 && run.wheels[n].time_s - run.wheels[moved + 1].time_s > kRest_s)
      add(moved, by(moved) < 0.0 ? 1.0 : -1.0);
  }
  return of_wheel;
}

}  // namespace odolab
