// Odometry of vehicles with two castors or more: CAST, least squares over the ways of their pivots, and IPEC for two of
// them. J. Doebbler, J. J. Davis, J. L. Junkins, J. Valasek, "Odometry and Calibration Methods for Multi-Castor
// Vehicles", 2008; equation numbers are that paper's.
#pragma once

#include <vector>

#include "core/geometry/track.h"
#include "core/odometry/castor_motion.h"

namespace odolab {

// How the body's motion is had from those of the pivots.
enum class CastorMethod {
  cast,          // least squares in general, Eqs. 15 to 21
  cast_centred,  // Eq. 22: only where the body's origin is the middle of the pivots that are used, all at one radius
  ipec,          // Eq. 10: the direction between two pivots; the position is the first one's
};

// Where Eqs. 13 and 14 are linearised.
enum class Linearisation {
  middle_heading,  // between old and new, by iteration: then the equations are exact in 2 sin(turn / 2)
  old_heading,     // as printed: of first order for two castors; for three about the centre the error cancels
};

struct CastOptions {
  CastorMethod method = CastorMethod::cast;
  HeadingRule heading = HeadingRule::middle;  // of each castor's travel; end_as_printed explains Table II
  Linearisation linearisation = Linearisation::middle_heading;
  int left_out = 0;  // castor i of IPEC-i and CAST-i, counted from 1; 0: none
};

// Why these options do not fit a vehicle, as a sentence; empty where they do. IPEC takes exactly two castors.
std::string problem_in(const CastOptions& options, const MultiCastor& vehicle);

// A castor that takes part, and the way of its pivot by its encoders.
struct PivotWay {
  const Castor* castor = nullptr;
  Vec2 way;
};

// The ways of all pivots over one interval that begins at `body`, without those left out.
std::vector<PivotWay> pivot_ways(const MultiCastor& vehicle, const CastorSample& before, const CastorSample& now,
                                 const Pose& body, HeadingRule rule, const std::vector<char>& left_out);

// The body's pose after the interval.
Pose moved_by_pivots(const Pose& body, const std::vector<PivotWay>& pivots, const CastOptions& options);

// The body's track through all samples. Options without problems.
Track castor_track(const std::vector<CastorSample>& samples, const MultiCastor& vehicle, const Pose& start,
                   const CastOptions& options = {});

}  // namespace odolab
