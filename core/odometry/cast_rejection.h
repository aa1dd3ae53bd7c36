// CAST that finds, by the redundancy of three castors or more, one whose wheels slip or climb something, and disregards
// it while that lasts: the extension that the multi-castor paper leaves for future study.
#pragma once

#include <vector>

#include "core/odometry/cast.h"

namespace odolab {

// What counts as an error that rounding and parameters do not explain.
struct RejectionOptions {
  // A wheel's distance is trusted to this share of it: radii and offsets that are a little off are no fault.
  double distance_share = 0.01;
  // Sum of squared normalised residuals above which the castors contradict each other. With n castors there are 3 n
  // readings for 3 unknowns: at n = 3 chi-squared with 6 degrees of freedom exceeds 28 in 1 of 10 000 intervals.
  double contradiction = 28.0;
  // Without the suspect the others must agree (3 degrees of freedom at n = 3: 1 of 1000) ...
  double agreement = 16.0;
  // ... and it is taken back once its own three residuals stay below this (1 of 20 exceeds it) for so many intervals.
  double back_below = 7.8;
  int back_after = 3;
};

// A castor was disregarded over [from_s, to_s].
struct DisregardedCastor {
  int castor = 0;  // counted from 1
  double from_s = 0.0;
  double to_s = 0.0;
};

struct RejectingTrack {
  Track track;
  std::vector<DisregardedCastor> disregarded;
};

// The same step by step, along a run.
class RejectingCast {
 public:
  // Options as in castor_track_with_rejection.
  RejectingCast(const MultiCastor& vehicle, const Pose& start, const CastOptions& options = {},
                const RejectionOptions& rejection = {});

  void take(const CastorSample& now);  // the first one is where it starts
  const Pose& body() const { return body_; }
  // Castors that were disregarded and taken back; finish() adds those that still are.
  const std::vector<DisregardedCastor>& disregarded() const { return disregarded_; }
  void finish();

 private:
  MultiCastor vehicle_;
  CastOptions options_;
  RejectionOptions rejection_;
  std::vector<char> left_out_, unheard_;  // for good; for good or now
  std::vector<int> quiet_;
  std::vector<double> since_s_;
  CastorSample last_;
  Pose body_;
  std::vector<DisregardedCastor> disregarded_;
};

// `options` as in castor_track, with castors left out for good; at least three must be left to find one by. With two
// nothing can be told, and the track is that of castor_track.
RejectingTrack castor_track_with_rejection(const std::vector<CastorSample>& samples, const MultiCastor& vehicle,
                                           const Pose& start, const CastOptions& options = {},
                                           const RejectionOptions& rejection = {});

}  // namespace odolab
