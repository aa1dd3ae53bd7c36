#include "core/diagnosis/generic/waves.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/base/parallel.h"
#include "core/diagnosis/generic/floor.h"

namespace odolab {

namespace {

constexpr double kBin_s = 0.1, kBin_m = 0.1;
constexpr double kShortestPeriod_s = 3.0, kShortestLength_m = 0.6;
// Neighbours stand so close, in turns over the whole, that what lies between two loses an eighth of its power at most.
constexpr double kTurnsApart = 0.4;
constexpr std::size_t kMostInTime = 500, kMostOnTheFloor = 4000;
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
  Vec2 at;  // in the middle
  double score[kSlots] = {};
};

enum class Cut { by_time, by_way };

std::vector<Bin> bins_of(const DriveView& view, const std::vector<BodyMotion>& score, Cut cut) {
  std::vector<Bin> bins;
  const double b = view.drive.wheelbase_m;
  double way_m = 0.0, steps = 0.0;
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    const bool full =
        bins.empty() || (cut == Cut::by_time ? s.since_start_s > bins.back().since_start_s + kBin_s : way_m > kBin_m);
    if (full) {
      bins.emplace_back();
      bins.back().since_start_s = s.since_start_s;
      way_m = steps = 0.0;
    }
    Bin& bin = bins.back();
    way_m += std::abs(s.forward_m());
    steps += 1.0;
    bin.at = bin.at + (1.0 / steps) * (s.position - bin.at);
    for (int channel = 0; channel < kGenericChannels; ++channel)
      bin.score[channel] += product(unit_of(s, b, channel, false).of[0], score[i]);
    for (const bool in_time : {false, true}) {
      const Unit u = unit_of(s, b, kAcross, in_time);
      for (int axis = 0; axis < 2; ++axis)
        bin.score[(in_time ? across_s : across_m) + axis] += product(u.of[axis], score[i]);
    }
    bin.score[of_pace] += product(unit_of(s, b, kPace, true).of[0], score[i]);
  }
  return bins;
}

// A wave and the square of its score in every channel.
struct Heard {
  Wave wave;
  std::array<double, kChannels> power{};
};

std::vector<Heard> heard_in_time(const std::vector<std::vector<Bin>>& bins) {
  double duration_s = 0.0;
  for (const std::vector<Bin>& of_run : bins)
    for (const Bin& b : of_run) duration_s = std::max(duration_s, b.since_start_s);
  std::vector<Heard> heard;
  if (duration_s < 2.0 * kShortestPeriod_s) return heard;
  const double step = kTurnsApart / duration_s, most = 1.0 / kShortestPeriod_s;
  for (double f = 2.0 * step; f <= most && heard.size() < kMostInTime; f += step) {
    Wave w;
    w.in_time = true;
    w.per_s = f;
    w.band = std::clamp(static_cast<int>(std::log(f / step) / std::log(most / step) * kBands), 0, kBands - 1);
    heard.push_back({w, {}});
  }
  parallel_for(static_cast<int>(heard.size()), [&](int k) {
    Heard& h = heard[static_cast<std::size_t>(k)];
    for (const std::vector<Bin>& of_run : bins) {
      double part[kSlots][2] = {};
      for (const Bin& b : of_run) {
        const double angle = 2.0 * kPi * h.wave.turns(b.since_start_s, b.at), c = std::cos(angle), s = std::sin(angle);
        for (const Modulated& m : kInTime) {
          part[m.slot][0] += c * b.score[m.slot];
          part[m.slot][1] += s * b.score[m.slot];
        }
      }
      for (const Modulated& m : kInTime)
        h.power[static_cast<std::size_t>(m.channel)] +=
            part[m.slot][0] * part[m.slot][0] + part[m.slot][1] * part[m.slot][1];
    }
  });
  return heard;
}

