// A truth that the wheels carry on between its corrections: the pose of a map's localisation, or of a filter, is
// odometry that is put right now and then.
#pragma once

#include <optional>
#include <string>

#include "core/recording/recording.h"

namespace odolab {

struct MeasuredRecording {
  Recording recording;
  std::string said;  // what was done, for whoever reads the report
};

// Without the samples that say nothing but what odometry added to the one before. From one to the next of these the
// vehicle goes along a circle, sideways by what its heading half way says and no more, as nothing does that is
// measured: in the most part of the samples to a hundredth of what it is otherwise, which comes from one sample to the
// next and is over. Nothing where that is not so, and of a truth without headings, of which it cannot be told.
std::optional<MeasuredRecording> without_carried_truth(const Recording& recording);

// A warning, where no step at all goes sideways otherwise than so: the truth is computed and not measured, by odometry
// or by a simulator without noise. Nothing where its numbers are too coarse to tell.
std::optional<std::string> warning_of_computed_truth(const Recording& recording);

}  // namespace odolab
