// Vehicles whose lengths are a little other than in their files, and runs of them.
#pragma once

#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/outside_truth.h"
#include "test/support/linked_runs.h"

namespace odolab::test {

inline Clapper crooked(Clapper actual) {
  actual.truck_a.wheel_radius_left_m *= 1.003;
  actual.truck_b.wheel_radius_right_m *= 0.996;
  actual.truck_b.wheelbase_m *= 1.008;
  return actual;
}

inline Clapper crooked_clapper() { return crooked({}); }

inline EncoderTrailer crooked_trailer() {
  EncoderTrailer actual;
  actual.trailer.wheel_radius_left_m *= 1.004;
  actual.trailer.wheelbase_m *= 0.99;
  return actual;
}

inline MultiCastor crooked_castors() {
  MultiCastor actual = three_castor_vehicle();
  actual.castors[1].wheel_radius_left_m *= 1.002;
  actual.castors[2].offset_m *= 0.997;
  return actual;
}

inline std::vector<Recording> clapper_runs(const Clapper& actual, const LinkedRunSettings& s, std::uint64_t seed) {
  return {linked_run(actual, s, seed), linked_run(actual, s, seed + 1), linked_run(actual, s, seed + 2)};
}

inline MultiCastor castors_with_pivots_elsewhere() {
  MultiCastor actual = crooked_castors();
  const double turned[] = {0.0095, 0.0040, 0.0088}, further_m[] = {0.0004, 0.0010, 0.0019};
  for (std::size_t k = 0; k < 3; ++k) {
    actual.castors[k].pivot_angle_rad += turned[k];
    actual.castors[k].pivot_radius_m += further_m[k];
  }
  return actual;
}

inline std::vector<JoinedRun> joined(const std::vector<Recording>& runs, const Vehicle& vehicle) {
  std::vector<JoinedRun> joined;
  for (const Recording& r : runs) joined.push_back({unit_samples(r, vehicle), tracked_poses(r)});
  return joined;
}

// The encoder of the link's first angle errs by what it reads.
inline void wobble(Recording& run, double amplitude_rad) {
  for (Channel& c : run.channels)
    if (c.name == "link_angle_a_rad")
      for (double& reading : c.values) reading += amplitude_rad * std::sin(3.0 * reading);
}

}  // namespace odolab::test
