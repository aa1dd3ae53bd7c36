// The likelihood of the noise with its slopes: README.md in this folder, Eq. 9a.
#pragma once

#include <array>

#include "core/calibration/innovations.h"

namespace odolab {

// The sizes of FittedNoise by number.
namespace noise_size {
constexpr int wheel = 0;
constexpr int position = 1;
constexpr int heading = 2;
constexpr int along = 3;
constexpr int turning = 4;
constexpr int sideways = 5;
constexpr int wander = 6;
constexpr int heading_wander = 7;
constexpr int command_timing = 8;
constexpr int count = 9;
}  // namespace noise_size

double& size_of(FittedNoise& noise, int size);

// Twice the negative log-likelihood, and its slope and expected curvature (Fisher) by the logarithms of the sizes.
struct NoiseSlopes {
  double value = 0.0;
  std::array<double, noise_size::count> slope{};
  std::array<double, noise_size::count * noise_size::count> curvature{};  // row by row
  int scalars = 0;

  void add(const NoiseSlopes& other);
};

// Of the truth samples [first, last) of a run; -1: to the end.
NoiseSlopes noise_slopes(const InnovationRun& run, const SummedRun& summed, const InnovationModel& model, int first = 0,
                         int last = -1);

}  // namespace odolab
