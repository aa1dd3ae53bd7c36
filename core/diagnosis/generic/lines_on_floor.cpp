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

// How a step goes over a line of that normal.
struct Crossing {
  double way_m, over_m;         // along its own way, and along the normal
  double cos_twice, sin_twice;  // of twice the angle from the heading to the normal
};
Crossing crossing(const EffectStep& s, double wheelbase_m, const Vec2& normal) {
  const double c = normal.x_m * s.cos_heading + normal.y_m * s.sin_heading,
               across = normal.x_m * s.sin_heading - normal.y_m * s.cos_heading;
  return {unit_of_channel(s, wheelbase_m, 2).turn_rad, c * s.forward_m(), c * c - across * across, 2.0 * c * across};
}

// What a step of the vehicle does on a line, in units of a channel's terms; `normal` is the line's.
std::array<BodyMotion, kMostTerms> units_of(const EffectStep& s, double wheelbase_m, OnLine channel,
                                            const Vec2& normal) {
  const Crossing by = crossing(s, wheelbase_m, normal);
  if (channel == OnLine::steered) return {BodyMotion{0, 0, by.way_m * by.cos_twice}, {0, 0, by.way_m * by.sin_twice}};
  if (channel == OnLine::carried)
    return {BodyMotion{by.over_m * s.cos_heading, -by.over_m * s.sin_heading, 0},
            {by.over_m * s.sin_heading, by.over_m * s.cos_heading, 0}};
  return {BodyMotion{0, 0, by.over_m}, {}};
}

// Calls visit(place, units) for what moves in one step: the vehicle, or each of its wheels where it stands.
template <typename Visit>
void each_part(const EffectStep& s, double wheelbase_m, OnLine channel, const Vec2& normal, Visit&& visit) {
  if (channel != OnLine::wheels) return visit(s.position, units_of(s, wheelbase_m, channel, normal));
  for (const Wheel wheel : {Wheel::left, Wheel::right})
    visit(place_of_wheel(s, wheelbase_m, wheel),
          std::array<BodyMotion, kMostTerms>{by_wheel(wheel, way_of(s, wheel), wheelbase_m)});
}

// Of all lines of one direction that lie within a bin.
struct LineBin {
  double score[kMostTerms] = {}, way2[kMostTerms] = {};
  void add(std::size_t term, double amount, double score_of_one) {
    score[term] += amount * score_of_one;
    way2[term] += amount * amount;
  }
};

struct LineBins {
  explicit LineBins(std::size_t many) : crossings_of_vehicle(many), crossings_of_wheels(many) {
    for (std::vector<LineBin>& bins : of) bins.resize(many);
  }
  std::vector<LineBin>& operator[](OnLine channel) { return of[static_cast<std::size_t>(channel)]; }
  std::array<std::vector<LineBin>, kManyOnLine> of;
  std::vector<int> crossings_of_vehicle, crossings_of_wheels;
};

struct StrongestLine {
  Line line;
  double strength = 0.0;
  int looked_at = 0;
};

