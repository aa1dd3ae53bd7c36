#include "core/diagnosis/generic/waves.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "core/base/parallel.h"
#include "core/diagnosis/generic/floor.h"

namespace odolab {

namespace {

constexpr double kBin_s = 0.1;
constexpr double kShortestPeriod_s = 3.0, kShortestLength_m = 0.6;
// Neighbours stand so close, in turns over the whole, that what lies between two loses an eighth of its power at most.
constexpr double kTurnsApart = 0.4;
constexpr std::size_t kMostWaves = 500;
constexpr int kBands = 3;

// What a wave modulates: the generic channels; what carries the vehicle across the floor, for each metre of way or, in
// time, for each second that it moves; and, in time, the pace of the clock, which all motion has in common.
constexpr int kAcross = kGenericChannels, kPace = kGenericChannels + 1, kChannels = kGenericChannels + 2;

// What is summed up: the generic channels; what carries it across the floor, along x and along y, for each metre and
// for each second; the pace.
enum Slot { across_m = kAcross, across_s = across_m + 2, of_pace = across_s + 2, kSlots };
// Those that a wave in time modulates and that one on the floor does, and the channels that they belong to.
struct Modulated {
  int slot, channel;
};
constexpr Modulated kInTime[] = {{0, 0},          {1, 1}, {2, 2}, {across_s, kAcross}, {across_s + 1, kAcross},
                                 {of_pace, kPace}};
constexpr Modulated kOnTheFloor[] = {{0, 0}, {1, 1}, {2, 2}, {across_m, kAcross}, {across_m + 1, kAcross}};

// A wave: turns per second, or the wave vector in turns per metre.
struct Wave {
  bool in_time = false;
  double per_s = 0.0;
  Vec2 per_m;
  int band = 0;
  double turns(double since_start_s, const Vec2& at) const { return in_time ? per_s * since_start_s : dot(per_m, at); }
};

// How much of a channel there is in one step; the last channel has two, along x and along y of the floor.
struct Unit {
  BodyMotion of[2];
};

Unit unit_of(const EffectStep& s, double wheelbase_m, int channel, bool in_time) {
  Unit u;
  if (channel < kAcross) {
    u.of[0] = unit_of_channel(s, wheelbase_m, channel);
    return u;
  }
  if (channel == kPace) {
    u.of[0] = {s.forward_m(), 0.0, s.turn_rad};
    return u;
  }
  const bool moves = s.forward_m() != 0.0 || s.turn_rad != 0.0;
  const double much = !in_time ? std::abs(s.forward_m()) : moves ? s.duration_s : 0.0;
  u.of[0] = {much * s.cos_heading, -much * s.sin_heading, 0.0};
  u.of[1] = {much * s.sin_heading, much * s.cos_heading, 0.0};
  return u;
}

double product(const BodyMotion& a, const BodyMotion& b) {
  return a.forward_m * b.forward_m + a.sideways_m * b.sideways_m + a.turn_rad * b.turn_rad;
}

// A stretch of a run so short that no wave turns far within it.
struct Bin {
  double since_start_s = 0.0;
  Vec2 at;
  double score[kSlots] = {};
};

std::vector<Bin> bins_of(const DriveView& view, const std::vector<BodyMotion>& score) {
  std::vector<Bin> bins;
  const double b = view.drive.wheelbase_m;
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    if (bins.empty() || s.since_start_s > bins.back().since_start_s + kBin_s) {
      bins.emplace_back();
      bins.back().since_start_s = s.since_start_s;
      bins.back().at = s.position;
    }
    double* sum = bins.back().score;
    for (int channel = 0; channel < kGenericChannels; ++channel)
      sum[channel] += product(unit_of(s, b, channel, false).of[0], score[i]);
    for (const bool in_time : {false, true}) {
      const Unit u = unit_of(s, b, kAcross, in_time);
      for (int axis = 0; axis < 2; ++axis) sum[(in_time ? across_s : across_m) + axis] += product(u.of[axis], score[i]);
    }
    sum[of_pace] += product(unit_of(s, b, kPace, true).of[0], score[i]);
  }
  return bins;
}

std::vector<Wave> waves_in_time(double duration_s) {
  std::vector<Wave> waves;
  const double step = kTurnsApart / duration_s, most = 1.0 / kShortestPeriod_s;
  for (double f = 2.0 * step; f <= most && waves.size() < kMostWaves; f += step) {
    Wave w;
    w.in_time = true;
    w.per_s = f;
    waves.push_back(w);
  }
  for (std::size_t k = 0; k < waves.size(); ++k)
    waves[k].band =
        std::clamp(static_cast<int>(std::log(waves[k].per_s / step) / std::log(most / step) * kBands), 0, kBands - 1);
  return waves;
}

std::vector<Wave> waves_on_the_floor(double width_m, double height_m) {
  std::vector<Wave> waves;
  const double dx = kTurnsApart / std::max(width_m, 0.5), dy = kTurnsApart / std::max(height_m, 0.5);
  double most = 1.0 / kShortestLength_m;
  most = std::min(most, std::sqrt(2.0 * static_cast<double>(kMostWaves) * dx * dy / kPi));  // half a disc of so many
  for (int i = 0; i * dx <= most; ++i)
    for (int j = -static_cast<int>(most / dy); j * dy <= most; ++j) {
      if (i == 0 && j <= 0) continue;
      Wave w;
      w.per_m = {i * dx, j * dy};
      const double k = length(w.per_m);
      if (k > most) continue;
      w.band = std::min(kBands - 1, static_cast<int>(kBands * k / most));
      waves.push_back(w);
    }
  return waves;
}

std::shared_ptr<const Effect> as_effect(const Wave& wave, int channel, std::size_t runs) {
  auto term = std::make_shared<Effect>();
  const std::size_t phases = wave.in_time ? runs : 1, of_each = channel == kAcross ? 4 : 2;
  term->amplitudes.resize(phases * of_each);
  term->motions = [=](const DriveView& view, const std::vector<double>&) {
    std::vector<Motions> out(phases * of_each);
    const std::size_t first = wave.in_time ? static_cast<std::size_t>(view.number) * of_each : 0;
    if (first >= out.size()) return std::vector<Motions>(out.size(), Motions(view.steps.size()));  // a run not fitted
    for (std::size_t k = 0; k < of_each; ++k) out[first + k] = Motions(view.steps.size());
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const Unit u = unit_of(s, view.drive.wheelbase_m, channel, wave.in_time);
      const double angle = 2.0 * kPi * wave.turns(s.since_start_s, s.position), c = std::cos(angle),
                   sn = std::sin(angle);
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

std::string name_of(const Wave& wave) {
  char text[120];
  if (wave.in_time)
    std::snprintf(text, sizeof text, "time, in waves of %.2g s", 1.0 / wave.per_s);
  else
    std::snprintf(text, sizeof text, "place, in waves of %.2g m towards %.0f degrees", 1.0 / length(wave.per_m),
                  std::atan2(wave.per_m.y_m, wave.per_m.x_m) * 180.0 / kPi);
  return text;
}

}  // namespace

std::vector<GenericTest> wave_tests(const JointModel& joint, double other_tests) {
  const std::vector<DriveView>& views = joint.views();
  const std::size_t runs = views.size();
  std::vector<std::vector<Bin>> bins(runs);
  parallel_for(static_cast<int>(runs), [&](int r) {
    bins[static_cast<std::size_t>(r)] = bins_of(views[static_cast<std::size_t>(r)], joint.score_of_motions(r));
  });
  double duration_s = 0.0;
  for (const std::vector<Bin>& of_run : bins)
    for (const Bin& b : of_run) duration_s = std::max(duration_s, b.since_start_s);
  if (duration_s < 2.0 * kShortestPeriod_s) return {};
  std::vector<Wave> waves = waves_in_time(duration_s);
  const Floor floor = floor_of(views);
  const std::vector<Wave> on_it = waves_on_the_floor(floor.width_m(), floor.height_m());
  waves.insert(waves.end(), on_it.begin(), on_it.end());

  // The square of the score of every wave in every channel.
  std::vector<std::array<double, kChannels>> power(waves.size());
  parallel_for(static_cast<int>(waves.size()), [&](int k) {
    const Wave& wave = waves[static_cast<std::size_t>(k)];
    std::array<double, kChannels> sum{};
    const std::span<const Modulated> modulated =
        wave.in_time ? std::span<const Modulated>(kInTime) : std::span<const Modulated>(kOnTheFloor);
    double part[kSlots][2] = {};
    const auto close = [&] {
      for (const Modulated& m : modulated) {
        double* p = part[m.slot];
        sum[static_cast<std::size_t>(m.channel)] += p[0] * p[0] + p[1] * p[1];
        p[0] = p[1] = 0.0;
      }
    };
    for (const std::vector<Bin>& of_run : bins) {
      for (const Bin& b : of_run) {
        const double angle = 2.0 * kPi * wave.turns(b.since_start_s, b.at), c = std::cos(angle), s = std::sin(angle);
        for (const Modulated& m : modulated) {
          part[m.slot][0] += c * b.score[m.slot];
          part[m.slot][1] += s * b.score[m.slot];
        }
      }
      if (wave.in_time) close();
    }
    if (!wave.in_time) close();
    power[static_cast<std::size_t>(k)] = sum;
  });

  // The strongest of each band: shorter waves are seen less well, so that scores of one band alone can be held
  // together.
  struct Chosen {
    std::size_t wave;
    int channel;
  };
  std::vector<Chosen> chosen;
  for (const bool in_time : {true, false})
    for (int band = 0; band < kBands; ++band)
      for (int channel = 0; channel < kChannels; ++channel) {
        double best = 0.0;
        std::size_t at = waves.size();
        for (std::size_t k = 0; k < waves.size(); ++k)
          if (waves[k].in_time == in_time && waves[k].band == band &&
              power[k][static_cast<std::size_t>(channel)] > best)
            best = power[k][static_cast<std::size_t>(channel)], at = k;
        if (at < waves.size()) chosen.push_back({at, channel});
      }
  const double looked_at = static_cast<double>(kChannels * waves.size()) + other_tests;
  std::vector<GenericTest> tests(chosen.size());
  parallel_for(static_cast<int>(chosen.size()), [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    const Wave& wave = waves[chosen[static_cast<std::size_t>(i)].wave];
    const int channel = chosen[static_cast<std::size_t>(i)].channel;
    t.variable = name_of(wave);
    t.channel = channel == kPace ? "pace of its clock [1]"
                : channel == kAcross
                    ? wave.in_time ? "carried across the floor [m/s]" : "carried across the floor, per metre [1]"
                    : name_of_channel(channel);
    const std::shared_ptr<const Effect> term = as_effect(wave, channel, runs);
    ask(t, joint, term, looked_at);
    const std::size_t of_each = channel == kAcross ? 4 : 2;
    for (std::size_t k = 0; k < (wave.in_time ? runs : 1); ++k)
      for (std::size_t axis = 0; axis < of_each / 2; ++axis) {
        std::string where = channel == kAcross ? axis == 0 ? ", along x" : ", along y" : "";
        if (wave.in_time && runs > 1) where += ", recording " + std::to_string(k + 1);
        t.waves.push_back(
            {"phase of " + t.variable + where + " [rad]", {k * of_each + 2 * axis}, {k * of_each + 2 * axis + 1}});
      }
  });
  return tests;
}

}  // namespace odolab
