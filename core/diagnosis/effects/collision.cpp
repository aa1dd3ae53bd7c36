// A push from outside: a step of the pose, in the floor's frame, at one time of one recording.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/forms.h"
#include "core/geometry/angles.h"

namespace odolab::effects {

namespace {

// While it is turned by an angle the vehicle goes on being pushed the way that its own sides face: what that comes to
// in the floor's frame is the chord of the arc (the exponential map of planar motion), not the arc.
struct Chord {
  double along, across;  // of one metre
  explicit Chord(double turn_rad) {
    constexpr double kLittle_rad = 1e-6;
    const bool is_little = std::abs(turn_rad) < kLittle_rad;
    along = is_little ? 1.0 : std::sin(turn_rad) / turn_rad;
    across = is_little ? 0.5 * turn_rad : (1.0 - std::cos(turn_rad)) / turn_rad;
  }
  Vec2 of_arc(Vec2 arc) const { return {along * arc.x_m - across * arc.y_m, across * arc.x_m + along * arc.y_m}; }
  Vec2 to_arc(Vec2 chord) const {
    const double square = std::max(1e-6, along * along + across * across);
    return (1.0 / square) * Vec2{along * chord.x_m + across * chord.y_m, along * chord.y_m - across * chord.x_m};
  }
};

// Its heading before it was pushed, as its wheels go on from there. Between two samples of the truth a view turns
// evenly from one to the other, and begins to before the push does; which may have come an interval sooner than is
// thought, so that the one before that is gone back, too.
double heading_before_rad(const DriveView& view, std::size_t pushed) {
  constexpr double kEvenly_radps = 1e-7;
  const auto rate_radps = [&](std::size_t step) {
    const EffectStep &before = view.steps[step - 1], &now = view.steps[step];
    return wrapped(now.heading_rad - before.heading_rad) / std::max(1e-9, now.time_s - before.time_s);
  };
  constexpr int kIntervals = 2;
  std::size_t first = pushed;
  double turned_rad = 0.0;
  for (int k = 0; k < kIntervals && first > 0; ++k) {
    const double evenly_radps = rate_radps(first);
    while (first > 0 && std::abs(rate_radps(first) - evenly_radps) < kEvenly_radps) {
      turned_rad += 0.5 * (view.steps[first - 1].turn_rad + view.steps[first].turn_rad);
      --first;
    }
  }
  return view.steps[first].heading_rad + turned_rad;
}

}  // namespace

std::vector<Effect> collision() {
  Effect e;
  e.name = "collision";
  e.component = "vehicle";
  // Amplitudes: along the arc.
  e.amplitudes = {
      {"dx_m", "m", 0.02, -20.0, 20.0}, {"dy_m", "m", 0.02, -20.0, 20.0}, {"dheading_rad", "rad", 0.03, -4.0, 4.0}};
  e.to_parameters = [](const std::vector<double>& v, const std::vector<double>& se) {
    const Vec2 moved = Chord(v[2]).of_arc({v[0], v[1]});
    return std::vector<FoundParameter>{
        {"dx_m", moved.x_m, se[0], "m"}, {"dy_m", moved.y_m, se[1], "m"}, {"dheading_rad", v[2], se[2], "rad"}};
  };
  e.from_parameters = [](const ActiveEffect& a) {
    const double turn_rad = a.parameter("dheading_rad");
    const Vec2 arc = Chord(turn_rad).to_arc({a.parameter("dx_m"), a.parameter("dy_m")});
    return std::vector<double>{arc.x_m, arc.y_m, turn_rad};
  };
  e.shapes = {{"recording", "1"}, {"at_s", "s"}};
  e.forms = {"at once", "within 0.25 s", "within 0.5 s"};
  e.forms_come_to_one = true;
  e.sentence =
      "something pushed the vehicle, or it was lifted and put down: its pose jumps while the wheels know nothing of it";
  e.regime = "at one moment";
  e.looks_like = {"bump", "truth_frozen"};
  e.told_apart_by = "the same way driven again: a push does not come back";
  e.tests_of_a_shape = 0.5;  // moments 0.12 s apart are one, in whichever form, as long as the truth errs
  e.local = true;
  e.forms_of_the_scan = {1};  // half of the others' length is found by both
  e.of_one_recording = true;
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    if (view.number != static_cast<int>(shape[0])) return std::vector<Motions>(3);
    const double lasts_s = kCollisionLasts_s[static_cast<int>(shape.back())];
    double total_s = 0.0;
    // How much of the way is done: it begins and ends softly, and `at_s` is its middle. At least the interval in which
    // that lies.
    const double begins_s = shape[1] - 0.5 * lasts_s;
    const auto done = [&](double t) {
      return 0.5 - 0.5 * std::cos(kPi * std::clamp((t - begins_s) / lasts_s, 0.0, 1.0));
    };
    const auto within = [&](const EffectStep& s) {
      const double from = s.time_s - 0.5 * s.duration_s, to = s.time_s + 0.5 * s.duration_s;
      if (lasts_s <= 0.0) return shape[1] > from - 1e-9 && shape[1] <= to + 1e-9 && total_s == 0.0 ? to - from : 0.0;
      return to < begins_s || from > begins_s + lasts_s ? 0.0 : done(to) - done(from);
    };
    std::vector<std::pair<std::size_t, double>> acts;
    const std::size_t at = view.step_at(begins_s);
    for (std::size_t i = at > 0 ? at - 1 : 0; i < view.steps.size(); ++i) {
      if (view.steps[i].time_s - 0.5 * view.steps[i].duration_s > begins_s + lasts_s) break;
      if (const double share = within(view.steps[i]); share > 0.0) {
        acts.emplace_back(i, share);
        total_s += share;
      }
    }
    if (acts.empty()) return std::vector<Motions>(3);
    std::vector<Motions> m(3, Motions(acts.front().first, acts.back().first + 1));
    double heading_rad = heading_before_rad(view, acts.front().first);  // as the wheels alone go on
    for (const auto& [i, share] : acts) {
      const double c = std::cos(heading_rad), s = std::sin(heading_rad), part = share / total_s;
      heading_rad += view.steps[i].turn_rad;
      m[0][i] = {part * c, -part * s, 0.0};
      m[1][i] = {part * s, part * c, 0.0};
      m[2][i].turn_rad = part;
    }
    return m;
  };
  e.scan = [](const std::vector<DriveView>& views) {
    return moments(views, 0.12, [](const EffectStep&) { return true; });
  };
  return {e};
}

}  // namespace odolab::effects
