// Internal Position Error Correction: two trucks on a link correct each other's heading. J. Borenstein, "Internal
// Correction of Dead-reckoning Errors With the Compliant Linkage Vehicle", 1995, Eqs. 9 to 16; equation numbers below
// are that paper's. For the CLAPPER, the OmniMate and, with a towed truck B, the Smart Encoder Trailer.
#pragma once

#include <vector>

#include "core/geometry/track.h"
#include "core/odometry/differential_drive.h"
#include "core/odometry/encoder_step.h"
#include "core/recording/vehicle_samples.h"
#include "core/vehicle/linked_trucks.h"
#include "core/vehicle/smart_encoder_trailer.h"

namespace odolab {

// The direction of the link from the trucks' positions, Eq. 10.
enum class LinkDirection {
  from_b_to_a,      // atan2(yA - yB, xA - xB), the direction that Eq. 16 needs
  atan_as_printed,  // atan((yB - yA) / (xB - xA)): the same within 90 degrees of x, the opposite beyond
};

// What is done about the distance that a wheel's encoder reports too much on a bump, Eqs. 14 and 15.
enum class CompositeCorrection {
  none,
  against_travel,  // the truck is moved back along its travel: an encoder reports too much, never too little
  as_printed,      // by -b sin(correction / 2) along the heading, whichever wheel it was and whichever way it drove
};

struct IpecOptions {
  HeadingRule heading = HeadingRule::middle;  // of Eq. 9; its letter is end_as_printed
  LinkDirection direction = LinkDirection::from_b_to_a;
  ResolutionRule resolution = ResolutionRule::least_correction;
  CompositeCorrection composite = CompositeCorrection::against_travel;
  // Share of a correction that is applied at once, 1 as printed: less where readings have noise of their own each time.
  double gain = 1.0;
};

// The two trucks and the steps of the encoders on the link; readings are those of LinkedSample without offsets.
struct IpecTrucks {
  DifferentialDrive a, b;
  double angle_step_a_rad = 0.0;  // 0: no rounding
  double angle_step_b_rad = 0.0;
};

// Both trucks, and by how much their headings were corrected in the last interval.
struct IpecState {
  double time_s = 0.0;
  Pose a, b;
  double correction_a_rad = 0.0;  // Eqs. 12, 13
  double correction_b_rad = 0.0;
};

// The state where truck A stands at a known pose: B's follows from the link.
IpecState ipec_start(const LinkedSample& reading, const Pose& truck_a);

// One sampling interval, Eqs. 9 to 16.
IpecState ipec_step(const IpecState& state, const LinkedSample& before, const LinkedSample& now,
                    const IpecTrucks& trucks, const IpecOptions& options = {});

// All states along a recording's samples, one for each; truck A starts at `start`.
std::vector<IpecState> ipec(const std::vector<LinkedSample>& samples, const LinkedTrucks& vehicle, const Pose& start,
                            const IpecOptions& options = {});

// With a trailer as truck B: it is rigid up to the hitch, so that its own link angle is zero and the length constant.
std::vector<IpecState> ipec(const std::vector<TrailerSample>& samples, const SmartEncoderTrailer& vehicle,
                            const Pose& start, const IpecOptions& options = {});

// Truck A's track.
Track track_of_truck_a(const std::vector<IpecState>& states);

}  // namespace odolab
