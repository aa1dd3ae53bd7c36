// Stamps that tell when a reading arrived, of readings that were taken at an even period.
//
// A reading late by l on a path that moves at w is off by w l. Where the stamps are those of the sampling, the path
// against the stamps is smooth and the path against the rows' numbers trembles by exactly w l; where they are those of
// the arrival it is the other way round. The share of w l that the path really shows, README.md Eq. 13, decides.
#pragma once

#include <optional>
#include <vector>

namespace odolab {

struct EvenStamps {
  std::vector<double> time_s;  // one for each stamp given, never decreasing; on the mean as late as those were
  double period_s = 0.0;
  double trembling_s = 0.0;  // root mean square of what was taken away
};

// The even stamps behind these, or nothing where the stamps are to be believed: where they are even already, where they
// are not of one period, where the paths cannot tell, and where they say that the readings were taken at those times.
// `paths`: what was read at each stamp; each must say the same unless it stands still. `together`: they are the
// coordinates of one path. `time_s` never decreases.
std::optional<EvenStamps> even_stamps(const std::vector<double>& time_s, const std::vector<std::vector<double>>& paths,
                                      bool together = false);

}  // namespace odolab
