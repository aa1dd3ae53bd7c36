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

// Under the noise as it is.
void put_where_likeliest(JointModel& joint) {
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

}  // namespace

void put_lag_where_likeliest(JointModel& joint) {
  constexpr double kEven_s = 0.01;
  if (joint.model.noise.command_timing_s < kEven_s) return put_where_likeliest(joint);
  JointModel even = joint;
  even.model.noise.command_timing_s = kEven_s;
  for (JointModel* each : {&joint, &even}) {
    put_where_likeliest(*each);
    each->fit_noise_and_all();
  }
  if (is_likelier(even, joint)) joint = std::move(even);
}

double variance_of_held(const JointModel& joint, std::size_t accepted) {
  constexpr double kStride = 0.05;  // of the size
  const double here = joint.accepted[accepted].value[0], by = kStride * here;
  const auto misfit_at = [&](double size) {
    JointModel there = joint;
    there.accepted[accepted].shape[0] = there.accepted[accepted].value[0] = size;
    there.fit(3);
    return there.minus_two_log_likelihood();
  };
  const double bend = misfit_at(here + by) - 2.0 * misfit_at(here) + misfit_at(here - by);
  return 2.0 * by * by / std::max(bend, 2.0 * kStride * kStride);  // not known to more than itself
}

}  // namespace odolab
