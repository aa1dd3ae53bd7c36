#include "core/diagnosis/naming/lag_and_delay.h"

#include <algorithm>

namespace odolab {

namespace {

JointModel with_lag_at(JointModel joint, double time_constant_s) {
  AcceptedEffect& lag = joint.accepted.back();
  lag.shape[0] = lag.value[0] = time_constant_s;
  lag.is_held = true;
  joint.fit(3);
  return joint;
}

bool is_likelier(const JointModel& a, const JointModel& b) {
  return a.minus_two_log_likelihood() < b.minus_two_log_likelihood();
}

}  // namespace

void put_lag_where_likeliest(JointModel& joint) {
  constexpr double kFirstStride = 0.15, kLastStride = 0.005;  // of the size
  constexpr double kLeast_s = 1e-3;
  constexpr int kMostSteps = 24;
  JointModel best = with_lag_at(joint, std::max(joint.accepted.back().value[0], kLeast_s));
  for (double stride = kFirstStride; stride > kLastStride; stride *= 0.5)
    for (int step = 0; step < kMostSteps; ++step) {
      const double here_s = best.accepted.back().value[0];
      JointModel more = with_lag_at(best, here_s * (1.0 + stride)), less = with_lag_at(best, here_s / (1.0 + stride));
      JointModel& better = is_likelier(more, less) ? more : less;
      if (!is_likelier(better, best)) break;
      best = std::move(better);
    }
  joint = std::move(best);
}

}  // namespace odolab
