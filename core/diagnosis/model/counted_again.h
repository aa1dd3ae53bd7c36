// What whole counts feign: the same drives once more, their wheels counted with other remainders.
#pragma once

#include <vector>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// Wheels that turn as the smoothed readings say, and stand anywhere within a count where they rest, counted anew from
// other places on, time and again; and a truth that goes where these wheels do, without an error. All that is left
// there is the rounding of the counts, with all that follows it: a speed that is nearly a whole number of counts from
// reading to reading, derivatives of rounded readings (errors in variables: Fuller, Measurement Error Models, 1987,
// section 1.1), wheels that keep a remainder while they rest. A parametric bootstrap (Efron, Tibshirani, An
// Introduction to the Bootstrap, 1993, section 6.5).
class CountedAgain {
 public:
  explicit CountedAgain(const JointModel& joint);

  // By how much a candidate's score scatters more than the model says where rounding is the whole of the error: the
  // mean of its statistic for each number, at the upper end of what that many drives leave open (19 of 20), beyond the
  // one that the model reckons with.
  Feigned feigned(const Effect& effect, const std::vector<double>& shape, const AskedHow& how = {}) const;

 private:
  std::vector<JointModel> again_;
};

// Widens the test of an entry of the catalogue by what counts feign of it, where they are coarse: of what acts on the
// motion or on the clocks all along; what happens once, or in one place, is held against whole counts as it is found.
void widen_by_counts(CandidateTest& test, const JointModel& joint, const Effect& entry,
                     const std::vector<double>& shape);

}  // namespace odolab
