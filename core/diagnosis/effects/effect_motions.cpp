#include "core/diagnosis/effects/effect_motions.h"

#include <algorithm>
#include <cmath>

namespace odolab {

Motions motion_of(const Effect& effect, const DriveView& view, const std::vector<double>& shape,
                  const std::vector<double>& value) {
  Motions sum(view.steps.size());
  const std::vector<Motions> columns = effect.motions(view, shape);
  for (std::size_t k = 0; k < std::min(columns.size(), value.size()); ++k) columns[k].add_to(sum, value[k]);
  return sum;
}

double displaces_m(const std::vector<DriveView>& views, const std::function<Motions(const DriveView&)>& motion) {
  constexpr double kMost = 0.9;
  std::vector<double> displaced_m;
  for (const DriveView& view : views) {
    const Motions moved = motion(view);
    BodyMotion gone;
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const BodyMotion m = moved.at(i);
      gone = {gone.forward_m + m.forward_m, gone.sideways_m + m.sideways_m, gone.turn_rad + m.turn_rad};
      displaced_m.push_back(std::max(std::hypot(gone.forward_m, gone.sideways_m),
                                     0.5 * view.drive.wheelbase_m * std::abs(gone.turn_rad)));
    }
  }
  if (displaced_m.empty()) return 0.0;
  const auto most = displaced_m.begin() + static_cast<std::ptrdiff_t>(kMost * static_cast<double>(displaced_m.size()));
  std::nth_element(displaced_m.begin(), most, displaced_m.end());
  return *most;
}

bool is_more_than_counts(double displaces_m, double count_rad, const std::vector<DriveView>& views) {
  constexpr double kCounts = 0.6;
  double radius_m = 0.0;
  for (const DriveView& v : views)
    radius_m = std::max({radius_m, v.drive.wheel_radius_left_m, v.drive.wheel_radius_right_m});
  return displaces_m > kCounts * count_rad * radius_m;
}

bool part_by_more_than_counts(const std::function<Motions(const DriveView&)>& one,
                              const std::function<Motions(const DriveView&)>& other, double value, double count_rad,
                              const std::vector<DriveView>& views) {
  const auto apart = [&](const DriveView& view) {
    Motions difference(view.steps.size());
    one(view).add_to(difference, value);
    other(view).add_to(difference, -value);
    return difference;
  };
  return is_more_than_counts(displaces_m(views, apart), count_rad, views);
}

bool changes_speeds(const Effect& effect) {
  return effect.acts_on_motion() && !effect.local && !effect.lags_behind_commands();
}

DriveView as_it_goes(DriveView view, const std::function<std::vector<BodyMotion>(const DriveView&)>& motions) {
  constexpr int kMostRounds = 8;
  constexpr double kSettled = 1e-3;     // m/s, and rad/s
  constexpr double kSmoothed_s = 0.15;  // to either side: whole counts come in jerks
  constexpr double kMost = 0.5;         // of a rim's speed: beyond that no effect is what it is fitted as
  const std::size_t n = view.steps.size();
  std::vector<double> speed_mps(n), yaw_rate_radps(n);
  for (std::size_t i = 0; i < n; ++i)
    speed_mps[i] = view.steps[i].speed_mps, yaw_rate_radps[i] = view.steps[i].yaw_rate_radps;
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<BodyMotion> by = motions(view);
    double changed = 0.0, forward_m = 0.0, turn_rad = 0.0, span_s = 0.0;
    std::size_t from = 0, to = 0;
    for (std::size_t i = 0; i < n; ++i) {
      EffectStep& s = view.steps[i];
      for (; to < n && view.steps[to].time_s <= s.time_s + kSmoothed_s; ++to)
        forward_m += by[to].forward_m, turn_rad += by[to].turn_rad, span_s += view.steps[to].duration_s;
      for (; view.steps[from].time_s < s.time_s - kSmoothed_s; ++from)
        forward_m -= by[from].forward_m, turn_rad -= by[from].turn_rad, span_s -= view.steps[from].duration_s;
      if (span_s <= 0.0) continue;
      const double half_base_m = 0.5 * view.drive.wheelbase_m,
                   most_mps = kMost * (std::abs(speed_mps[i]) + half_base_m * std::abs(yaw_rate_radps[i]));
      const auto with = [&](double by_wheels, double now, double more, double most) {
        const double there = by_wheels + std::clamp(more, -most, most);
        return round == 0 ? there : 0.5 * (now + there);  // halfway: what feeds back does not swing
      };
      const double speed = with(speed_mps[i], s.speed_mps, forward_m / span_s, most_mps),
                   yaw_rate = with(yaw_rate_radps[i], s.yaw_rate_radps, turn_rad / span_s, most_mps / half_base_m);
      changed = std::max({changed, std::abs(speed - s.speed_mps), std::abs(yaw_rate - s.yaw_rate_radps)});
      s.speed_mps = speed;
      s.yaw_rate_radps = yaw_rate;
    }
    if (changed < kSettled) break;
  }
  return view;
}

std::vector<BodyMotion> motions_of(const DriveView& by_wheels, const std::vector<ActiveEffect>& effects) {
  struct Acting {
    const Effect* effect;
    std::vector<double> value, shape;
  };
  std::vector<Acting> acting;
  for (const ActiveEffect& a : effects) {
    const Effect* e = catalogue_entry(a);
    if (!e || e->clock_rate || (e->only_commands && !by_wheels.from_commands)) continue;
    Acting one{e, {}, {}};
    if (e->from_parameters)
      one.value = e->from_parameters(a);
    else
      for (const Effect::Amplitude& p : e->amplitudes) one.value.push_back(a.parameter(p.name));
    for (const Effect::Amplitude& p : e->shapes) one.shape.push_back(p.name == "recording" ? 0.0 : a.parameter(p.name));
    if (e->shapes_read_as)
      for (double& shape : one.shape) shape /= e->shapes_read_as(one.value);
    if (e->forms.size() > 1) one.shape.push_back(a.parameter("form"));
    acting.push_back(std::move(one));
  }
  const auto sum_of = [&](const DriveView& view, const auto& is_meant) {
    std::vector<BodyMotion> sum(view.steps.size());
    for (const Acting& a : acting) {
      if (!is_meant(*a.effect)) continue;
      const std::vector<Motions> motions = a.effect->motions(view, a.shape);
      for (std::size_t k = 0; k < motions.size(); ++k) motions[k].add_to(sum, a.value[k]);
    }
    return sum;
  };
  DriveView lagging = by_wheels;
  for (const Acting& a : acting)
    if (a.effect->lags_behind_commands())
      lagging = as_it_lags(std::move(lagging), motion_of(*a.effect, by_wheels, a.shape, a.value));
  const DriveView view = as_it_goes(std::move(lagging), [&](const DriveView& v) { return sum_of(v, changes_speeds); });
  return sum_of(view, [](const Effect&) { return true; });
}

Track settled(const std::function<Track(const Track& before)>& reckoned) {
  constexpr int kMostTimes = 200;  // as many crossings are right by then
  constexpr double kMoved_m = 1e-4;
  Track track = reckoned({});
  for (int k = 1; k < kMostTimes; ++k) {
    Track again = reckoned(track);
    bool is_moved = false;
    for (std::size_t i = 0; i < std::min(track.size(), again.size()) && !is_moved; ++i)
      is_moved = length(again[i].pose.position() - track[i].pose.position()) > kMoved_m;
    track = std::move(again);
    if (!is_moved) break;
  }
  return track;
}

}  // namespace odolab
