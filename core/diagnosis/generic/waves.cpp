#include "core/diagnosis/generic/waves.h"

#include <array>
#include <cmath>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/diagnosis/generic/counted.h"
#include "core/diagnosis/generic/swaying_truth.h"
#include "core/diagnosis/generic/waves_along.h"
#include "core/diagnosis/generic/waves_on_floor.h"

namespace odolab {

namespace {

std::shared_ptr<const Effect> as_effect(const Wave& wave, int channel, std::size_t runs) {
  auto term = std::make_shared<Effect>();
  const std::size_t phases = wave.on_the_floor() ? 1 : runs, of_each = channel == kAcross ? 4 : 2;
  term->amplitudes.resize(phases * of_each);
  term->motions = [=](const DriveView& view, const std::vector<double>&) {
    std::vector<Motions> out(phases * of_each);
    const std::size_t first = wave.on_the_floor() ? 0 : static_cast<std::size_t>(view.number) * of_each;
    if (first >= out.size()) return std::vector<Motions>(out.size(), Motions(view.steps.size()));  // a run not fitted
    for (std::size_t k = 0; k < of_each; ++k) out[first + k] = Motions(view.steps.size());
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const Unit u = unit_of(s, view.drive.wheelbase_m, channel, wave.along);
      if (wave.on_the_floor() && channel == kUnderWheels) {
        for (const Wheel wheel : {Wheel::left, Wheel::right}) {
          const BodyMotion m = by_wheel(wheel, way_of(s, wheel), view.drive.wheelbase_m);
          const double at = 2.0 * kPi * dot(wave.per_m, place_of_wheel(s, view.drive.wheelbase_m, wheel));
          for (std::size_t k = 0; k < of_each; ++k) {
            const double by = k == 0 ? std::cos(at) : std::sin(at);
            out[k][i].forward_m += by * m.forward_m, out[k][i].turn_rad += by * m.turn_rad;
          }
        }
        continue;
      }
      const double angle = 2.0 * kPi * wave.turns(view, s), c = std::cos(angle), sn = std::sin(angle);
      for (std::size_t k = 0; k < of_each; ++k) {
        const double by = k % 2 == 0 ? c : sn;
        const BodyMotion& m = u.of[k / 2];
        out[first + k][i] = {by * m.forward_m, by * m.sideways_m, by * m.turn_rad};
      }
    }
    return out;
  };
  return term;
}

std::string name_of_wave(const Wave& wave) {
  if (wave.on_the_floor())
    return formatted("place, in waves of %.2g m towards %.0f degrees", 1.0 / length(wave.per_m),
                     std::atan2(wave.per_m.y_m, wave.per_m.x_m) * 180.0 / kPi);
  for (const WaveAxis& axis : kAxes)
    if (is_of_a_wheel(wave.along))
      return formatted("its angle, %.3g times a turn", wave.per_unit);
    else if (axis.along == wave.along)
      return formatted("%s, in waves of %.2g %s", axis.name, 1.0 / wave.per_unit, axis.unit);
  return "";
}

}  // namespace

std::vector<GenericTest> wave_tests(const AskedModel& asked, double other_tests) {
  const std::vector<DriveView>& views = asked.joint.views();
  const std::size_t runs = views.size();
  const std::vector<std::vector<BodyMotion>>& scores = asked.scores;
  constexpr std::size_t kMany = std::size(kAxes) + 1;
  std::array<std::vector<Heard>, kMany> heard_of;
  parallel_for(static_cast<int>(kMany), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    heard_of[k] = k < std::size(kAxes) ? heard_along(kAxes[k], views, scores) : heard_on_floor(views, scores);
  });
  if (heard_of.front().empty()) return {};
  std::vector<Heard> heard;
  for (const std::vector<Heard>& of : heard_of) heard.insert(heard.end(), of.begin(), of.end());

  // The strongest of each band: shorter waves are seen less well, so that scores of one band alone can be held
  // together.
  struct Chosen {
    const Wave* wave;
    int channel;
  };
  std::vector<Chosen> chosen;
  for (const Along along :
       {Along::time, Along::way, Along::turning, Along::left_wheel, Along::right_wheel, Along::floor})
    for (int band = 0; band < kWaveBands; ++band)
      for (int channel = 0; channel < kWaveChannels; ++channel) {
        double best = 0.0;
        const Wave* strongest = nullptr;
        for (const Heard& h : heard)
          if (h.wave.along == along && h.wave.band == band && h.power[static_cast<std::size_t>(channel)] > best)
            best = h.power[static_cast<std::size_t>(channel)], strongest = &h.wave;
        if (strongest) chosen.push_back({strongest, channel});
      }
  double looked_at = other_tests;
  for (const Heard& h : heard)
    looked_at += h.wave.along == Along::time    ? kWaveChannels
                 : h.wave.along == Along::floor ? kChannelsOfAll + 2
                 : is_of_a_wheel(h.wave.along)  ? 1
                                                : kChannelsOfAll;
  std::vector<GenericTest> tests(chosen.size());
  parallel_for(static_cast<int>(chosen.size()), [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    const int channel = chosen[static_cast<std::size_t>(i)].channel;
    const Wave wave = between_neighbours(*chosen[static_cast<std::size_t>(i)].wave, channel, views, scores);
    t.variable = name_of_wave(wave);
    t.channel = wave.along == Along::left_wheel    ? "way of the left wheel per metre [1]"
                : wave.along == Along::right_wheel ? "way of the right wheel per metre [1]"
                : channel == kPace                 ? "pace of its clock [1]"
                : channel == kUnderWheels          ? "way of the wheel that is there, per metre [1]"
                : channel == kTurning              ? name_of_channel(kTurnOfItself)
                : channel == kAcross
                    ? wave.in_time() ? "carried across the floor [m/s]" : "carried across the floor, per metre [1]"
                    : name_of_channel(channel);
    if (is_of_a_wheel(wave.along)) t.times_a_turn = wave.per_unit;
    constexpr double kQuick_s = 3.0;
    t.carries_nowhere = wave.in_time() && wave.per_unit * kQuick_s > 1.0;
    const std::shared_ptr<const Effect> term = as_effect(wave, channel, runs);
    ask(t, asked, term, looked_at);
    leave_to_counting(t, asked.joint);
    if (wave.in_time()) leave_to_swaying_truth(t, asked);
    const std::size_t of_each = channel == kAcross ? 4 : 2;
    for (std::size_t k = 0; k < (wave.on_the_floor() ? 1 : runs); ++k)
      for (std::size_t axis = 0; axis < of_each / 2; ++axis) {
        std::string where = channel == kAcross ? axis == 0 ? ", along x" : ", along y" : "";
        if (!wave.on_the_floor() && runs > 1) where += ", recording " + std::to_string(k + 1);
        t.waves.push_back(
            {"phase of " + t.variable + where + " [rad]", {k * of_each + 2 * axis}, {k * of_each + 2 * axis + 1}});
      }
  });
  return tests;
}

}  // namespace odolab
