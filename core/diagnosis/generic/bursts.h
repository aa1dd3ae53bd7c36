// What happens at moments of its own, and is no noise: slip that comes and goes, gusts, counts that are lost in bursts,
// a stretch of floor that shakes.
#pragma once

#include <optional>

#include "core/diagnosis/generic/unnamed.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

inline constexpr int kFreedomOfAPush = 3;  // x, y, heading
// Of that chi-square.
inline constexpr double kMiddleOfAPush = 2.366, kNinetySevenOfAPush = 8.947;

// Where motion of a sudden kind, as by a push, is larger at the moments at which it is largest than noise makes it:
// noise that fits what is usual has a tail that falls off as it is known to. `explained`: twice the log-likelihood that
// names gain; bursts that say little beside it are what their forms leave. `error`: of what p-values must be below.
std::optional<Unnamed> what_comes_in_bursts(const JointModel& joint, double explained, double error);

// The largest statistics of moments that stand apart, as far as they exceed what three of a hundred do where there is
// nothing but noise; the largest first. `statistics` of three degrees of freedom, each with its recording and time, in
// this order.
struct Burst {
  int run = 0;
  double at_s = 0.0, excess = 0.0;
  double scatter = 1.0;  // by which its statistic was divided
};
std::vector<Burst> bursts_of(std::vector<Burst> statistics);

// How likely so large excesses are by chance, where noise has as heavy a tail as any that was seen.
double chance_of(const std::vector<Burst>& bursts);
// Their sum, beyond what so many come to by such noise.
double beyond_noise(const std::vector<Burst>& bursts);

// By how much the statistics of moments are divided where innovations are correlated (Eq. 7); 1 where they are white.
double doubt_of_moments(const JointModel& joint);

// Whether a push (x and y in m, heading in rad) displaces a rim by no more than rounded readings hide of it, where it
// begins and where it ends: wheels that set off have turned by most of a count before any is read.
bool hides_behind_counts(const std::vector<double>& push, const JointModel& joint);

}  // namespace odolab
