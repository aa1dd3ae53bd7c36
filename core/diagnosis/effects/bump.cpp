// A wheel climbs something: it turns more than it travels, at one moment of one recording, alone or as the other does,
// or each time that it comes to one place on the floor.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/diagnosis/effects/climbing.h"
#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/floor.h"
#include "core/diagnosis/effects/forms.h"

namespace odolab::effects {

namespace {

// So much of a wheel's way from a step on.
Steps steps_from(const DriveView& view, Wheel wheel, std::size_t first, double length_m) {
  Steps s{first, first};
  double gone = std::abs(way_of(view.steps[first], wheel));
  while (s.last + 1 < view.steps.size() && gone < length_m &&
         view.steps[s.last].time_s - view.steps[first].time_s < kLongestBump_s)
    gone += std::abs(way_of(view.steps[++s.last], wheel));
  return s;
}

// The step so much of the axle's way behind another, or before it where that is negative.
std::size_t step_on(const DriveView& view, std::size_t from, double way_m) {
  const double at_s = view.steps[from].time_s;
  std::size_t i = from;
  for (double still_m = std::abs(way_m);;) {
    if (way_m > 0.0 ? i + 1 >= view.steps.size() : i == 0) break;
    const std::size_t next = way_m > 0.0 ? i + 1 : i - 1;
    const double goes_m = 0.5 * std::abs(view.steps[i].forward_m() + view.steps[next].forward_m());
    if (still_m < 0.5 * goes_m || std::abs(view.steps[next].time_s - at_s) >= kLongestBump_s) break;
    still_m -= goes_m;
    i = next;
  }
  return i;
}

// By one metre of each wheel, and by one metre more of the left wheel and less of the right one.
std::vector<Motions> of_both_at_moment(const DriveView& view, double at_s, const ClimbOfBoth& over) {
  const std::size_t at = view.step_at(at_s);
  if (at >= view.steps.size()) return std::vector<Motions>(2);
  const auto climbed = [&](Wheel wheel, double later_m) {
    return steps_about(view, wheel, step_on(view, at, later_m), over.climb.length_m(radius_m(wheel, view)));
  };
  const Steps left = climbed(Wheel::left, -0.5 * over.right_later_m),
              right = climbed(Wheel::right, 0.5 * over.right_later_m);
  const std::size_t first = std::min(left.first, right.first), end = std::max(left.last, right.last) + 1;
  Motions by_left(first, end), by_right(first, end);
  spread(by_left, view, {Wheel::left, left}, over.climb);
  spread(by_right, view, {Wheel::right, right}, over.climb);
  std::vector<Motions> m(2, Motions(first, end));
  for (std::size_t i = first; i < end; ++i) {
    const BodyMotion l = by_left.at(i), r = by_right.at(i);
    m[0][i] = {l.forward_m + r.forward_m, 0.0, l.turn_rad + r.turn_rad};
    m[1][i] = {l.forward_m - r.forward_m, 0.0, l.turn_rad - r.turn_rad};
  }
  return m;
}

Motions at_moment(const DriveView& view, Wheel wheel, double at_s, const Climb& climb) {
  const std::size_t at = view.step_at(at_s);
  if (at >= view.steps.size()) return Motions();  // the drive was over by then
  const Steps s = steps_about(view, wheel, at, climb.length_m(radius_m(wheel, view)));
  Motions m(s.first, s.last + 1);
  spread(m, view, {wheel, s}, climb);
  return m;
}

// While one wheel is within reach of the place.
struct Visit {
  Wheel wheel;
  Steps met;
  std::size_t nearest;
  double away_m2;  // squared
};

// Empty where no such wheel ever comes there.
Motions at_place(const DriveView& view, Wheel which, Vec2 place, const Lying& lying) {
  const double b = view.drive.wheelbase_m;
  std::vector<Visit> visits;
  for (const Wheel wheel : {Wheel::left, Wheel::right}) {
    if (which != Wheel::both && which != wheel) continue;
    view.steps_near(place, lying.reach_m + 0.5 * b, [&](std::size_t i) {
      const Vec2 away = place_of_wheel(view.steps[i], b, wheel) - place;
      const double away_m2 = dot(away, away);
      if (away_m2 >= lying.reach_m * lying.reach_m) return;
      if (visits.empty() || visits.back().wheel != wheel || visits.back().met.last + 1 != i)
        visits.push_back({wheel, {i, i}, i, away_m2});
      Visit& now = visits.back();
      now.met.last = i;
      if (away_m2 < now.away_m2) now.nearest = i, now.away_m2 = away_m2;
    });
  }
  std::vector<Climbing> climbs;
  for (const Visit& v : visits) {
    Steps over = v.met;
    if (const double length_m = lying.climb.length_m(radius_m(v.wheel, view)); length_m > 0.0)
      over = lying.at_its_edge ? steps_from(view, v.wheel, v.met.first, length_m)
                               : steps_about(view, v.wheel, v.nearest, length_m);
    climbs.push_back({v.wheel, over});
  }
  return motions_of(view, climbs, lying.climb, lying.is_mound ? 2.0 * lying.reach_m : 0.0);
}

std::vector<std::vector<double>> moments_of_driving(const std::vector<DriveView>& views) {
  return moments(views, 0.15,
                 [](const EffectStep& s) { return std::abs(s.speed_mps) + std::abs(s.yaw_rate_radps) > 0.01; });
}

Effect once(Wheel wheel) {
  Effect e = bump_of(wheel);
  e.shapes = {{"recording", "1"}, {"at_s", "s"}};
  e.forms = {"over 6 cm of way",
             "over 2 cm",
             "over 20 cm",
             "over 10 cm",
             "as a wheel climbs what takes 4 mm",
             "as a wheel climbs what takes 15 mm"};
  e.of_one_recording = true;
  e.form_goes_with = [](const std::vector<double>& value, const std::vector<double>& shape, double,
                        const std::vector<DriveView>&) {
    return is_climbed(value[0], kBumpsOnce[static_cast<int>(shape.back())]);
  };
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    if (view.number != static_cast<int>(shape[0])) return motions_by_number(Motions());
    return motions_by_number(at_moment(view, wheel, shape[1], kBumpsOnce[static_cast<int>(shape.back())]));
  };
  e.scan = moments_of_driving;
  return e;
}

// What lies across the way is felt by both wheels, as a rule not by the same.
Effect once_by_both() {
  Effect e = bump_of(Wheel::both);
  e.sentence = "both wheels climb over something: they turn more than they travel";
  e.amplitudes.push_back({"left_more_m", "m", 0.005, -0.3, 0.3});
  e.shapes = {{"recording", "1"}, {"at_s", "s"}};
  for (const ClimbOfBoth& over : kBumpsOfBoth) e.forms.push_back(over.in_words);
  e.of_one_recording = true;
  e.form_goes_with = [](const std::vector<double>& value, const std::vector<double>& shape, double,
                        const std::vector<DriveView>&) {
    // Neither wheel travels more than it turns.
    return std::abs(value[1]) <= value[0] &&
           is_climbed(value[0] + std::abs(value[1]), kBumpsOfBoth[static_cast<int>(shape.back())].climb);
  };
  e.motions = [](const DriveView& view, const std::vector<double>& shape) {
    if (view.number != static_cast<int>(shape[0])) return std::vector<Motions>(2);
    return of_both_at_moment(view, shape[1], kBumpsOfBoth[static_cast<int>(shape.back())]);
  };
  e.scan = moments_of_driving;
  return e;
}

std::vector<std::vector<double>> places_met_again(const std::vector<DriveView>& views, Wheel which) {
  constexpr double kGrid_m = 0.1, kNear_m = 0.15;  // a place between two points of the grid is near both
  constexpr std::size_t kMost = 4000;
  using Cell = std::pair<int, int>;
  std::map<Cell, int> visits;
  for (const DriveView& view : views)
    for (const Wheel wheel : {Wheel::left, Wheel::right}) {
      if (which != Wheel::both && which != wheel) continue;
      std::set<Cell> before;  // as long as it stays near it is one visit
      Vec2 last{1e9, 1e9};
      for (const EffectStep& s : view.steps) {
        const Vec2 at = place_of_wheel(s, view.drive.wheelbase_m, wheel);
        if (length(at - last) < 0.3 * kGrid_m) continue;
        last = at;
        std::set<Cell> now;
        grid_points_near(at, kGrid_m, kNear_m, [&](int x, int y) { now.emplace(x, y); });
        for (const Cell& c : now)
          if (!before.contains(c)) ++visits[c];
        before = std::move(now);
      }
    }
  std::erase_if(visits, [](const auto& v) { return v.second < 2; });
  std::vector<std::vector<double>> places;
  const std::size_t stride = visits.size() / kMost + 1;
  std::size_t i = 0;
  for (const auto& [cell, times] : visits)
    if (i++ % stride == 0) places.push_back({cell.first * kGrid_m, cell.second * kGrid_m});
  return places;
}

Effect each_time(Wheel wheel) {
  Effect e = bump_of(wheel);
  e.shapes = {{"x_m", "m"}, {"y_m", "m"}};
  e.forms = {"20 cm wide, climbed in 6 cm",
             "10 cm wide",
             "40 cm wide",
             "20 cm wide, climbed in 10 cm",
             "20 cm wide, climbed as what takes 4 mm",
             "20 cm wide, climbed as what takes 15 mm",
             "20 cm wide, climbed in 6 cm at its edge",
             "20 cm wide and long",
             "a mound 8 cm across, the less of it the further from its middle",
             "a mound 16 cm across, the less of it the further from its middle",
             "a mound 28 cm across, the less of it the further from its middle"};
  e.tests_of_a_shape = 0.5;      // neighbours are met alike, in whichever form
  e.forms_of_the_scan = {0, 6};  // what begins at an edge is felt elsewhere, by where one comes from
  e.form_goes_with = [wheel](const std::vector<double>& value, const std::vector<double>& shape, double,
                             const std::vector<DriveView>& views) {
    const auto form = static_cast<std::size_t>(shape.back());
    // As long as it is wide, and under either wheel, it would be a patch of floor.
    if (wheel == Wheel::both && form == kLyingAsLongAsWide) return false;
    const Lying& lying = kBumpsLying[form];
    if (!lying.is_mound) return is_climbed(value[0], lying.climb);
    return lying.reach_m <= kClimbedWithin * radius_m(wheel, views.front()) &&
           is_climbed(value[0], Climb{2.0 * lying.reach_m});
  };
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    return motions_by_number(at_place(view, wheel, {shape[0], shape[1]}, kBumpsLying[static_cast<int>(shape.back())]));
  };
  // It is met anywhere within reach, and no wheel comes to the same line twice.
  e.place_known_to_m = [](const std::vector<double>& shape) {
    return kBumpsLying[static_cast<int>(shape.back())].reach_m / std::sqrt(3.0);
  };
  // Only places near which wheels came more than once: else it is a moment.
  e.scan = [wheel](const std::vector<DriveView>& views) { return places_met_again(views, wheel); };
  return e;
}

}  // namespace

std::vector<Effect> bump() {
  return {once(Wheel::left),      once(Wheel::right),      once_by_both(),
          each_time(Wheel::left), each_time(Wheel::right), each_time(Wheel::both)};
}

}  // namespace odolab::effects
