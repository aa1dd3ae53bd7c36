// Above a wheel speed a share of the counts is lost: the wheel turns further than its encoder says.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/effects/forms.h"

namespace odolab::effects {

namespace {

// Limits of a wheel's speed to try: an even grid, and halfway from one twentieth of the way to the next, by how fast
// the wheel went there. Between two speeds that a vehicle keeps all limits are one, and beyond either is another; a
// grid alone steps over it.
std::vector<std::vector<double>> limits(const std::vector<DriveView>& views, Wheel wheel) {
  constexpr int kParts = 20, kGrid = 12;
  constexpr double kApart = 0.01;  // of the highest speed
  std::vector<std::pair<double, double>> speed_and_way;
  double total_m = 0.0;
  const auto add = [&](double speed_radps, double way_m) {
    speed_and_way.emplace_back(std::abs(speed_radps), std::abs(way_m));
    total_m += std::abs(way_m);
  };
  for (const DriveView& v : views)
    for (const EffectStep& s : v.steps) {
      if (wheel != Wheel::right) add(s.left_radps, s.left_m);
      if (wheel != Wheel::left) add(s.right_radps, s.right_m);
    }
  if (total_m <= 0.0) return {};
  std::sort(speed_and_way.begin(), speed_and_way.end());
  const double most = speed_and_way.back().first;
  std::vector<double> all, parts;
  for (int k = 2; k < kGrid; ++k) all.push_back(most * k / kGrid);
  double gone_m = 0.0;
  for (const auto& [speed, way_m] : speed_and_way) {
    gone_m += way_m;
    while (std::ssize(parts) + 1 < kParts && gone_m * kParts >= total_m * static_cast<double>(parts.size() + 1))
      parts.push_back(speed);
  }
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) all.push_back(0.5 * (parts[k] + parts[k + 1]));
  std::sort(all.begin(), all.end());
  std::vector<std::vector<double>> shapes;
  for (const double limit : all)
    if (shapes.empty() || limit - shapes.back()[0] > kApart * most) shapes.push_back({limit});
  return shapes;
}

// Whether a drive keeps a speed so near the limit that the wheel's own noise carries it across. What holds a wheel up
// makes it both turn slower and roll less: which readings lie above would be chosen by the noise that they hold.
bool hovers_about(double limit_radps, const DriveView& view, double EffectStep::*speed_radps,
                  double EffectStep::*way_m) {
  constexpr double kNear = 0.01, kMost = 0.1;  // of the limit; of the way
  double near_m = 0.0, all_m = 0.0;
  for (const EffectStep& s : view.steps) {
    all_m += std::abs(s.*way_m);
    if (std::abs(std::abs(s.*speed_radps) - limit_radps) < kNear * limit_radps) near_m += std::abs(s.*way_m);
  }
  return near_m > kMost * all_m;
}

// Of the way above the limit, how much is so near to it that a motor's ripple carries the wheel across.
double way_near(double limit_radps, Wheel wheel, const std::vector<DriveView>& views) {
  constexpr double kNear = 0.03;  // of the limit
  double near_m = 0.0, above_m = 0.0;
  const auto add = [&](double speed_radps, double way_m) {
    if (std::abs(speed_radps) > limit_radps) above_m += std::abs(way_m);
    if (std::abs(std::abs(speed_radps) - limit_radps) < kNear * limit_radps) near_m += std::abs(way_m);
  };
  for (const DriveView& v : views)
    for (const EffectStep& s : v.steps) {
      if (wheel != Wheel::right) add(s.left_radps, s.left_m);
      if (wheel != Wheel::left) add(s.right_radps, s.right_m);
    }
  return above_m > 0.0 ? std::min(1.0, near_m / above_m) : 0.0;
}

Motions missed_by(Wheel wheel, const DriveView& view, double limit_radps, const MissedForm& form) {
  if ((wheel != Wheel::right && hovers_about(limit_radps, view, &EffectStep::left_radps, &EffectStep::left_m)) ||
      (wheel != Wheel::left && hovers_about(limit_radps, view, &EffectStep::right_radps, &EffectStep::right_m)))
    return Motions(view.steps.size());
  Motions m;
  m.reserve(view.steps.size());
  for (const EffectStep& s : view.steps) {
    const double l = wheel == Wheel::right ? 0.0 : form.share(std::abs(s.left_radps), limit_radps) * s.left_m;
    const double r = wheel == Wheel::left ? 0.0 : form.share(std::abs(s.right_radps), limit_radps) * s.right_m;
    m.push_back({0.5 * (l + r), 0.0, (r - l) / view.drive.wheelbase_m});
  }
  return m;
}

Effect missed_counts_of(Wheel wheel) {
  Effect e;
  e.name = "encoder_missed_counts";
  e.component = component_of(wheel);
  // Amplitudes: what is missing of what was read. Of what there was, a share f of a / (1 + a) is lost; and where a
  // wheel is read to turn at w, it turns (1 + a) times as fast.
  static constexpr double kMostLost = 0.99;
  e.amplitudes = {{"fraction", "1", 0.01, 0.0, kMostLost}};
  e.to_parameters = [](const std::vector<double>& v, const std::vector<double>& se) {
    const double kept = 1.0 / (1.0 + v[0]);
    return std::vector<FoundParameter>{{"fraction", 1.0 - kept, se[0] * kept * kept, "1"}};
  };
  e.from_parameters = [](const ActiveEffect& active) {
    const double lost = active.parameter("fraction");
    return std::vector<double>{lost / (1.0 - std::min(lost, kMostLost))};
  };
  e.shapes_read_as = [](const std::vector<double>& v) { return 1.0 + v[0]; };
  e.shapes = {{"above_radps", "rad/s", 0.0, 0.0, 1e3}};
  e.tests_of_a_shape = 0.3;
  e.sentence = std::string("the encoder of ") +
               (wheel == Wheel::left    ? "the left wheel"
                : wheel == Wheel::right ? "the right wheel"
                                        : "both wheels") +
               " misses a share of its counts above a speed";
  e.regime = "above a wheel speed";
  e.looks_like = {"speed_dependent_radius", "turn_scrub"};
  e.told_apart_by = "straights and turns at three speeds, each held for a few metres";
  for (const MissedForm& form : kMissedForms) e.forms.push_back(form.in_words);
  e.form_goes_with = [wheel](const std::vector<double>& value, const std::vector<double>& shape, double count_rad,
                             const std::vector<DriveView>& views) {
    if (kMissedForms[std::lround(shape.back())].within == 0.0) return true;
    return part_by_more_than_counts(
        [&](const DriveView& view) {
          return missed_by(wheel, view, shape[0], kMissedForms[std::lround(shape.back())]);
        },
        [&](const DriveView& view) { return missed_by(wheel, view, shape[0], kMissedForms[0]); }, value[0], count_rad,
        views);
  };
  e.motions = [wheel](const DriveView& view, const std::vector<double>& shape) {
    return motions_by_number(missed_by(wheel, view, shape[0], kMissedForms[std::lround(shape.back())]));
  };
  e.near_its_limit = [wheel](const std::vector<double>& shape, const std::vector<DriveView>& views) {
    return kMissedForms[std::lround(shape.back())].within > 0.0 ? 0.0 : way_near(shape[0], wheel, views);
  };
  e.scan = [wheel](const std::vector<DriveView>& views) { return limits(views, wheel); };
  return e;
}
}  // namespace

std::vector<Effect> encoder_missed_counts() {
  return {missed_counts_of(Wheel::left), missed_counts_of(Wheel::right), missed_counts_of(Wheel::both)};
}

}  // namespace odolab::effects
