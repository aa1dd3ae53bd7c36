#include "core/diagnosis/generic/groups.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/diagnosis/effects/floor.h"
#include "core/diagnosis/effects/reversals.h"
#include "core/diagnosis/generic/hats.h"
#include "core/diagnosis/model/wheels_at_rest.h"

namespace odolab {

namespace {

Group hats_of(const std::string& name, const std::vector<DriveView>& views, const OfStep& variable, int count,
              double least) {
  const std::vector<double> seen = seen_on_the_way(views, variable);
  Group g;
  g.variable = name;
  if (seen.size() < 50) return g;
  const double low = seen[seen.size() / 100], high = seen[seen.size() - 1 - seen.size() / 100];
  if (high - low < 1e-6 || high - low < 2.0 * least) return g;
  // Half by quantile, half even: rare regimes are heard too. As many as stand far enough apart, so that they stand
  // alike wherever one begins to count: to the left of a mirrored drive is what was to the right.
  const auto stand = [&](int many) {
    std::vector<double> at;
    for (int k = 0; k < many; ++k) {
      const double share = static_cast<double>(k) / (many - 1);
      const double at_seen = share * static_cast<double>(seen.size() - 1);
      const double q = 0.5 * (seen[static_cast<std::size_t>(std::floor(at_seen))] +
                              seen[static_cast<std::size_t>(std::ceil(at_seen))]);
      at.push_back(0.5 * std::clamp(q, low, high) + 0.5 * (low + share * (high - low)));
    }
    return at;
  };
  const auto are_apart = [&](const std::vector<double>& at) {
    const double near = std::max(0.02 * (high - low), least);
    return std::adjacent_find(at.begin(), at.end(), [&](double a, double b) { return b - a <= near; }) == at.end();
  };
  for (int many = count; many >= 2 && g.at.empty(); --many)
    if (std::vector<double> at = stand(many); are_apart(at)) g.at = std::move(at);
  g.values = [hats = Hats(g.at), variable](const DriveView& view, std::vector<std::vector<double>>& out) {
    out.assign(hats.size(), std::vector<double>(view.steps.size(), 0.0));
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const Hats::Shares s = hats.of(variable(view.steps[i]));
      out[s.first][i] = s.of_first;
      if (s.of_next > 0.0) out[s.first + 1][i] = s.of_next;
    }
  };
  return g;
}

Group by_heading() {
  Group g;
  g.variable = "heading [rad]";
  g.of_turns = true;
  g.values = [](const DriveView& view, std::vector<std::vector<double>>& out) {
    out.assign(4, std::vector<double>(view.steps.size()));
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const double h = view.steps[i].heading_rad;
      out[0][i] = std::cos(h), out[1][i] = std::sin(h), out[2][i] = std::cos(2 * h), out[3][i] = std::sin(2 * h);
    }
  };
  g.waves = {{"heading [rad]", {0, 2}, {1, 3}}};
  return g;
}

// Place: low polynomials of where it is, and of where it is against where it looks.
Group by_place(const std::vector<DriveView>& views) {
  const FloorSeen floor = floor_of(views);
  const auto unit = [](double v, double low, double high) {
    return high > low ? 2.0 * (v - low) / (high - low) - 1.0 : 0.0;
  };
  Group g;
  g.variable = "place on the floor [m]";
  g.of_turns = true;
  g.values = [=](const DriveView& view, std::vector<std::vector<double>>& out) {
    out.assign(9, std::vector<double>(view.steps.size()));
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const double x = unit(s.position.x_m, floor.low.x_m, floor.high.x_m),
                   y = unit(s.position.y_m, floor.low.y_m, floor.high.y_m);
      const double c = std::cos(s.heading_rad), sn = std::sin(s.heading_rad);
      const double f[9] = {x, y, x * x, x * y, y * y, x * c, x * sn, y * c, y * sn};
      for (int k = 0; k < 9; ++k) out[k][i] = f[k];
    }
  };
  return g;
}

Group by_recording(std::size_t count) {
  Group g;
  g.variable = "recording";
  g.of_turns = true;
  g.values = [count](const DriveView& view, std::vector<std::vector<double>>& out) {
    // A run that was not fitted is like the first.
    const std::size_t number =
        static_cast<std::size_t>(view.number) < count ? static_cast<std::size_t>(view.number) : 0;
    out.assign(count, std::vector<double>(view.steps.size(), 0.0));
    std::fill(out[number].begin(), out[number].end(), 1.0);
  };
  return g;
}

