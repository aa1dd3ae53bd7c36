#include "core/diagnosis/generic/bands.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/diagnosis/generic/wave.h"

namespace odolab {

namespace {

constexpr int kBins = 50;
constexpr int kWidths[] = {1, 2, 3, 5, 8, 12, 17};  // bins

struct Variable {
  const char *name, *unit;
  double least = 0.0;  // that a band is wide
  OfStep of;
  std::vector<int> channels;
};

std::vector<Variable> variables_of(const Shaken& shaken) {
  const OfStep bend = bend_radps(shaken);
  const auto aside_mps2 = [bend](const EffectStep& s) { return s.speed_mps * bend(s); };
  return {{"speed", "m/s", shaken.speed_mps, [](const EffectStep& s) { return s.speed_mps; }, {0, 2}},
          {"yaw rate", "rad/s", shaken.straight_radps, bend, {0, 2}},
          {"lateral acceleration",
           "m/s2",
           shaken.speed_mps / shaken.base_m,
           aside_mps2,
           {1, 2, kLeftWheelAlone, kRightWheelAlone}},
          {"its own speed", "m/s", shaken.speed_mps, own_speed_mps(shaken, kLeftWheelAlone), {kLeftWheelAlone}},
          {"its own speed", "m/s", shaken.speed_mps, own_speed_mps(shaken, kRightWheelAlone), {kRightWheelAlone}}};
}

// Evenly between the hundredths at both ends of what is met on the way.
struct Bins {
  double low = 0.0, width = 0.0;
  int count = 0;
  int of(double x) const {
    const double k = (x - low) / width;
    return k >= 0.0 && k < count ? static_cast<int>(k) : -1;
  }
};

Bins bins_over(const std::vector<DriveView>& views, const Variable& variable) {
  const std::vector<double> seen = seen_on_the_way(views, variable.of);
  if (seen.size() < kBins) return {};
  const double low = seen[seen.size() / 100], high = seen[seen.size() - 1 - seen.size() / 100];
  if (high - low < 1e-6) return {};
  const int count = std::min(kBins, static_cast<int>((high - low) / std::max(variable.least, 1e-9)));
  return {low, (high - low) / std::max(1, count), count};
}

struct Band {
  double low = 0.0, high = 0.0, strength = 0.0;
  int looked_at = 0;
};

// That of the largest score for its way, and how many were compared.
Band strongest(const Bins& bins, const std::vector<double>& score, const std::vector<double>& way2) {
  constexpr double kLeastShare = 0.005;  // of all way: of less nothing is known but a moment
  double all = 0.0;
  for (const double w : way2) all += w;
  Band best;
  for (const int width : kWidths)
    for (int first = 0; first + width <= bins.count; ++first) {
      double s = 0.0, w = 0.0;
      for (int k = first; k < first + width; ++k)
        s += score[static_cast<std::size_t>(k)], w += way2[static_cast<std::size_t>(k)];
      if (w < kLeastShare * all) continue;
      ++best.looked_at;
      if (s * s / w <= best.strength) continue;
      best.strength = s * s / w;
      best.low = bins.low + first * bins.width, best.high = best.low + width * bins.width;
    }
  return best;
}

Band strongest(const AskedModel& asked, const Variable& variable, int channel) {
  const std::vector<DriveView>& views = asked.joint.views();
  const Bins bins = bins_over(views, variable);
  if (bins.count < 2) return {};
  std::vector<double> score(static_cast<std::size_t>(bins.count)), way2(score.size());
  for (std::size_t r = 0; r < views.size(); ++r)
    for (std::size_t k = 0; k < views[r].steps.size(); ++k) {
      const EffectStep& s = views[r].steps[k];
      const int bin = bins.of(variable.of(s));
      if (bin < 0) continue;
      const BodyMotion u = unit_of_channel(s, views[r].drive.wheelbase_m, channel), &by = asked.scores[r][k];
      score[static_cast<std::size_t>(bin)] += product(u, by);
      way2[static_cast<std::size_t>(bin)] += product(u, u);
    }
  return strongest(bins, score, way2);
}

// What goes further, or turns, in a band by one for each metre.
Motions motions_in_band(const Band& band, const Variable& variable, int channel, const DriveView& view) {
  Motions m(view.steps.size());
  for (std::size_t k = 0; k < view.steps.size(); ++k)
    if (const double x = variable.of(view.steps[k]); x >= band.low && x < band.high)
      m[k] = unit_of_channel(view.steps[k], view.drive.wheelbase_m, channel);
  return m;
}

}  // namespace

std::vector<GenericTest> band_tests(const AskedModel& asked, const Shaken& shaken, double looked_at) {
  struct Asked {
    Variable variable;
    int channel;
    Band band;
  };
  std::vector<Asked> all;
  for (const Variable& v : variables_of(shaken))
    for (const int channel : v.channels) all.push_back({v, channel, {}});
  parallel_for(static_cast<int>(all.size()), [&](int i) {
    Asked& one = all[static_cast<std::size_t>(i)];
    one.band = strongest(asked, one.variable, one.channel);
  });
  for (const Asked& one : all) looked_at += one.band.looked_at;
  std::erase_if(all, [](const Asked& one) { return one.band.strength <= 0.0; });
  std::vector<GenericTest> tests(all.size());
  parallel_for(static_cast<int>(all.size()), [&](int i) {
    const Asked& one = all[static_cast<std::size_t>(i)];
    const std::string name =
        formatted("%s between %.3g and %.3g %s", one.variable.name, one.band.low, one.band.high, one.variable.unit);
    tests[static_cast<std::size_t>(i)] = asked_of(
        asked, name, name_of_channel(one.channel), 1,
        [one](const DriveView& view, const std::vector<double>&) {
          return motions_by_number(motions_in_band(one.band, one.variable, one.channel, view));
        },
        looked_at);
  });
  return tests;
}

}  // namespace odolab