StrongestLine strongest_line_of(const std::vector<LineBin>& bins, const std::vector<int>& crossings, double low_m,
                                double towards_rad) {
  StrongestLine best;
  for (const int width : kLineWidths)
    for (std::size_t first = 0; first + static_cast<std::size_t>(width) <= bins.size(); ++first) {
      LineBin sum;
      int fewest = crossings[first];
      for (std::size_t k = first; k < first + static_cast<std::size_t>(width); ++k) {
        for (std::size_t t = 0; t < kMostTerms; ++t) sum.score[t] += bins[k].score[t], sum.way2[t] += bins[k].way2[t];
        fewest = std::min(fewest, crossings[k]);
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

// Counts a crossing of each bin that is come to, or passed.
void cross(std::vector<int>& crossings, std::ptrdiff_t& was, std::ptrdiff_t is) {
  if (is == was) return;
  ++crossings[static_cast<std::size_t>(is)];
  for (std::ptrdiff_t k = std::min(is, was) + 1; was >= 0 && k < std::max(is, was); ++k)
    ++crossings[static_cast<std::size_t>(k)];
  was = is;
}

// Of the lines of one direction, in each channel.
std::array<StrongestLine, kManyOnLine> strongest_lines(const AskedModel& asked, double towards_rad,
                                                       const FloorSquare& floor) {
  const std::vector<DriveView>& views = asked.joint.views();
  const Vec2 normal{std::cos(towards_rad), std::sin(towards_rad)};
  const double reach_m = std::sqrt(2.0) * floor.half_m + views.front().drive.wheelbase_m,
               low_m = dot(normal, floor.middle) - reach_m;
  LineBins bins(static_cast<std::size_t>(2.0 * reach_m / kLineBin_m) + 1);
  const std::ptrdiff_t last = std::ssize(bins.crossings_of_vehicle) - 1;
  const auto bin_at = [&](const Vec2& place) {
    return std::clamp(static_cast<std::ptrdiff_t>((dot(normal, place) - low_m) / kLineBin_m), std::ptrdiff_t{0}, last);
  };
  for (std::size_t r = 0; r < views.size(); ++r) {
    const double b = views[r].drive.wheelbase_m;
    std::ptrdiff_t was = -1, left_was = -1, right_was = -1;
    for (std::size_t i = 0; i < views[r].steps.size(); ++i) {
      const EffectStep& s = views[r].steps[i];
      const BodyMotion& score = asked.scores[r][i];
      const std::ptrdiff_t at = bin_at(s.position);
      cross(bins.crossings_of_vehicle, was, at);
      const auto k = static_cast<std::size_t>(at);
      const Crossing by = crossing(s, b, normal);  // the products of `units_of` with the score, in one walk
      bins[OnLine::steered][k].add(0, by.way_m * by.cos_twice, score.turn_rad);
      bins[OnLine::steered][k].add(1, by.way_m * by.sin_twice, score.turn_rad);
      bins[OnLine::carried][k].add(0, by.over_m, s.cos_heading * score.forward_m - s.sin_heading * score.sideways_m);
      bins[OnLine::carried][k].add(1, by.over_m, s.sin_heading * score.forward_m + s.cos_heading * score.sideways_m);
      bins[OnLine::turned][k].add(0, by.over_m, score.turn_rad);
      for (const Wheel wheel : {Wheel::left, Wheel::right}) {
        const std::ptrdiff_t there = bin_at(place_of_wheel(s, b, wheel));
        cross(bins.crossings_of_wheels, wheel == Wheel::left ? left_was : right_was, there);
        bins[OnLine::wheels][static_cast<std::size_t>(there)].add(0, way_of(s, wheel),
                                                                  product(by_wheel(wheel, 1.0, b), score));
      }
    }
  }
  std::array<StrongestLine, kManyOnLine> best;
  for (std::size_t channel = 0; channel < best.size(); ++channel)
    best[channel] = strongest_line_of(
        bins.of[channel],
        static_cast<OnLine>(channel) == OnLine::wheels ? bins.crossings_of_wheels : bins.crossings_of_vehicle, low_m,
        towards_rad);
  return best;
}

std::vector<Motions> motions_on(const Line& line, OnLine channel, const DriveView& view) {
  std::vector<Motions> out(named(channel).terms, Motions(view.steps.size()));
  const Vec2 normal = line.normal();
  for (std::size_t i = 0; i < view.steps.size(); ++i)
    each_part(view.steps[i], view.drive.wheelbase_m, channel, normal, [&](const Vec2& place, const auto& units) {
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

// Through the point that is nearest to the middle of the floor: a room may be far from where places are counted from.
std::string name_of(const Line& line, const FloorSquare& floor) {
  const double middle_m = 0.5 * (line.from_m + line.to_m);
  const Vec2 foot = floor.middle + (middle_m - dot(line.normal(), floor.middle)) * line.normal();
  const auto shown = [](double m) { return std::abs(m) < 0.005 ? 0.0 : m; };  // no "-0.00"
  return formatted("a line across the floor through x %.2f, y %.2f m, %.2g m wide, at %.0f degrees", shown(foot.x_m),
                   shown(foot.y_m), line.to_m - line.from_m, line.towards_rad * 180.0 / kPi - 90.0);
}

}  // namespace

std::vector<GenericTest> line_tests(const AskedModel& asked, double looked_at) {
  const FloorSquare floor = square_around(floor_of(asked.joint.views()));
  if (!(floor.half_m > kLineBin_m)) return {};
  std::array<std::array<StrongestLine, kManyOnLine>, kAngles> of;
  parallel_for(kAngles, [&](int angle) {
    of[static_cast<std::size_t>(angle)] = strongest_lines(asked, kPi * angle / kAngles, floor);
  });
  std::vector<std::pair<OnLine, Line>> chosen;
  for (std::size_t channel = 0; channel < kManyOnLine; ++channel) {
    StrongestLine best;
    for (const auto& of_angle : of) {
      looked_at += of_angle[channel].looked_at;
      if (of_angle[channel].strength > best.strength) best = of_angle[channel];
    }
    if (best.strength > 0.0) chosen.emplace_back(static_cast<OnLine>(channel), best.line);
  }
  std::vector<GenericTest> tests(chosen.size());
  parallel_for(static_cast<int>(chosen.size()), [&](int i) {
    const auto [channel, line] = chosen[static_cast<std::size_t>(i)];
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    t = asked_of(
        asked, name_of(line, floor), named(channel).name, named(channel).terms,
        [channel = channel, line = line](const DriveView& view, const std::vector<double>&) {
          return motions_on(line, channel, view);
        },
        looked_at);
    t.of_when_or_where = t.is_no_rival_of_names = true;
  });
  return tests;
}

}  // namespace odolab
