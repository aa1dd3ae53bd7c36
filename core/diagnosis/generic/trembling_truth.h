// Where a truth trembles more than elsewhere, as a camera does about what is far from it.
#pragma once

#include <vector>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// How much worse a truth is about a moment its third differences tell, in which no motion shows, and no push but for a
// moment.
class TremblingTruth {
 public:
  static constexpr double kAbout_s = 5.0;  // to either side of a moment

  explicit TremblingTruth(const JointModel& joint);
  // The variance about a moment of a run, in times the mean of all; 1 where nothing trembles.
  double worse(int run, double time_s) const;

 private:
  struct Third {
    double time_s;
    Vec2 value;
  };
  double about(std::size_t run, double time_s) const;

  std::vector<std::vector<Third>> thirds_;  // of each run
  double usual_ = 0.0;
};

}  // namespace odolab
