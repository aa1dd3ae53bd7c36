#include "core/diagnosis/generic/waves.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <unsupported/Eigen/FFT>

#include "core/base/parallel.h"
#include "core/diagnosis/generic/counted.h"
#include "core/diagnosis/generic/floor.h"
#include "core/diagnosis/generic/swaying_truth.h"

namespace odolab {

namespace {

constexpr double kBin_m = 0.1;  // of the floor
constexpr double kShortestLength_m = 0.6;
// Neighbours stand so close, in turns over the whole, that what lies between two loses an eighth of its power at most.
constexpr double kTurnsApart = 0.4;
constexpr std::size_t kMostOnTheFloor = 4000;
constexpr int kBands = 3;

// What a wave goes along: what has passed, been driven or turned since the run began, or the floor.
enum class Along { time, way, turning, floor };
// Those with one axis: a cell is so short that no wave turns far within it.
struct Axis {
  Along along;
  const char *name, *unit;
  double cell, shortest, longest;  // of a wave; beyond the longest it is another group's
};
constexpr Axis kAxes[] = {{Along::time, "time", "s", 0.1, 3.0, 1e300},
                          {Along::way, "way", "m", 0.02, 0.12, 20.0},
                          {Along::turning, "turning", "rad", 0.05, 0.25, 2.0 * kPi / 2.4}};

double coordinate(Along along, const DriveView& view, const EffectStep& s) {
  const DifferentialDrive& d = view.drive;
  const double left_m = d.wheel_radius_left_m * s.left_rad, right_m = d.wheel_radius_right_m * s.right_rad;
  return along == Along::time  ? s.since_start_s
         : along == Along::way ? 0.5 * (left_m + right_m)
                               : (right_m - left_m) / d.wheelbase_m;
}

// The first channels are those of all generic groups but for the turn by itself.
constexpr int kChannelsOfAll = kTurnOfItself;

// What a wave modulates: the generic channels; what carries the vehicle across the floor, for each metre of way or, in
// time, for each second that it moves; in time, the pace of the clock, which all motion has in common, and the turn
// by itself, as a wheelbase does that is wider for a while; and, of the floor, how far each wheel rolls where it stands
// itself: along one ripple of a floor both do alike, across it the one and then the other.
constexpr int kAcross = kChannelsOfAll, kPace = kChannelsOfAll + 1, kTurning = kChannelsOfAll + 2,
              kUnderWheels = kChannelsOfAll + 3, kChannels = kChannelsOfAll + 4;

// What is summed up: the generic channels; what carries it across the floor, along x and along y, for each metre and
// for each second; the pace; the turn; the way of one wheel.
enum Slot { across_m = kAcross, across_s = across_m + 2, of_pace = across_s + 2, of_turning, of_wheel, kSlots };
// Those that a wave in time modulates, that one along the way or the turning does, and one on the floor; and the
// channels that they belong to.
struct Modulated {
  int slot, channel;
};
constexpr Modulated kInTime[] = {
    {0, 0}, {1, 1}, {2, 2}, {across_s, kAcross}, {across_s + 1, kAcross}, {of_pace, kPace}, {of_turning, kTurning}};
constexpr Modulated kOnTheWay[] = {{0, 0}, {1, 1}, {2, 2}};
constexpr Modulated kOnTheFloor[] = {
    {0, 0}, {1, 1}, {2, 2}, {across_m, kAcross}, {across_m + 1, kAcross}, {of_wheel, kUnderWheels}};

// A wave: turns for each unit of its axis, or the wave vector in turns per metre.
struct Wave {
  Along along = Along::floor;
  double per_unit = 0.0, apart = 0.0;  // and to the next one that was looked at
  Vec2 per_m;
  int band = 0;
  bool on_the_floor() const { return along == Along::floor; }
  bool in_time() const { return along == Along::time; }
  double turns(const DriveView& view, const EffectStep& s) const {
    return on_the_floor() ? dot(per_m, s.position) : per_unit * coordinate(along, view, s);
  }
};

// How much of a channel there is in one step; the last channel has two, along x and along y of the floor.
struct Unit {
  BodyMotion of[2];
};

// What comes and goes with the way is a place on that axis: driven back, it is undone.
Unit unit_of(const EffectStep& s, double wheelbase_m, int channel, Along along) {
  Unit u;
  if (along == Along::way) {
    BodyMotion& m = u.of[0];
    (channel == 0 ? m.forward_m : channel == 1 ? m.sideways_m : m.turn_rad) = s.forward_m();
    return u;
  }
  if (channel < kAcross) {
    u.of[0] = unit_of_channel(s, wheelbase_m, channel);
    return u;
  }
  if (channel == kPace || channel == kTurning) {
    u.of[0] = {channel == kPace ? s.forward_m() : 0.0, 0.0, s.turn_rad};
    return u;
  }
  const bool moves = s.forward_m() != 0.0 || s.turn_rad != 0.0;
  const double much = along == Along::floor ? std::abs(s.forward_m()) : moves ? s.duration_s : 0.0;
  u.of[0] = {much * s.cos_heading, -much * s.sin_heading, 0.0};
  u.of[1] = {much * s.sin_heading, much * s.cos_heading, 0.0};
  return u;
}

double product(const BodyMotion& a, const BodyMotion& b) {
  return a.forward_m * b.forward_m + a.sideways_m * b.sideways_m + a.turn_rad * b.turn_rad;
}

// What one step adds to each slot.
void add_scores(const DriveView& view, const EffectStep& s, const BodyMotion& of_step, Along along, double* score) {
  const double b = view.drive.wheelbase_m;
  for (int channel = 0; channel < kChannelsOfAll; ++channel)
    score[channel] += product(unit_of(s, b, channel, along).of[0], of_step);
  if (along == Along::way || along == Along::turning) return;
  const Unit u = unit_of(s, b, kAcross, along);
  for (int axis = 0; axis < 2; ++axis)
    score[(along == Along::time ? across_s : across_m) + axis] += product(u.of[axis], of_step);
  if (along != Along::time) return;
  score[of_pace] += product(unit_of(s, b, kPace, along).of[0], of_step);
  score[of_turning] += product(unit_of(s, b, kTurning, along).of[0], of_step);
}

double way_of(const EffectStep& s, Wheel wheel) { return wheel == Wheel::left ? s.left_m : s.right_m; }

Vec2 place_of_wheel(const EffectStep& s, double wheelbase_m, Wheel wheel) {
  const double side = wheel == Wheel::left ? 1.0 : -1.0;
  return s.position + 0.5 * side * wheelbase_m * Vec2{-s.sin_heading, s.cos_heading};
}

// A stretch of a run so short that no wave of the floor turns far within it.
struct Bin {
  Vec2 at;  // in the middle
  double score[kSlots] = {};
};

// `way_m` and `place` are of what goes there, `add` puts the score of one step into a bin.
template <typename Way, typename Place, typename Add>
std::vector<Bin> bins_along(const DriveView& view, const Way& way_m, const Place& place, const Add& add) {
  std::vector<Bin> bins;
  double gone_m = 0.0, steps = 0.0;
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    if (bins.empty() || gone_m > kBin_m) {
      bins.emplace_back();
      gone_m = steps = 0.0;
    }
    Bin& bin = bins.back();
    gone_m += std::abs(way_m(s));
    steps += 1.0;
    bin.at = bin.at + (1.0 / steps) * (place(s) - bin.at);
    add(bin, s, i);
  }
  return bins;
}

std::vector<Bin> bins_of(const DriveView& view, const std::vector<BodyMotion>& score) {
  return bins_along(
      view, [](const EffectStep& s) { return s.forward_m(); }, [](const EffectStep& s) { return s.position; },
      [&](Bin& bin, const EffectStep& s, std::size_t i) { add_scores(view, s, score[i], Along::floor, bin.score); });
}

std::vector<Bin> bins_of_wheel(const DriveView& view, const std::vector<BodyMotion>& score, Wheel wheel) {
  const double b = view.drive.wheelbase_m;
  return bins_along(
      view, [&](const EffectStep& s) { return way_of(s, wheel); },
      [&](const EffectStep& s) { return place_of_wheel(s, b, wheel); },
      [&](Bin& bin, const EffectStep& s, std::size_t i) {
        bin.score[of_wheel] += product(by_wheel(wheel, way_of(s, wheel), b), score[i]);
      });
}

// A wave and the square of its score in every channel.
struct Heard {
  Wave wave;
  std::array<double, kChannels> power{};
};

// A length of no large prime factors, which transforms quickly.
int next_smooth(double least) {
  for (int n = std::max(2, static_cast<int>(std::ceil(least)));; ++n) {
    int left = n;
    for (const int prime : {2, 3, 5})
      while (left % prime == 0) left /= prime;
    if (left == 1 && n % 2 == 0) return n;
  }
}

// Scores are put into cells of the axis, and the transform of these has those of all waves.
std::vector<Heard> heard_along(const Axis& axis, const std::vector<DriveView>& views,
                               const std::vector<std::vector<BodyMotion>>& scores) {
  std::vector<double> low(views.size(), 1e300);
  double span = 0.0;
  for (std::size_t r = 0; r < views.size(); ++r) {
    double high = -1e300;
    for (const EffectStep& s : views[r].steps) {
      const double u = coordinate(axis.along, views[r], s);
      low[r] = std::min(low[r], u), high = std::max(high, u);
    }
    span = std::max(span, high - low[r]);
  }
  std::vector<Heard> heard;
  constexpr double kMostCells = 1e6;
  if (span < 2.0 * axis.shortest || span > kMostCells * axis.cell) return heard;
  const int n = next_smooth(span / axis.cell / kTurnsApart);
  const double apart = 1.0 / (n * axis.cell), most = 1.0 / axis.shortest;
  const double least = std::max(2.0 * kTurnsApart / span, 1.0 / axis.longest);
  const auto first = static_cast<int>(std::ceil(least / apart));
  for (int k = first; k * apart <= most; ++k) {
    Wave w;
    w.along = axis.along;
    w.per_unit = k * apart;
    w.apart = apart;
    w.band =
        std::clamp(static_cast<int>(std::log(w.per_unit / least) / std::log(most / least) * kBands), 0, kBands - 1);
    heard.push_back({w, {}});
  }
  const bool in_time = axis.along == Along::time;
  const Modulated* const begin = in_time ? std::begin(kInTime) : std::begin(kOnTheWay);
  const Modulated* const end = in_time ? std::end(kInTime) : std::end(kOnTheWay);
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  for (std::size_t r = 0; r < views.size(); ++r) {
    std::vector<std::vector<double>> cells(kSlots, std::vector<double>(static_cast<std::size_t>(n), 0.0));
    for (std::size_t i = 0; i < views[r].steps.size(); ++i) {
      const EffectStep& s = views[r].steps[i];
      double score[kSlots] = {};
      add_scores(views[r], s, scores[r][i], axis.along, score);
      const auto cell = static_cast<std::size_t>((coordinate(axis.along, views[r], s) - low[r]) / axis.cell);
      for (const Modulated* m = begin; m != end; ++m) cells[static_cast<std::size_t>(m->slot)][cell] += score[m->slot];
    }
    std::vector<std::complex<double>> transformed;
    for (const Modulated* m = begin; m != end; ++m) {
      fft.fwd(transformed, cells[static_cast<std::size_t>(m->slot)]);
      for (std::size_t k = 0; k < heard.size(); ++k)
        heard[k].power[static_cast<std::size_t>(m->channel)] +=
            std::norm(transformed[k + static_cast<std::size_t>(first)]);
    }
  }
  return heard;
}

// Wave vectors stand on a grid, so that the angle of each is one of x plus one of y, and all scores of a slot are the
// product of two matrices.
std::vector<Heard> heard_on_the_floor(const std::vector<std::vector<Bin>>& of_vehicle,
                                      const std::vector<std::vector<Bin>>& of_wheels, const Floor& floor) {
  const double dx = kTurnsApart / std::max(floor.width_m(), 0.5), dy = kTurnsApart / std::max(floor.height_m(), 0.5);
  const double most = std::min(1.0 / kShortestLength_m,  // half a disc of so many at most
                               std::sqrt(2.0 * static_cast<double>(kMostOnTheFloor) * dx * dy / kPi));
  const auto nx = static_cast<Eigen::Index>(most / dx) + 1, ny = static_cast<Eigen::Index>(most / dy) + 1;
  struct Turned {
    std::vector<const Bin*> bins;
    Eigen::MatrixXd of_x, of_y;  // cosines, then sines
  };
  const auto turned = [&](const std::vector<std::vector<Bin>>& bins) {
    Turned t;
    for (const std::vector<Bin>& of_run : bins)
      for (const Bin& b : of_run) t.bins.push_back(&b);
    const auto n = static_cast<Eigen::Index>(t.bins.size());
    t.of_x.resize(n, 2 * nx), t.of_y.resize(n, 2 * ny);
    for (Eigen::Index b = 0; b < n; ++b) {
      const Vec2 at = t.bins[static_cast<std::size_t>(b)]->at - floor.low;
      for (Eigen::Index i = 0; i < nx; ++i) {
        const double angle = 2.0 * kPi * dx * static_cast<double>(i) * at.x_m;
        t.of_x(b, i) = std::cos(angle), t.of_x(b, nx + i) = std::sin(angle);
      }
      for (Eigen::Index j = 0; j < ny; ++j) {
        const double angle = 2.0 * kPi * dy * static_cast<double>(j) * at.y_m;
        t.of_y(b, j) = std::cos(angle), t.of_y(b, ny + j) = std::sin(angle);
      }
    }
    return t;
  };
  const Turned vehicle = turned(of_vehicle), wheels = turned(of_wheels);
  constexpr std::size_t kMany = std::size(kOnTheFloor);
  std::array<Eigen::MatrixXd, kMany> sums;
  parallel_for(static_cast<int>(kMany), [&](int m) {
    const int slot = kOnTheFloor[m].slot;
    const Turned& of = slot == of_wheel ? wheels : vehicle;
    Eigen::VectorXd score(static_cast<Eigen::Index>(of.bins.size()));
    for (Eigen::Index b = 0; b < score.size(); ++b) score(b) = of.bins[static_cast<std::size_t>(b)]->score[slot];
    sums[static_cast<std::size_t>(m)].noalias() = (score.asDiagonal() * of.of_x).transpose() * of.of_y;
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

// The strongest wave between the neighbours of one: beside its true length it would come and go against what there is.
Wave between_neighbours(Wave wave, int channel, const std::vector<DriveView>& views,
                        const std::vector<std::vector<BodyMotion>>& scores) {
  constexpr int kSteps = 4;  // to either side
  if (wave.on_the_floor()) return wave;
  std::array<double, 2 * kSteps + 1> power{};
  for (std::size_t r = 0; r < views.size(); ++r) {
    std::array<std::array<std::complex<double>, 2>, 2 * kSteps + 1> sum{};
    for (std::size_t i = 0; i < views[r].steps.size(); ++i) {
      const EffectStep& s = views[r].steps[i];
      const Unit u = unit_of(s, views[r].drive.wheelbase_m, channel, wave.along);
      const double along = 2.0 * kPi * coordinate(wave.along, views[r], s);
      const double of[2] = {product(u.of[0], scores[r][i]), product(u.of[1], scores[r][i])};
      std::complex<double> turned = std::polar(1.0, (wave.per_unit - 0.5 * wave.apart) * along);
      const std::complex<double> by = std::polar(1.0, 0.5 * wave.apart / kSteps * along);
      for (auto& of_wave : sum) {
        of_wave[0] += of[0] * turned;
        of_wave[1] += of[1] * turned;
        turned *= by;
      }
    }
    for (std::size_t k = 0; k < power.size(); ++k) power[k] += std::norm(sum[k][0]) + std::norm(sum[k][1]);
  }
  const auto best = std::max_element(power.begin(), power.end()) - power.begin();
  wave.per_unit += 0.5 * wave.apart / kSteps * static_cast<double>(best - kSteps);
  return wave;
}

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
      if (channel == kUnderWheels) {
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

std::string name_of(const Wave& wave) {
  char text[120];
  if (wave.on_the_floor())
    std::snprintf(text, sizeof text, "place, in waves of %.2g m towards %.0f degrees", 1.0 / length(wave.per_m),
                  std::atan2(wave.per_m.y_m, wave.per_m.x_m) * 180.0 / kPi);
  for (const Axis& axis : kAxes)
    if (axis.along == wave.along)
      std::snprintf(text, sizeof text, "%s, in waves of %.2g %s", axis.name, 1.0 / wave.per_unit, axis.unit);
  return text;
}

}  // namespace

std::vector<GenericTest> wave_tests(const AskedModel& asked, double other_tests) {
  const std::vector<DriveView>& views = asked.joint.views();
  const std::size_t runs = views.size();
  std::vector<std::vector<Bin>> bins(runs), of_wheels(2 * runs);
  std::vector<std::vector<BodyMotion>> scores(runs);
  parallel_for(static_cast<int>(runs), [&](int run) {
    const auto r = static_cast<std::size_t>(run);
    scores[r] = asked.joint.score_of_motions(run);
    bins[r] = bins_of(views[r], scores[r]);
    of_wheels[2 * r] = bins_of_wheel(views[r], scores[r], Wheel::left);
    of_wheels[2 * r + 1] = bins_of_wheel(views[r], scores[r], Wheel::right);
  });
  constexpr std::size_t kMany = std::size(kAxes) + 1;
  std::array<std::vector<Heard>, kMany> heard_of;
  parallel_for(static_cast<int>(kMany), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    heard_of[k] = k < std::size(kAxes) ? heard_along(kAxes[k], views, scores)
                                       : heard_on_the_floor(bins, of_wheels, floor_of(views));
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
  for (const Along along : {Along::time, Along::way, Along::turning, Along::floor})
    for (int band = 0; band < kBands; ++band)
      for (int channel = 0; channel < kChannels; ++channel) {
        double best = 0.0;
        const Wave* strongest = nullptr;
        for (const Heard& h : heard)
          if (h.wave.along == along && h.wave.band == band && h.power[static_cast<std::size_t>(channel)] > best)
            best = h.power[static_cast<std::size_t>(channel)], strongest = &h.wave;
        if (strongest) chosen.push_back({strongest, channel});
      }
  double looked_at = other_tests;
  for (const Heard& h : heard)
    looked_at += h.wave.along == Along::time    ? kChannels
                 : h.wave.along == Along::floor ? kChannelsOfAll + 2
                                                : kChannelsOfAll;
  std::vector<GenericTest> tests(chosen.size());
  parallel_for(static_cast<int>(chosen.size()), [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    const int channel = chosen[static_cast<std::size_t>(i)].channel;
    const Wave wave = between_neighbours(*chosen[static_cast<std::size_t>(i)].wave, channel, views, scores);
    t.variable = name_of(wave);
    t.channel = channel == kPace          ? "pace of its clock [1]"
                : channel == kUnderWheels ? "way of the wheel that is there, per metre [1]"
                : channel == kTurning     ? name_of_channel(kTurnOfItself)
                : channel == kAcross
                    ? wave.in_time() ? "carried across the floor [m/s]" : "carried across the floor, per metre [1]"
                    : name_of_channel(channel);
    const std::shared_ptr<const Effect> term = as_effect(wave, channel, runs);
    ask(t, asked, term, looked_at);
    leave_to_counting(t, asked.joint);
    if (wave.in_time()) leave_to_swaying_truth(t, asked.joint);
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