Group by_turn_before() {
  Group g;
  g.variable = "turn before, forgotten over metres";
  g.is_memory = true;
  g.values = [](const DriveView& view, std::vector<std::vector<double>>& out) {
    out.assign(2, std::vector<double>(view.steps.size()));
    for (int k = 0; k < 2; ++k) {
      const double length_m = k == 0 ? 0.1 : 0.5;
      double m = 0.0;
      for (std::size_t i = 0; i < view.steps.size(); ++i) {
        m = m * std::exp(-std::abs(view.steps[i].forward_m()) / length_m) + view.steps[i].turn_rad;
        m = std::clamp(m, -2.0, 2.0);
        out[k][i] = m;
      }
    }
  };
  return g;
}

// What settles once a run has begun: grease and tyres that are cold at first.
Group by_time_since_start_forgotten() {
  Group g;
  g.variable = "time since the start, forgotten over seconds";
  g.is_memory = true;
  g.values = [](const DriveView& view, std::vector<std::vector<double>>& out) {
    constexpr double kForgotten_s[] = {5.0, 20.0};
    out.assign(std::size(kForgotten_s), std::vector<double>(view.steps.size()));
    for (std::size_t k = 0; k < std::size(kForgotten_s); ++k)
      for (std::size_t i = 0; i < view.steps.size(); ++i)
        out[k][i] = std::exp(-view.steps[i].since_start_s / kForgotten_s[k]);
  };
  return g;
}

// What heats, or empties, as the vehicle works, and recovers.
Group forgotten_over_seconds(const char* name, double (*work)(const EffectStep&)) {
  Group g;
  g.variable = name;
  g.is_memory = true;
  g.values = [work](const DriveView& view, std::vector<std::vector<double>>& out) {
    constexpr double kLasts_s[] = {5.0, 30.0};
    out.assign(std::size(kLasts_s), std::vector<double>(view.steps.size()));
    for (std::size_t k = 0; k < std::size(kLasts_s); ++k) {
      double m = 0.0;
      for (std::size_t i = 0; i < view.steps.size(); ++i) {
        m = m * std::exp(-view.steps[i].duration_s / kLasts_s[k]) + work(view.steps[i]);
        out[k][i] = m;
      }
    }
  };
  return g;
}

double turned_rad(const EffectStep& s) { return std::abs(s.turn_rad); }

Group by_way_since_rest() {
  Group g;
  g.variable = "way since it stood [m]";
  g.is_memory = true;
  g.values = [](const DriveView& view, std::vector<std::vector<double>>& out) {
    constexpr double kForgotten_m[] = {0.1, 0.5, 2.0};
    constexpr double kStands_s = 1.0;
    out.assign(std::size(kForgotten_m), std::vector<double>(view.steps.size()));
    double way_m = 1e3, stood_s = 0.0;  // what was before the run is not known
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      stood_s = wheels_stand(s) ? stood_s + s.duration_s : 0.0;
      way_m = stood_s > kStands_s ? 0.0 : way_m + s.rolled_m();
      for (std::size_t k = 0; k < std::size(kForgotten_m); ++k) out[k][i] = std::exp(-way_m / kForgotten_m[k]);
    }
  };
  return g;
}

Group by_way_since_reversal() {
  Group g;
  g.variable = "way since it reversed [m]";
  g.is_memory = true;
  g.values = [](const DriveView& view, std::vector<std::vector<double>>& out) {
    constexpr double kForgotten_m[] = {0.1, 0.5, 2.0};
    out.assign(std::size(kForgotten_m), std::vector<double>(view.steps.size()));
    const std::vector<Reversal> all = reversals(view);
    double way_m = 1e3;  // what was before the run is not known
    std::size_t next = 0;
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      way_m += std::abs(view.steps[i].forward_m());
      if (next < all.size() && i == all[next].sure) way_m = all[next++].back_m;
      for (std::size_t k = 0; k < std::size(kForgotten_m); ++k) out[k][i] = std::exp(-way_m / kForgotten_m[k]);
    }
  };
  return g;
}

