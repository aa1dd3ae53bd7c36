// The most likely sizes of the noise: README.md in this folder, Eq. 10.
#pragma once

#include <functional>
#include <vector>

#include "core/calibration/noise_slopes.h"

namespace odolab {

struct NoiseFit {
  std::vector<int> free;  // of noise_size; the others stay
  FittedNoise usual;      // mild priors keep a size finite that the recordings say nothing about:
  double within = 2.3;    // so far from usual, in logarithms; a factor of ten
  double within_of_truth = 2.3;
  // Shares of the wheels' noise: what is usual of the body (along, turning and sideways), and what nobody is truer than
  // sideways, where nothing rolls.
  double usual_of_body = 0.0, least_sideways = 0.0;

  // Of so many samples of the truth: a few, as of both ends of each run, are hardly more than what they calibrate, and
  // do not say by themselves that they are far truer than such poses are as a rule.
  void expect_usual_truth_of(int samples) {
    constexpr int kFew = 200;
    constexpr double kFactorOfTwo = 0.7;
    if (samples < kFew) within_of_truth = kFactorOfTwo;
  }
  // Lets the truth's wander free too. Not while samples are still thinned until they are white: it would take the noise
  // of neighbours, which ends, for one that goes on.
  void add_wander(bool of_headings);
  // Lets the body's sizes free too. A tenth of the wheels' noise is usual, and sideways less than a fiftieth is not
  // believed.
  void add_body();
  // Lets the timing of commands free too.
  void add_timing() { free.push_back(noise_size::command_timing); }
};

constexpr FittedNoise kUsualNoise = {0.003, 0.002, 0.005, 0.0005, 0.0005, 0.0005, 0.00001, 0.00001, 0.0, 0.02};
// Gives a noise that has none of the body a little, to start a fit from.
FittedNoise with_body(FittedNoise noise);
// Wander, too, if it has less: from next to nothing a fit would not come back.
FittedNoise with_wander(FittedNoise noise);
// A timing of commands, too, if it has none.
FittedNoise with_timing(FittedNoise noise);

// Of one run's truth, from one sample to another.
struct NoiseStretch {
  int run, first, last;
};

// Each run's whole truth where `every` is 1; else every so many-th stretch of so many samples, over all runs. Which are
// taken does not hang on the order in which the runs are given: they are counted by their lengths.
std::vector<NoiseStretch> noise_stretches(const std::vector<const InnovationRun*>& runs, int every, int samples);

// Scoring (R. A. Fisher 1925) on the logarithms from `start`, none of the sizes less than any real one.
FittedNoise most_likely_noise(const std::function<NoiseSlopes(const FittedNoise&)>& likelihood, FittedNoise start,
                              const NoiseFit& fit);

}  // namespace odolab
