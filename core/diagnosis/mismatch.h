// How large a mismatch is along a recording, in times what noise would leave: what the report and the window both draw.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/diagnosis/diagnosis.h"

namespace odolab {

// The size of one innovation of each channel where nothing but noise is left.
struct ResidualSizes {
  double along_m = 0.0, across_m = 0.0, heading_rad = 0.0;
};

// The noise under which both models are drawn, from that which calibration alone leaves and that which is left with the
// findings: midway, in logarithms. One that has grown with what is missing lets go of the wheels at once and hides it;
// the one that is left carries on for seconds what happened in one place.
FittedNoise noise_of_pictures(FittedNoise calibrated, const FittedNoise& with_findings);

// Where an axis of time begins whose stamps count from some day in 1970: their digits say nothing. 0 for others.
double axis_origin_s(double first_s);

// From the middle of the sizes, so that few outliers do not count.
ResidualSizes sizes_of(const Residuals& residuals);

// How many times larger than noise would leave it the residual is, gathered over 0.1 s and over 1 s around each sample,
// the larger of the two: short enough for a bump, long enough for what is faint.
std::vector<double> times_noise(const Residuals& residuals, const ResidualSizes& noise);

// Mean of the normalised squares.
double mean_square(const Residuals& residuals);

// Those of a recording, or of the first of its units; null where there are none.
const Residuals* of_recording(const std::vector<Residuals>& all, const std::string& recording);

// The scale by which a mismatch is coloured: the steps from one level to the next, in times the noise, and their words.
constexpr double kMismatchSteps[] = {2.0, 3.0, 5.0, 8.0};
constexpr int kMismatchLevels = 5;
const char* mismatch_level_text(int level);
// From 0, noise, to 4.
int mismatch_level(double times_noise);

// A recording's mismatch before and after the findings, sample by sample.
struct MismatchOverTime {
  std::vector<double> time_s, x_m, y_m;                     // of the corrected pose
  std::vector<double> before, after;                        // times the noise; `after` is empty where nothing was found
  double largest_before(double from_s, double to_s) const;  // 0 where there is no sample
  double largest_after(double from_s, double to_s) const;
};
MismatchOverTime mismatch_over_time(const Diagnosis& diagnosis, const std::string& recording);

// When findings act in that recording, or in what a unit of it did, on the clock of its residuals: where they were tied
// to times, or while it is in the zone that was found.
struct LocatedStretch {
  std::size_t finding = 0;
  double from_s = 0.0, to_s = 0.0;
};
std::vector<LocatedStretch> located_stretches(const Diagnosis& diagnosis, const std::string& recording);

}  // namespace odolab
