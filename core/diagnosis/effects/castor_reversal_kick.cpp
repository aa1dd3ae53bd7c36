// A heading kick each time that the direction of travel reverses, as the castors swing round.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/forms.h"
#include "core/diagnosis/effects/mean_rate.h"
#include "core/diagnosis/effects/reversals.h"

namespace odolab::effects {

namespace {
// The steps from which on it goes the other way by its speed: a stop that swings back faster than so much is one, too,
// however short.
std::vector<std::size_t> reversals_by_speed(const DriveView& view) {
  constexpr double kHalfWindow_s = 0.05;
  // As read: smoothed, a swing is gone.
  const std::vector<double> speed_mps = mean_rate(view, kHalfWindow_s, [&](const EffectStep& s) {
    return 0.5 *
           (view.drive.wheel_radius_left_m * s.left_read_rad + view.drive.wheel_radius_right_m * s.right_read_rad);
  });
  std::vector<std::size_t> found;
  int direction = 0;
  for (std::size_t i = 0; i < speed_mps.size(); ++i) {
    const int now = speed_mps[i] > kLeastSwing_mps ? 1 : speed_mps[i] < -kLeastSwing_mps ? -1 : 0;
    if (now == 0 || now == direction) continue;
    if (direction != 0) found.push_back(i);
    direction = now;
  }
  return found;
}

// A kick that lasts so long at each of them, always to the same side: by direction those of a swing would cancel.
Motions short_kicks(const DriveView& view) {
  Motions m(view.steps.size());
  for (const std::size_t reversed : reversals_by_speed(view)) {
    double since_s = 0.0;
    for (std::size_t i = reversed; i < view.steps.size() && since_s < kShortKick_s; ++i) {
      const double lasts_s = std::min(view.steps[i].duration_s, kShortKick_s - since_s);
      m[i].turn_rad += lasts_s / kShortKick_s;
      since_s += view.steps[i].duration_s;
    }
  }
  return m;
}

// The way that counts step by step from a reversal on: until it is sure only what leads further back than before, since
// a turn on the spot trembles.
class WayBack {
 public:
  explicit WayBack(const Reversal& reversal) : reversal_(reversal) {}
  double of_step(const DriveView& view, std::size_t i) {
    if (i > reversal_.sure) return std::abs(view.steps[i].forward_m());
    gone_m_ += reversal_.direction * view.steps[i].forward_m();
    const double more_m = std::max(0.0, gone_m_ - furthest_m_);
    furthest_m_ += more_m;
    return more_m;
  }

 private:
  const Reversal& reversal_;
  double gone_m_ = 0.0, furthest_m_ = 0.0;
};

// One kick at each reversal: at once, or spread over so much of the way once it is sure to, since a castor that was
// turned about hardly swings at first.
Motions even_kicks(const DriveView& view, bool to_one_side, double over_m) {
  Motions m(view.steps.size());
  for (const Reversal& r : reversals(view)) {
    double since_m = 0.0;
    for (std::size_t i = over_m < kReversed_m ? r.first : r.sure; i < view.steps.size() && since_m < over_m; ++i) {
      const double way_m = std::abs(view.steps[i].forward_m());
      m[i].turn_rad += (to_one_side ? 1.0 : r.direction) * std::min(way_m, over_m - since_m) / over_m;
      since_m += way_m;
    }
  }
  return m;
}

// Of what is left of a kick each metre takes 1 / over_m, as friction that lets go.
Motions fading_kicks(const DriveView& view, bool to_one_side, double over_m) {
  constexpr double kGone = 1e-3;
  Motions m(view.steps.size());
  for (const Reversal& r : reversals(view)) {
    double left = 1.0;
    WayBack way_back(r);
    for (std::size_t i = r.first; i < view.steps.size() && left > kGone; ++i) {
      const double gone = left * -std::expm1(-way_back.of_step(view, i) / over_m);
      m[i].turn_rad += (to_one_side ? 1.0 : r.direction) * gone;
      left -= gone;
    }
  }
  return m;
}

// As a castor swings round that trails its pivot by so much: d(angle) = -sin(angle) / trail for each metre that the
// pivot goes. Turned about, it stands at half a turn and is pushed off by what little it is off that. Where the vehicle
// turns back before it is round, it swings back.
Motions kicks_of_a_castor(const DriveView& view, bool to_one_side, double trail_m) {
  Motions m(view.steps.size());
  const std::vector<Reversal> all = reversals(view);
  double left = 0.0, sense = 1.0;  // of half a turn
  for (std::size_t n = 0; n < all.size(); ++n) {
    const bool turned_back = left > kCastorRound;
    sense = turned_back ? -sense : 1.0;
    left = turned_back ? 1.0 - left : 1.0;
    const std::size_t end = n + 1 < all.size() ? all[n + 1].first : view.steps.size();
    WayBack way_back(all[n]);
    for (std::size_t i = all[n].first; i < end && left > 0.0; ++i) {
      const double way_m = way_back.of_step(view, i);
      const double swung = std::min(left, way_m / trail_m * (std::sin(kPi * left) + kCastorOff) / kPi);
      m[i].turn_rad += (to_one_side ? sense : all[n].direction) * swung;
      left -= swung;
    }
  }
  return m;
}
}  // namespace

std::vector<Effect> castor_reversal_kick() {
  Effect e;
  e.name = "castor_reversal_kick";
  e.component = "vehicle";
  e.amplitudes = {{"kick_rad", "rad", 0.01, -0.5, 0.5}};
  for (const auto& form : kKickForms) e.forms.push_back(form.in_words);
  e.forms_have_sides = true;
  e.sentence = "when the direction of travel reverses, the castors swing round and kick the heading";
  e.regime = "where the direction of travel reverses";
  e.tests_of_a_shape = 0.6;  // kicks are much alike, however long they last
  e.looks_like = {"drivetrain_backlash", "one_sided_drag"};
  e.told_apart_by = "a turn on the spot and then a straight, without reversing a wheel";
  // A driver that stops by its counts always stops just behind one: half a count of each wheel is there at each
  // reversal. What stops have in common is fitted beside it (counts_at_rest); half of that is doubted still.
  e.beyond_counts = [](const std::vector<double>& value, const std::vector<double>&, double count_rad,
                       const std::vector<DriveView>& views) {
    return std::all_of(views.begin(), views.end(), [&](const DriveView& view) {
      const DifferentialDrive& d = view.drive;
      const double count_m = count_rad * 0.5 * (d.wheel_radius_left_m + d.wheel_radius_right_m);
      return std::abs(value[0]) * d.wheelbase_m > 0.5 * count_m;
    });
  };
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    const auto& [in_words, to_one_side, course, length_m] = kKickForms[static_cast<std::size_t>(shape.back())];
    switch (course) {
      case KickCourse::evenly:
        return motions_by_number(even_kicks(view, to_one_side, length_m));
      case KickCourse::fading:
        return motions_by_number(fading_kicks(view, to_one_side, length_m));
      case KickCourse::of_a_castor:
        return motions_by_number(kicks_of_a_castor(view, to_one_side, length_m));
      case KickCourse::shortly:
        break;
    }
    return motions_by_number(short_kicks(view));
  };
  return {e};
}

}  // namespace odolab::effects
