#include "core/diagnosis/generic/waves_along.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <span>
#include <unsupported/Eigen/FFT>

namespace odolab {

namespace {

constexpr Modulated kInTime[] = {
    {0, 0}, {1, 1}, {2, 2}, {across_s, kAcross}, {across_s + 1, kAcross}, {of_pace, kPace}, {of_turning, kTurning}};
constexpr Modulated kOnTheWay[] = {{0, 0}, {1, 1}, {2, 2}};
constexpr Modulated kOfAWheel[] = {{of_wheel, kUnderWheels}};

std::span<const Modulated> modulated_by(Along along) {
  if (is_of_a_wheel(along)) return kOfAWheel;
  return along == Along::time ? std::span<const Modulated>(kInTime) : std::span<const Modulated>(kOnTheWay);
}

// What comes once a turn of a wheel has a name.
bool is_once_a_turn(const Wave& wave) { return wave.per_unit > 1.0 / 1.2 && wave.per_unit < 1.2; }

// A length of no large prime factors, which transforms quickly.
int next_smooth(double least) {
  for (int n = std::max(2, static_cast<int>(std::ceil(least)));; ++n) {
    int left = n;
    for (const int prime : {2, 3, 5})
      while (left % prime == 0) left /= prime;
    if (left == 1 && n % 2 == 0) return n;
  }
}

}  // namespace

// Scores are put into cells of the axis, and the transform of these has those of all waves.
std::vector<Heard> heard_along(const WaveAxis& axis, const std::vector<DriveView>& views,
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
    w.band = std::clamp(static_cast<int>(std::log(w.per_unit / least) / std::log(most / least) * kWaveBands), 0,
                        kWaveBands - 1);
    heard.push_back({w, {}});
  }
  const std::span<const Modulated> modulated = modulated_by(axis.along);
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  for (std::size_t r = 0; r < views.size(); ++r) {
    std::vector<std::vector<double>> cells(kSlots, std::vector<double>(static_cast<std::size_t>(n), 0.0));
    for (std::size_t i = 0; i < views[r].steps.size(); ++i) {
      const EffectStep& s = views[r].steps[i];
      double score[kSlots] = {};
      add_scores(views[r], s, scores[r][i], axis.along, score);
      const auto cell = static_cast<std::size_t>((coordinate(axis.along, views[r], s) - low[r]) / axis.cell);
      for (const Modulated& m : modulated) cells[static_cast<std::size_t>(m.slot)][cell] += score[m.slot];
    }
    std::vector<std::complex<double>> transformed;
    for (const Modulated& m : modulated) {
      fft.fwd(transformed, cells[static_cast<std::size_t>(m.slot)]);
      for (std::size_t k = 0; k < heard.size(); ++k)
        heard[k].power[static_cast<std::size_t>(m.channel)] +=
            std::norm(transformed[k + static_cast<std::size_t>(first)]);
    }
  }
  if (is_of_a_wheel(axis.along)) std::erase_if(heard, [](const Heard& h) { return is_once_a_turn(h.wave); });
  return heard;
}

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

}  // namespace odolab
