// What readings feign: the same drives once more, their wheels read with other errors.
#pragma once

#include <optional>
#include <vector>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// What an effect does is reckoned from readings that err themselves, and what they err by is in the residual as well
// (errors in variables: Fuller, Measurement Error Models, 1987, section 1.1). How much of a score that makes is seen
// where nothing else is: in drives whose wheels turn as the smoothed readings say, under a truth that goes where these
// wheels do, without an error. A parametric bootstrap (Efron, Tibshirani, An Introduction to the Bootstrap, 1993,
// section 6.5). Their wheels are read
// - `counted` anew, where counts are coarse: from other places within a count on, where they rest anywhere within it;
//   all that is left is the rounding, with all that follows it: a speed that is nearly a whole number of counts from
//   reading to reading, derivatives of rounded readings, wheels that keep a remainder while they rest;
// - `rolled` anew: each wheel turns further, or less far, than it travels, by as much as the model's noise says, be it
//   the floor or the reading. The model has this noise in the truth, where it meets no derivative. Not of a base that
//   is driven by its commands, which do not err.
// And once more under a truth that is `turned` slowly about where it is right, by a quarter of what the heading of one
// sample errs by: no tracker's errors are all white, and a slow turn by a milliradian that no likelihood shows is a
// crawl to the side, or a mounting that is another one in each recording.
class DrivenAgain {
 public:
  DrivenAgain(const JointModel& joint, bool counts_may_feign);

  bool is_counted() const { return counts_may_feign_; }

  // Drives, where nobody has asked yet: by whoever is about to ask from several threads.
  void drive() const;

  // By how much a candidate's score scatters more than the model says where such readings are the whole of the error:
  // the mean of its statistic for each number, beyond the one that the model reckons with. Of counts at the upper end
  // of what that many drives leave open (19 of 20); of noise where it is more than chance makes one time in a thousand.
  // `noise`: the model's now, since what is missing in a model looks like noise to it, and what that feigns goes by its
  // square.
  Feigned feigned(const Effect& effect, const std::vector<double>& shape, const FittedNoise& noise,
                  const AskedHow& how = {}) const;

 private:
  struct Drives {
    std::vector<JointModel> counted, rolled, turned;
  };
  JointModel calibrated_;
  bool counts_may_feign_;
  mutable std::optional<Drives> drives_;  // made when the first asks, since they are large
};

// Widens the test of an entry of the catalogue by what readings feign of it: of what acts all along; what happens once,
// or in one place, is held against whole counts as it is found.
void widen_by_readings(CandidateTest& test, const JointModel& joint, const Effect& entry,
                       const std::vector<double>& shape);

}  // namespace odolab
