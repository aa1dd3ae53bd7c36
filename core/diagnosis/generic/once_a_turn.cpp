#include "core/diagnosis/generic/once_a_turn.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace odolab {

namespace {

using Harmonics = std::vector<std::complex<double>>;  // of once, twice, ... a turn

constexpr int kHarmonics = 8;
constexpr int kPlaces = 72;  // of a turn, that are looked at

Effect harmonics_of_each_run(Wheel wheel, double turns, std::size_t runs) {
  Effect term;
  term.amplitudes.resize(2 * kHarmonics * runs);
  term.motions = [=](const DriveView& view, const std::vector<double>&) {
    std::vector<Motions> out(2 * kHarmonics * runs);
    const auto run = static_cast<std::size_t>(view.number);
    if (run >= runs) return out;
    Motions* const own = &out[2 * kHarmonics * run];
    for (int k = 0; k < 2 * kHarmonics; ++k) own[k] = Motions(view.steps.size());
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const double angle = turns * (wheel == Wheel::left ? s.left_rad : s.right_rad);
      const double way_m = wheel == Wheel::left ? s.left_m : s.right_m;
      for (int k = 0; k < kHarmonics; ++k) {
        own[2 * k][i] = by_wheel(wheel, std::cos((k + 1) * angle) * way_m, view.drive.wheelbase_m);
        own[2 * k + 1][i] = by_wheel(wheel, std::sin((k + 1) * angle) * way_m, view.drive.wheelbase_m);
      }
    }
    return out;
  };
  return term;
}

// The same that far later in the turn.
Harmonics later_in_the_turn(const Harmonics& of, double by_rad) {
  Harmonics out = of;
  for (std::size_t k = 0; k < out.size(); ++k) out[k] *= std::polar(1.0, -static_cast<double>(k + 1) * by_rad);
  return out;
}

double product(const Harmonics& a, const Harmonics& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] * std::conj(b[k])).real();
  return sum;
}

// Of a part of that width about the turn's beginning in which the wheel goes further.
Harmonics of_part(double width_rad) {
  Harmonics out;
  for (int k = 1; k <= kHarmonics; ++k) out.emplace_back(std::sin(0.5 * k * width_rad) / k);
  const double size = std::sqrt(product(out, out));
  for (std::complex<double>& h : out) h /= size;
  return out;
}

double angle_at(int i) { return 2.0 * kPi * i / kPlaces; }

// Each turned to where it is likest to such a part, and all added up.
Harmonics laid_over(const std::vector<Harmonics>& runs, const Harmonics& part, double sign) {
  Harmonics sum(kHarmonics);
  for (const Harmonics& run : runs) {
    int best = 0;
    for (int i = 1; i < kPlaces; ++i)
      if (sign * product(later_in_the_turn(run, angle_at(i)), part) >
          sign * product(later_in_the_turn(run, angle_at(best)), part))
        best = i;
    const Harmonics there = later_in_the_turn(run, angle_at(best));
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += there[k];
  }
  return sum;
}

// The share of its square that lies within a sixth of the turn about its beginning.
double share_within_a_sixth(const Harmonics& shape) {
  double within = 0.0, all = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    double value = 0.0;
    for (std::size_t k = 0; k < shape.size(); ++k)
      value += (shape[k] * std::polar(1.0, -static_cast<double>(k + 1) * angle_at(i))).real();
    all += value * value;
    if (std::abs(wrapped(angle_at(i))) <= kPi / 6.0 + 1e-9) within += value * value;
  }
  return all > 0.0 ? within / all : 0.0;
}

}  // namespace

std::optional<double> part_of_a_turn(const JointModel& without, Wheel wheel, double turns) {
  constexpr double kMost = 0.6;
  const std::size_t runs = without.views().size();
  const Effect term = harmonics_of_each_run(wheel, turns, runs);
  JointModel with = without;
  with.accepted.push_back(
      {.effect = &term, .shape = {}, .value = std::vector<double>(term.amplitudes.size(), 0.0), .is_damped = true});
  with.fit(2);
  const std::vector<double>& value = with.accepted.back().value;
  std::vector<Harmonics> of_runs(runs, Harmonics(kHarmonics));
  for (std::size_t r = 0; r < runs; ++r)
    for (std::size_t k = 0; k < kHarmonics; ++k)
      of_runs[r][k] = {value[2 * (kHarmonics * r + k)], value[2 * (kHarmonics * r + k) + 1]};
  double likest = 0.0, width_rad = 0.0;
  Harmonics shape;
  for (int degrees = 10; degrees <= 90; degrees += 10) {
    const Harmonics part = of_part(degrees * kPi / 180.0);
    for (const double sign : {1.0, -1.0}) {
      Harmonics all = laid_over(of_runs, part, sign);
      const double like = sign * product(all, part);
      if (like > likest) likest = like, width_rad = degrees * kPi / 180.0, shape = std::move(all);
    }
  }
  if (shape.empty() || share_within_a_sixth(shape) < kMost) return std::nullopt;
  return width_rad;
}

std::optional<WheelAngle> angle_of(const GenericTest& group) {
  constexpr double kNearly = 0.03;
  const double times = std::round(group.times_a_turn);
  if (times < 1.0 || times > kHarmonics || std::abs(group.times_a_turn - times) > kNearly * times) return std::nullopt;
  const std::string part = part_of_channel(group.channel);
  if (part != component_of(Wheel::left) && part != component_of(Wheel::right)) return std::nullopt;
  return WheelAngle{part == component_of(Wheel::left) ? Wheel::left : Wheel::right, group.times_a_turn / times};
}

}  // namespace odolab