Group by_wheel_angles() {
  Group g;
  g.variable = "wheel rotation [rad]";
  g.values = [](const DriveView& view, std::vector<std::vector<double>>& out) {
    out.assign(4, std::vector<double>(view.steps.size()));
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      out[0][i] = std::cos(s.left_rad), out[1][i] = std::sin(s.left_rad), out[2][i] = std::cos(s.right_rad),
      out[3][i] = std::sin(s.right_rad);
    }
  };
  g.waves = {{"left wheel angle [rad]", {0}, {1}}, {"right wheel angle [rad]", {2}, {3}}};
  return g;
}

}  // namespace

Shaken shaken_by_wheels(const std::vector<DriveView>& views) {
  double count_m = 0.0, base_m = 1e300;
  for (const DriveView& v : views) {
    const double radius_m = std::max(v.drive.wheel_radius_left_m, v.drive.wheel_radius_right_m);
    count_m = std::max(count_m, v.from_commands ? 0.0 : 2.0 * kPi * radius_m / v.drive.counts_per_wheel_turn());
    base_m = std::min(base_m, v.drive.wheelbase_m);
  }
  const double speed_mps = std::max(0.01, count_m / 0.06);
  return {speed_mps, 2.0 * speed_mps / base_m, base_m};
}

OfStep bend_radps(const Shaken& shaken) {
  return [straight_radps = shaken.straight_radps](const EffectStep& s) {
    return s.yaw_rate_radps - std::clamp(s.yaw_rate_radps, -straight_radps, straight_radps);
  };
}

OfStep own_speed_mps(const Shaken& shaken, int wheel_alone) {
  const double side = (wheel_alone == kLeftWheelAlone ? -0.5 : 0.5) * shaken.base_m;
  return [side](const EffectStep& s) { return s.speed_mps + side * s.yaw_rate_radps; };
}

std::vector<double> seen_on_the_way(const std::vector<DriveView>& views, const OfStep& variable) {
  std::vector<double> seen;
  for (const DriveView& v : views)
    for (std::size_t i = 0; i < v.steps.size(); i += 7)
      if (std::abs(v.steps[i].speed_mps) + 0.1 * std::abs(v.steps[i].yaw_rate_radps) > 0.005)
        seen.push_back(variable(v.steps[i]));
  std::sort(seen.begin(), seen.end());
  return seen;
}

std::vector<Group> groups_of(const std::vector<DriveView>& views, const Shaken& shaken) {
  std::vector<Group> groups;
  groups.push_back(hats_of(
      "speed [m/s]", views, [](const EffectStep& s) { return s.speed_mps; }, 6, shaken.speed_mps));
  const OfStep bend = bend_radps(shaken);
  groups.push_back(hats_of("yaw rate [rad/s]", views, bend, 7, shaken.straight_radps));
  groups.push_back(hats_of(
      "lateral acceleration [m/s2]", views, [=](const EffectStep& s) { return s.speed_mps * bend(s); }, 6,
      shaken.speed_mps / shaken.base_m));
  groups.push_back(hats_of(
      "acceleration [m/s2]", views, [](const EffectStep& s) { return s.acceleration_mps2; }, 6,
      shaken.speed_mps / 0.1));
  groups.push_back(hats_of(
      "time since the start [s]", views, [](const EffectStep& s) { return s.since_start_s; }, 8, 0.0));
  groups.back().of_turns = true;
  for (const int wheel : {kLeftWheelAlone, kRightWheelAlone}) {
    groups.push_back(hats_of("its own speed [m/s]", views, own_speed_mps(shaken, wheel), 7, shaken.speed_mps));
    groups.back().of_wheel = wheel;
  }
  groups.push_back(by_heading());
  groups.push_back(by_place(views));
  if (views.size() > 1) groups.push_back(by_recording(views.size()));
  groups.push_back(by_turn_before());
  groups.push_back(by_time_since_start_forgotten());
  groups.push_back(forgotten_over_seconds("turning before, forgotten over seconds", turned_rad));
  groups.push_back(
      forgotten_over_seconds("way before, forgotten over seconds", [](const EffectStep& s) { return s.rolled_m(); }));
  groups.push_back(by_way_since_rest());
  groups.push_back(by_way_since_reversal());
  groups.push_back(by_wheel_angles());
  std::erase_if(groups, [](const Group& g) { return !g.values; });
  return groups;
}

}  // namespace odolab
