// Play between encoder and wheel: after a reversal the encoder turns through the gap before the wheel follows.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {
// Rotation lost in the play, as a share of the gap, for one wheel. A stop swings back by less than smoothing leaves,
// and that crosses the gap too.
std::vector<double> lost(const DriveView& view, bool left, double gap_rad, bool begins_engaged) {
  std::vector<double> share(view.steps.size());
  const double half = 0.5 * std::max(gap_rad, 1e-4);
  double place = 0.0;  // of the encoder's side within the play, -half to half
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const double by = left ? view.steps[i].left_read_rad : view.steps[i].right_read_rad;
    if (i == 0 && begins_engaged) {  // where the play stood at the start shows only in the first movement's direction
      for (const EffectStep& s : view.steps)
        if (const double b = left ? s.left_read_rad : s.right_read_rad; b != 0.0) {
          place = b > 0.0 ? half : -half;
          break;
        }
    }
    const double next = std::max(-half, std::min(half, place + by));
    share[i] = (next - place) / (2.0 * half);
    place = next;
  }
  return share;
}

// How often a wheel turns back by more than so much.
int reversals_of(const DriveView& view, bool left, double more_rad) {
  int reversals = 0;
  double turned = 0.0, furthest = 0.0, direction = 0.0;
  for (const EffectStep& s : view.steps) {
    turned += left ? s.left_read_rad : s.right_read_rad;
    if (direction * (turned - furthest) >= 0.0 && direction != 0.0) {
      furthest = turned;
    } else if (std::abs(turned - furthest) > more_rad) {
      reversals += direction != 0.0;
      direction = turned > furthest ? 1.0 : -1.0;
      furthest = turned;
    }
  }
  return reversals;
}

Effect of_wheel(Wheel wheel) {
  Effect e;
  e.name = "drivetrain_backlash";
  e.component = component_of(wheel);
  e.amplitudes = {{"gap_rad", "rad", 0.03, 0.0, 1.0}};
  e.shapes = {{"gap_rad", "rad"}};
  e.shape_follows_amplitude = true;
  e.forms = {"engaged at the start", "in the middle of the play at the start"};
  e.sentence = std::string("there is play between the encoder and ") + (wheel == Wheel::left    ? "the left wheel"
                                                                        : wheel == Wheel::right ? "the right wheel"
                                                                                                : "both wheels");
  e.regime = "after a wheel reverses";
  e.looks_like = {"castor_reversal_kick", "traction_slip"};
  e.told_apart_by = "a stop and then on in the same direction, and a turn on the spot and then a straight";
  // Where a wheel turns back its reading is off by what is hidden between two counts, one way or the other: in the mean
  // over all reversals by a count over the root of six times their number, of which four are taken. A driver that turns
  // back by its counts makes that one way always: play of less than a count is never told from it.
  e.beyond_counts = [wheel](const std::vector<double>& value, const std::vector<double>&, double count_rad,
                            const std::vector<DriveView>& views) {
    int reversals = 0;
    for (const DriveView& view : views) {
      if (wheel != Wheel::right) reversals += reversals_of(view, true, 3.0 * count_rad);
      if (wheel != Wheel::left) reversals += reversals_of(view, false, 3.0 * count_rad);
    }
    return value[0] > count_rad * std::max(1.0, 4.0 / std::sqrt(6.0 * std::max(reversals, 1)));
  };
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    Motions m(view.steps.size());
    const DifferentialDrive& drive = view.drive;
    const auto add = [&](Wheel w) {
      const std::vector<double> share = lost(view, w == Wheel::left, shape[0], shape.back() < 0.5);
      const double r = w == Wheel::left ? drive.wheel_radius_left_m : drive.wheel_radius_right_m;
      for (std::size_t i = 0; i < share.size(); ++i) {
        const BodyMotion b = by_wheel(w, -r * share[i], drive.wheelbase_m);
        m[i].forward_m += b.forward_m;
        m[i].turn_rad += b.turn_rad;
      }
    };
    if (wheel != Wheel::right) add(Wheel::left);
    if (wheel != Wheel::left) add(Wheel::right);
    return std::vector<Motions>{m};
  };
  e.scan = [](const std::vector<DriveView>&) {
    return std::vector<std::vector<double>>{{0.005}, {0.01}, {0.02}, {0.03}, {0.05}, {0.08}, {0.12}};
  };
  return e;
}
}  // namespace

std::vector<Effect> drivetrain_backlash() {
  return {of_wheel(Wheel::left), of_wheel(Wheel::right), of_wheel(Wheel::both)};
}

}  // namespace odolab::effects
