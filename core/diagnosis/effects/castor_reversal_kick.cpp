// A heading kick each time that the direction of travel reverses, as the castors swing round.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {
constexpr double kReversed_m = 0.01;  // way back that counts; less is the trembling of a turn on the spot

struct Reversal {
  std::size_t first = 0;  // step of the way back
  std::size_t sure = 0;   // the step by which it counts
  int direction = 1;      // of travel, from here on
};

std::vector<Reversal> reversals(const DriveView& view) {
  std::vector<Reversal> found;
  double travelled_m = 0.0, furthest_m = 0.0;
  std::size_t furthest = 0;
  int direction = 0;
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    travelled_m += view.steps[i].forward_m();
    const double back_m = (direction == 0 ? -1 : direction) * (furthest_m - travelled_m);
    if (direction == 0 && std::abs(travelled_m) > kReversed_m) direction = travelled_m > 0.0 ? 1 : -1;
    if (direction != 0 && back_m > kReversed_m) {
      direction = -direction;
      found.push_back({furthest, i, direction});
    }
    if (direction == 0 || direction * (travelled_m - furthest_m) >= 0.0 || back_m > kReversed_m) {
      furthest_m = travelled_m;
      furthest = i + 1;
    }
  }
  return found;
}

// How a castor swings round. One that trails its pivot by so much obeys d(angle) = -sin(angle) / trail for each metre
// that the pivot goes; turned about, it stands at half a turn and is pushed off by what little it is off that.
struct Swing {
  double over_m;   // evenly, over so much of the way; 0: as it trails
  double trail_m;
};
constexpr Swing kSwings[] = {{0.05, 0.0}, {0.2, 0.0}, {0.001, 0.0}, {0.0, 0.02}, {0.0, 0.05}};
constexpr double kOff = 0.06;  // the sine of what it is off

// One kick at each reversal: at once, or as the castor swings round once it is sure to. Where the vehicle turns back
// before that is done, it swings back.
Motions kicks(const DriveView& view, bool to_one_side, const Swing& swing) {
  Motions m(view.steps.size());
  const std::vector<Reversal> all = reversals(view);
  double left = 0.0, sense = 1.0;  // of the swing, 1 being all of it
  for (std::size_t n = 0; n < all.size(); ++n) {
    const bool turned_back = left > 0.0;
    sense = turned_back ? -sense : 1.0;
    left = turned_back ? 1.0 - left : 1.0;
    const bool at_once = swing.trail_m == 0.0 && swing.over_m < kReversed_m;
    const std::size_t end = n + 1 < all.size() ? (at_once ? all[n + 1].first : all[n + 1].sure) : view.steps.size();
    for (std::size_t i = at_once ? all[n].first : all[n].sure; i < end && left > 0.0; ++i) {
      const double way_m = std::abs(view.steps[i].forward_m());
      const double by = swing.trail_m > 0.0
                            ? way_m / swing.trail_m * (std::sin(kPi * std::min(left, 1.0)) + kOff) / kPi
                            : way_m / swing.over_m;
      const double done = std::min(by, left);
      m[i].turn_rad += (to_one_side ? sense : all[n].direction) * done;
      left -= done;
    }
    if (left < 0.02) left = 0.0;
  }
  return m;
}
}  // namespace

std::vector<Effect> castor_reversal_kick() {
  Effect e;
  e.name = "castor_reversal_kick";
  e.component = "vehicle";
  e.amplitudes = {{"kick_rad", "rad", 0.01, -0.5, 0.5}};
  e.forms = {"always to the same side, within 5 cm of way",
             "to one side forwards and the other in reverse, within 5 cm",
             "always to the same side, within 20 cm",
             "to one side forwards and the other in reverse, within 20 cm",
             "always to the same side, at once",
             "to one side forwards and the other in reverse, at once",
             "always to the same side, as a castor of 2 cm trail swings",
             "to one side forwards and the other in reverse, as a castor of 2 cm trail swings",
             "always to the same side, as a castor of 5 cm trail swings",
             "to one side forwards and the other in reverse, as a castor of 5 cm trail swings"};
  e.sentence = "when the direction of travel reverses, the castors swing round and kick the heading";
  e.regime = "where the direction of travel reverses";
  e.looks_like = {"drivetrain_backlash", "one_sided_drag"};
  e.told_apart_by = "a turn on the spot and then a straight, without reversing a wheel";
  // A driver that stops by its counts always stops just behind one: half a count of each wheel is there at each
  // reversal.
  e.beyond_counts = [](const std::vector<double>& value, const std::vector<double>&, double count_rad,
                       const std::vector<DriveView>& views) {
    return std::all_of(views.begin(), views.end(), [&](const DriveView& view) {
      const DifferentialDrive& d = view.drive;
      const double count_m = count_rad * 0.5 * (d.wheel_radius_left_m + d.wheel_radius_right_m);
      return std::abs(value[0]) * d.wheelbase_m > count_m;
    });
  };
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    const int form = static_cast<int>(shape.back());
    return std::vector<Motions>{kicks(view, form % 2 == 0, kSwings[form / 2])};
  };
  return {e};
}

}  // namespace odolab::effects
