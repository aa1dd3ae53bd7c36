// A load is put on or off: both rolling radii step at one time, in one recording, in each of them, or from one on.
#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {

// The way of one wheel before and behind a time, in whichever it went less.
double lesser_way_m(const DriveView& view, double at_s, double EffectStep::*way_m) {
  double before = 0.0, behind = 0.0;
  for (const EffectStep& s : view.steps) (s.time_s < at_s ? before : behind) += std::abs(s.*way_m);
  return std::min(before, behind);
}

// `loaded` says from when on, in the recording's time; infinity for never.
Effect from_when(std::function<double(const DriveView&, const std::vector<double>& shape)> loaded) {
  Effect e;
  e.name = "payload_radius_change";
  e.component = "both_wheels";
  e.amplitudes = {{"left", "1", 0.004, -0.25, 0.25}, {"right", "1", 0.004, -0.25, 0.25}};
  e.sentence = "the wheel radii step at one time, as when a load is put on or off";
  e.regime = "from one time on";
  // The likelihood has a new chance with every sample. Over the middle nine tenths of a run, at x = 25 and two
  // amplitudes, (x/2) ((1 - 2/x) ln(19^2) + 4/x) independent ones (Vostrikova 1981), six for each of the eleven that
  // are scanned. Of these a tenth is left by rests, ways that are alike and smaller x: a quarter is counted.
  e.tests_of_a_shape = 1.5;
  e.happens_at_rest = true;
  e.looks_like = {"radius_drift"};
  e.told_apart_by = "a longer run, with the same straight several times";
  // The first count of a run has a remainder of its own: with what comes before the load, or behind it, it must be
  // felt.
  e.beyond_counts = [loaded](const std::vector<double>& value, const std::vector<double>& shape, double count_rad,
                             const std::vector<DriveView>& views) {
    double felt_rad = -1.0;
    for (const DriveView& view : views) {
      const double at_s = loaded(view, shape);
      if (view.steps.empty() || at_s <= view.steps.front().time_s || at_s >= view.steps.back().time_s) continue;
      felt_rad = std::max(
          {felt_rad,
           std::abs(value[0]) * lesser_way_m(view, at_s, &EffectStep::left_m) / view.drive.wheel_radius_left_m,
           std::abs(value[1]) * lesser_way_m(view, at_s, &EffectStep::right_m) / view.drive.wheel_radius_right_m});
    }
    return felt_rad < 0.0 || felt_rad > count_rad;  // between two recordings it is felt in the whole of them
  };
  e.motions = [loaded](const DriveView& view, const std::vector<double>& shape) {
    const std::size_t from = view.step_at(loaded(view, shape));
    const double b = view.drive.wheelbase_m;
    Motions left(from, view.steps.size()), right = left;
    for (std::size_t i = from; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      left[i] = by_wheel(Wheel::left, s.left_m, b);
      right[i] = by_wheel(Wheel::right, s.right_m, b);
    }
    return motions_by_number(std::move(left), std::move(right));
  };
  return e;
}

constexpr double kNever = 1e300;
constexpr double kFromItsOwn_s = 100.0;  // a recording that starts by then counts from its own beginning

double start_s(const DriveView& view) {
  return view.steps.empty() ? 0.0 : view.steps.front().time_s - view.steps.front().since_start_s;
}

double origin_s(const DriveView& view) { return start_s(view) < kFromItsOwn_s ? 0.0 : start_s(view); }

}  // namespace

double put_on_s(double at_s, double recording_starts_s) {
  const bool is_from_start = recording_starts_s >= kFromItsOwn_s && at_s >= 0.0 && at_s < recording_starts_s;
  return is_from_start ? recording_starts_s + at_s : at_s;
}

std::vector<Effect> payload_radius_change() {
  Effect once = from_when([](const DriveView& view, const std::vector<double>& shape) {
    return view.number == static_cast<int>(shape[0]) ? put_on_s(shape[1], start_s(view)) : kNever;
  });
  once.shapes = {{"recording", "1"}, {"at_s", "s"}};
  once.of_one_recording = true;
  once.scan = [](const std::vector<DriveView>& views) {
    std::vector<std::vector<double>> shapes;
    for (const DriveView& v : views) {
      if (v.steps.empty()) continue;
      const double from = v.steps.front().time_s, span = v.steps.back().time_s - from;
      for (int k = 1; k < 12; ++k) shapes.push_back({static_cast<double>(v.number), from + span * k / 12.0});
    }
    return shapes;
  };

  Effect in_each = from_when(
      [](const DriveView& view, const std::vector<double>& shape) { return put_on_s(shape[0], start_s(view)); });
  in_each.shapes = {{"at_s", "s"}};
  in_each.regime = "from one time on in every recording";
  in_each.scan = [](const std::vector<DriveView>& views) {
    std::vector<std::vector<double>> shapes;
    double from = 1e300, to = -1e300;
    for (const DriveView& v : views)
      if (!v.steps.empty()) {
        from = std::min(from, v.steps.front().time_s - origin_s(v));
        to = std::max(to, v.steps.back().time_s - origin_s(v));
      }
    for (int k = 1; k < 24 && views.size() > 1; ++k) shapes.push_back({from + (to - from) * k / 24.0});
    return shapes;
  };

  Effect onwards = from_when([](const DriveView& view, const std::vector<double>& shape) {
    const int first = static_cast<int>(shape[0]);
    return view.number == first ? shape[1] : view.number > first ? -kNever : kNever;
  });
  onwards.shapes = {{"recording", "1"}, {"at_s", "s"}};
  onwards.and_later_recordings = true;
  onwards.regime = "from one time on, and in all recordings behind";
  onwards.scan = [within = once.scan](const std::vector<DriveView>& views) {
    std::vector<std::vector<double>> shapes;
    for (std::size_t k = 1; k < views.size(); ++k)
      if (!views[k].steps.empty()) shapes.push_back({static_cast<double>(k), views[k].steps.front().time_s - 1.0});
    for (std::vector<double>& shape : within(views))  // in the last it is no other than once
      if (shape[0] + 1.0 < static_cast<double>(views.size())) shapes.push_back(std::move(shape));
    return shapes;
  };
  return {once, in_each, onwards};
}

}  // namespace odolab::effects
