#include "core/diagnosis/generic/lines_on_floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/diagnosis/effects/floor.h"
#include "core/diagnosis/generic/wave.h"
#include "core/diagnosis/generic/waves_on_floor.h"

namespace odolab {

namespace {

constexpr int kAngles = 60;
constexpr double kLineBin_m = 0.05;
constexpr int kLineWidths[] = {1, 2, 4};  // bins
constexpr int kFewestCrossings = 6;
constexpr std::size_t kMostTerms = 2;

enum class OnLine { wheels, steered, carried, turned };
struct NamedOnLine {
  const char* name;
  std::size_t terms;
};
constexpr NamedOnLine kNamedOnLine[] = {{"way of the wheel that is there, per metre [1]", 1},
                                        {"turn per metre, by the angle at which it is crossed [rad/m]", 2},
                                        {"carried across the floor, by the side it is crossed from [1]", 2},
                                        {"turned, by the side it is crossed from [rad/m]", 1}};

constexpr int kManyOnLine = std::size(kNamedOnLine);
const NamedOnLine& named(OnLine channel) { return kNamedOnLine[static_cast<int>(channel)]; }

struct Line {
  double towards_rad = 0.0, from_m = 0.0, to_m = 0.0;  // its normal, and what lies on it along that, from the origin
  Vec2 normal() const { return {std::cos(towards_rad), std::sin(towards_rad)}; }
  bool has(const Vec2& normal, const Vec2& place) const {
    const double at_m = dot(normal, place);
    return at_m >= from_m && at_m < to_m;
  }
};

// What a step of the vehicle does on a line, in units of a channel's terms; `normal` is the line's.
std::array<BodyMotion, kMostTerms> units_of(const EffectStep& s, double wheelbase_m, OnLine channel,
                                            const Vec2& normal) {
  const double c = normal.x_m * s.cos_heading + normal.y_m * s.sin_heading,
               across = normal.x_m * s.sin_heading - normal.y_m * s.cos_heading;
  const double way_m = unit_of_channel(s, wheelbase_m, 2).turn_rad, over_m = c * s.forward_m();
  if (channel == OnLine::steered)
    return {BodyMotion{0, 0, way_m * (c * c - across * across)}, {0, 0, way_m * 2 * c * across}};
  if (channel == OnLine::carried)
    return {BodyMotion{over_m * s.cos_heading, -over_m * s.sin_heading, 0},
            {over_m * s.sin_heading, over_m * s.cos_heading, 0}};
  return {BodyMotion{0, 0, over_m}, {}};
}

// Calls visit(place, units) for what moves in one step: the vehicle, or each of its wheels where it stands.
template <typename Visit>
void each_part(const EffectStep& s, double wheelbase_m, OnLine channel, const Vec2& normal, Visit&& visit) {
  if (channel != OnLine::wheels) return visit(0, s.position, units_of(s, wheelbase_m, channel, normal));
  for (const Wheel wheel : {Wheel::left, Wheel::right})
    visit(wheel == Wheel::left ? 1 : 2, place_of_wheel(s, wheelbase_m, wheel),
          std::array<BodyMotion, kMostTerms>{by_wheel(wheel, way_of(s, wheel), wheelbase_m)});
}

// Of all lines of one direction that lie within a bin.
struct LineBin {
  double score[kMostTerms] = {}, way2[kMostTerms] = {};
  int crossings = 0;
};

struct StrongestLine {
  Line line;
  double strength = 0.0;
  int looked_at = 0;
};

StrongestLine strongest_line_of(const std::vector<LineBin>& bins, double low_m, double towards_rad) {
  StrongestLine best;
  for (const int width : kLineWidths)
    for (std::size_t first = 0; first + static_cast<std::size_t>(width) <= bins.size(); ++first) {
      LineBin sum;
      int fewest = bins[first].crossings;
      for (std::size_t k = first; k < first + static_cast<std::size_t>(width); ++k) {
        for (std::size_t t = 0; t < kMostTerms; ++t) sum.score[t] += bins[k].score[t], sum.way2[t] += bins[k].way2[t];
        fewest = std::min(fewest, bins[k].crossings);
      }
      if (fewest < kFewestCrossings) continue;
      ++best.looked_at;
      double strength = 0.0;
      for (std::size_t t = 0; t < kMostTerms; ++t)
        if (sum.way2[t] > 0.0) strength += sum.score[t] * sum.score[t] / sum.way2[t];
      if (strength <= best.strength) continue;
      best.strength = strength;
      const double from_m = low_m + kLineBin_m * static_cast<double>(first);
      best.line = {towards_rad, from_m, from_m + kLineBin_m * width};
    }
  return best;
}

StrongestLine strongest_line(const AskedModel& asked, OnLine channel, double towards_rad, const FloorSquare& floor) {
  const std::vector<DriveView>& views = asked.joint.views();
  const Vec2 normal{std::cos(towards_rad), std::sin(towards_rad)};
  const double reach_m = std::sqrt(2.0) * floor.half_m + views.front().drive.wheelbase_m,
               low_m = dot(normal, floor.middle) - reach_m;
  std::vector<LineBin> bins(static_cast<std::size_t>(2.0 * reach_m / kLineBin_m) + 1);
  for (std::size_t r = 0; r < views.size(); ++r) {
    std::array<std::ptrdiff_t, 3> was = {-1, -1, -1};
    for (std::size_t i = 0; i < views[r].steps.size(); ++i) {
      const EffectStep& s = views[r].steps[i];
      each_part(s, views[r].drive.wheelbase_m, channel, normal, [&](int part, const Vec2& place, const auto& units) {
        const auto at = static_cast<std::ptrdiff_t>((dot(normal, place) - low_m) / kLineBin_m);
        if (at < 0 || at >= static_cast<std::ptrdiff_t>(bins.size())) return;
        LineBin& bin = bins[static_cast<std::size_t>(at)];
        for (std::size_t t = 0; t < kMostTerms; ++t)
          bin.score[t] += product(units[t], asked.scores[r][i]), bin.way2[t] += product(units[t], units[t]);
        auto& before = was[static_cast<std::size_t>(part)];
        if (at == before) return;
        ++bin.crossings;
        for (std::ptrdiff_t over = std::min(at, before) + 1; before >= 0 && over < std::max(at, before); ++over)
          ++bins[static_cast<std::size_t>(over)].crossings;
        before = at;
      });
    }
  }
  return strongest_line_of(bins, low_m, towards_rad);
}

std::vector<Motions> motions_on(const Line& line, OnLine channel, const DriveView& view) {
  std::vector<Motions> out(named(channel).terms, Motions(view.steps.size()));
  const Vec2 normal = line.normal();
  for (std::size_t i = 0; i < view.steps.size(); ++i)
    each_part(view.steps[i], view.drive.wheelbase_m, channel, normal, [&](int, const Vec2& place, const auto& units) {
      if (!line.has(normal, place)) return;
      for (std::size_t t = 0; t < out.size(); ++t) {
        BodyMotion& m = out[t][i];
        m.forward_m += units[t].forward_m;
        m.sideways_m += units[t].sideways_m;
        m.turn_rad += units[t].turn_rad;
      }
    });
  return out;
}

std::string name_of(const Line& line) {
  const double middle_m = 0.5 * (line.from_m + line.to_m);
  const Vec2 foot = middle_m * line.normal();
  const auto shown = [](double m) { return std::abs(m) < 0.005 ? 0.0 : m; };  // no "-0.00"
  return formatted("a line across the floor through x %.2f, y %.2f m, %.2g m wide, at %.0f degrees", shown(foot.x_m),
                   shown(foot.y_m), line.to_m - line.from_m, line.towards_rad * 180.0 / kPi - 90.0);
}

}  // namespace

std::vector<GenericTest> line_tests(const AskedModel& asked, double looked_at) {
  const FloorSquare floor = square_around(floor_of(asked.joint.views()));
  if (!(floor.half_m > kLineBin_m)) return {};
  std::array<std::array<StrongestLine, kAngles>, kManyOnLine> of;
  parallel_for(kManyOnLine * kAngles, [&](int i) {
    const int channel = i / kAngles, angle = i % kAngles;
    of[static_cast<std::size_t>(channel)][static_cast<std::size_t>(angle)] =
        strongest_line(asked, static_cast<OnLine>(channel), kPi * angle / kAngles, floor);
  });
  std::vector<std::pair<OnLine, Line>> chosen;
  for (int channel = 0; channel < kManyOnLine; ++channel) {
    StrongestLine best;
    for (const StrongestLine& s : of[static_cast<std::size_t>(channel)]) {
      looked_at += s.looked_at;
      if (s.strength > best.strength) best = s;
    }
    if (best.strength > 0.0) chosen.emplace_back(static_cast<OnLine>(channel), best.line);
  }
  std::vector<GenericTest> tests(chosen.size());
  parallel_for(static_cast<int>(chosen.size()), [&](int i) {
    const auto [channel, line] = chosen[static_cast<std::size_t>(i)];
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    t = asked_of(
        asked, name_of(line), named(channel).name, named(channel).terms,
        [channel = channel, line = line](const DriveView& view, const std::vector<double>&) {
          return motions_on(line, channel, view);
        },
        looked_at);
    t.of_when_or_where = t.is_no_rival_of_names = true;
  });
  return tests;
}

}  // namespace odolab
