// Play between encoder and wheel: after a reversal the encoder turns through the gap before the wheel follows.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/forms.h"
#include "core/diagnosis/effects/mean_rate.h"

namespace odolab::effects {

namespace {
// Which way a wheel turns first.
double first_direction(const DriveView& view, bool left) {
  for (const EffectStep& s : view.steps)
    if (const double by = left ? s.left_read_rad : s.right_read_rad; by != 0.0) return by > 0.0 ? 1.0 : -1.0;
  return 0.0;
}

// Rotation in each step, of readings a tenth of a second to either side: a count must not look like a change of speed,
// nor a motor's braking be blurred.
std::vector<double> evenly_read(const DriveView& view, bool left) {
  constexpr double kHalfWindow_s = 0.1;
  std::vector<double> by =
      mean_rate(view, kHalfWindow_s, [&](const EffectStep& s) { return left ? s.left_read_rad : s.right_read_rad; });
  for (std::size_t i = 0; i < by.size(); ++i) by[i] *= view.steps[i].duration_s;
  return by;
}

// Rotation lost in the play, as a share of the gap, for one wheel. A stop swings back by less than smoothing leaves,
// and that crosses the gap too. A wheel that runs easily crosses it besides wherever its motor slows down faster than
// the wheel does by itself: then the wheel drives on until the other flank holds it.
std::vector<double> lost(const DriveView& view, bool left, double gap_rad, std::size_t form) {
  std::vector<double> share(view.steps.size());
  const double half = 0.5 * std::max(gap_rad, kPlayForms[form].yields_rad);
  const double radius_m = left ? view.drive.wheel_radius_left_m : view.drive.wheel_radius_right_m;
  const double drag_radps2 = kPlayForms[form].drag_mps2 / radius_m;
  // Of the encoder's side within the play, -half to half: where it stood at the start shows only in the first
  // movement's direction.
  double place = form == kMiddleAtTheStart ? 0.0 : half * first_direction(view, left);
  double wheel_radps = 0.0;
  const std::vector<double> even = drag_radps2 > 0.0 ? evenly_read(view, left) : std::vector<double>{};
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    double by = left ? s.left_read_rad : s.right_read_rad, runs_on = 0.0;
    if (drag_radps2 > 0.0) {
      by = even[i];
      const double slower = std::min(std::abs(wheel_radps), drag_radps2 * s.duration_s);
      wheel_radps -= std::copysign(slower, wheel_radps);
      runs_on = wheel_radps * s.duration_s;
    }
    const double free = place + by - runs_on;
    const double next = std::clamp(free, -half, half);
    if (next != free) wheel_radps = by / std::max(s.duration_s, 1e-6);  // a flank carries it along
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

Effect play_of(Wheel wheel) {
  Effect e;
  e.name = "drivetrain_backlash";
  e.component = component_of(wheel);
  e.amplitudes = {{"gap_rad", "rad", 0.03, 0.0, 1.0}};
  e.shapes = {{"gap_rad", "rad"}};
  e.shape_follows_amplitude = true;
  for (const auto& form : kPlayForms) e.forms.push_back(form.in_words);
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
      const std::vector<double> share = lost(view, w == Wheel::left, shape[0], static_cast<std::size_t>(shape.back()));
      const double r = w == Wheel::left ? drive.wheel_radius_left_m : drive.wheel_radius_right_m;
      for (std::size_t i = 0; i < share.size(); ++i) {
        const BodyMotion b = by_wheel(w, -r * share[i], drive.wheelbase_m);
        m[i].forward_m += b.forward_m;
        m[i].turn_rad += b.turn_rad;
      }
    };
    if (wheel != Wheel::right) add(Wheel::left);
    if (wheel != Wheel::left) add(Wheel::right);
    return motions_by_number(std::move(m));
  };
  e.scan = [](const std::vector<DriveView>&) { return std::vector<std::vector<double>>{{0.01}, {0.06}}; };
  return e;
}
}  // namespace

std::vector<Effect> drivetrain_backlash() {
  return {play_of(Wheel::left), play_of(Wheel::right), play_of(Wheel::both)};
}

}  // namespace odolab::effects