// Wave vectors stand on a grid, so that the angle of each is one of x plus one of y, and all scores of a slot are the
// product of two matrices.
std::vector<Heard> heard_on_the_floor(const std::vector<std::vector<Bin>>& bins, const Floor& floor) {
  const double dx = kTurnsApart / std::max(floor.width_m(), 0.5), dy = kTurnsApart / std::max(floor.height_m(), 0.5);
  const double most = std::min(1.0 / kShortestLength_m,  // half a disc of so many at most
                               std::sqrt(2.0 * static_cast<double>(kMostOnTheFloor) * dx * dy / kPi));
  const auto nx = static_cast<Eigen::Index>(most / dx) + 1, ny = static_cast<Eigen::Index>(most / dy) + 1;
  std::vector<const Bin*> all;
  for (const std::vector<Bin>& of_run : bins)
    for (const Bin& b : of_run) all.push_back(&b);
  const auto n = static_cast<Eigen::Index>(all.size());
  Eigen::MatrixXd of_x(n, 2 * nx), of_y(n, 2 * ny);  // cosines, then sines
  for (Eigen::Index b = 0; b < n; ++b) {
    const Vec2 at = all[static_cast<std::size_t>(b)]->at - floor.low;
    for (Eigen::Index i = 0; i < nx; ++i) {
      const double angle = 2.0 * kPi * dx * static_cast<double>(i) * at.x_m;
      of_x(b, i) = std::cos(angle), of_x(b, nx + i) = std::sin(angle);
    }
    for (Eigen::Index j = 0; j < ny; ++j) {
      const double angle = 2.0 * kPi * dy * static_cast<double>(j) * at.y_m;
      of_y(b, j) = std::cos(angle), of_y(b, ny + j) = std::sin(angle);
    }
  }
  constexpr std::size_t kMany = std::size(kOnTheFloor);
  std::array<Eigen::MatrixXd, kMany> sums;
  parallel_for(static_cast<int>(kMany), [&](int m) {
    Eigen::VectorXd score(n);
    for (Eigen::Index b = 0; b < n; ++b) score(b) = all[static_cast<std::size_t>(b)]->score[kOnTheFloor[m].slot];
    sums[static_cast<std::size_t>(m)].noalias() = (score.asDiagonal() * of_x).transpose() * of_y;
  });
  std::vector<Heard> heard;
  for (Eigen::Index i = 0; i < nx; ++i)
    for (Eigen::Index j = 0; j < ny; ++j)
      for (const double side : {1.0, -1.0}) {
        if ((i == 0 || j == 0) && side < 0.0) continue;  // the same again
        Wave w;
        w.per_m = {static_cast<double>(i) * dx, side * static_cast<double>(j) * dy};
        const double k = length(w.per_m);
        if (k == 0.0 || k > most) continue;
        w.band = std::min(kBands - 1, static_cast<int>(kBands * k / most));
        Heard h{w, {}};
        for (std::size_t m = 0; m < kMany; ++m) {
          const Eigen::MatrixXd& of = sums[m];
          const double c = of(i, j) - side * of(nx + i, ny + j), s = of(nx + i, j) + side * of(i, ny + j);
          h.power[static_cast<std::size_t>(kOnTheFloor[m].channel)] += c * c + s * s;
        }
        heard.push_back(h);
      }
  return heard;
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
  std::vector<std::vector<Bin>> by_time(runs), by_way(runs);
  parallel_for(static_cast<int>(runs), [&](int run) {
    const auto r = static_cast<std::size_t>(run);
    const std::vector<BodyMotion> score = joint.score_of_motions(run);
    by_time[r] = bins_of(views[r], score, Cut::by_time);
    by_way[r] = bins_of(views[r], score, Cut::by_way);
  });
  std::vector<Heard> heard = heard_in_time(by_time);
  if (heard.empty()) return {};
  const std::vector<Heard> floor = heard_on_the_floor(by_way, floor_of(views));
  heard.insert(heard.end(), floor.begin(), floor.end());

  // The strongest of each band: shorter waves are seen less well, so that scores of one band alone can be held
  // together.
  struct Chosen {
    const Wave* wave;
    int channel;
  };
  std::vector<Chosen> chosen;
  for (const bool in_time : {true, false})
    for (int band = 0; band < kBands; ++band)
      for (int channel = 0; channel < kChannels; ++channel) {
        double best = 0.0;
        const Wave* strongest = nullptr;
        for (const Heard& h : heard)
          if (h.wave.in_time == in_time && h.wave.band == band && h.power[static_cast<std::size_t>(channel)] > best)
            best = h.power[static_cast<std::size_t>(channel)], strongest = &h.wave;
        if (strongest) chosen.push_back({strongest, channel});
      }
  const double looked_at = static_cast<double>(kChannels * heard.size()) + other_tests;
  std::vector<GenericTest> tests(chosen.size());
  parallel_for(static_cast<int>(chosen.size()), [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    const Wave& wave = *chosen[static_cast<std::size_t>(i)].wave;
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
