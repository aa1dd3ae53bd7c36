// What the encoders of the joints say against wheels and truth: whether one errs by where it stands or by which way it
// went last. A crooked spindle or a scale does the one, play the other; the catalogue has no name for either.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

// An encoder that errs alike wherever it reads alike, by far more than it rounds, and so in runs left out.
struct ErringJoint {
  std::size_t joint = 0;          // in the order of UnitSample::joints
  double size = 0.0, step = 0.0;  // of the error, root mean square; of the encoder
  double play = 0.0;              // of that, between one way and the other
  double left_out_ratio = 1.0;    // of the squares of what wheels and joints contradict each other, with it to without
  double gain = 0.0;              // half of what it takes off the normalised squares, in runs left out
  Response by_reading;            // the error over what the encoder reads
};

// `runs`: two or more, with an outside truth; `vehicle` with joints and wheels as calibrated. Of several joints that
// tell where the unit is the one that takes most off.
std::optional<ErringJoint> erring_joint(const std::vector<JoinedRun>& runs, const std::vector<double>& clock_s,
                                        const Vehicle& vehicle, std::size_t unit);

// As a finding without a name, first of all, and what it is by its reading among what the mismatch depends on.
void add_erring_joint(const ErringJoint& erring, const Vehicle& vehicle, Diagnosis& d);

}  // namespace odolab
