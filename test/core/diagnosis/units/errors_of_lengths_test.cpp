#include "core/diagnosis/units/errors_of_lengths.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/units/outside_truth.h"
#include "core/diagnosis/units/unit_recordings.h"
#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

// A trailer's truth is what the hitch makes of the tow's, with a drawbar, a hitch and a marker that are known to a
// millimetre and a milliradian: together they put the trailer's ends off by more than its wheels slip on the way.
TEST(ErrorsOfLengths, AreInWhatIsSaidOfTheRadiiOfATrailer) {
  EncoderTrailer file, actual;
  file.hitch_angle_resolution_rad = actual.hitch_angle_resolution_rad = 0.0001;
  LinkedRunSettings s;
  s.truth_m = 0.005;
  s.truth_rad = 0.01;
  s.duration_s = 40.0;
  double squares = 0.0, squares_without = 0.0;
  constexpr int kFits = 30;
  for (int fit = 0; fit < kFits; ++fit) {
    std::vector<JoinedRun> runs;
    std::vector<Recording> own;
    std::vector<std::vector<UnitSample>> samples;
    const Vehicle nominal = vehicle_of(file);
    std::vector<Recording> recordings;
    for (std::uint64_t k = 0; k < 2; ++k) {
      recordings.push_back(trailer_run(actual, s, 1901 + 10 * static_cast<std::uint64_t>(fit) + k));
      samples.push_back(unit_samples(recordings.back(), nominal));
      runs.push_back({samples.back(), tracked_poses(recordings.back())});
    }
    const GeometryFit geometry = fitted_geometry(runs, nominal);
    for (std::size_t k = 0; k < runs.size(); ++k)
      own.push_back(recording_of_unit(recordings[k], samples[k], runs[k].tracked, geometry.vehicle, 0,
                                      geometry.clock_s[k], true));
    auto calibrated = calibrate_least_squares(own, vehicle_of_unit(units_of(nominal)[0], nominal));
    ASSERT_TRUE(calibrated);
    const auto off_in_errors = [&] {
      const ParameterEstimate& left = calibrated->parameters[0];
      return (left.value - actual.trailer.wheel_radius_left_m) / left.stderr_value;
    };
    squares_without += off_in_errors() * off_in_errors() / kFits;
    add_errors_of_lengths(own, samples, geometry.vehicle, 0, uncertain_lengths(geometry), *calibrated);
    squares += off_in_errors() * off_in_errors() / kFits;
  }
  // Stretches of half a metre know their own covariance to a quarter, so the mean of 30 squares is up to 1.6 and
  // scatters by a quarter of that: within three.
  constexpr double kMost = 2.8;
  EXPECT_GT(squares_without, kMost);
  EXPECT_LT(squares, kMost);
  EXPECT_GT(squares, 0.2);
}

}  // namespace
}  // namespace odolab::test
