#include "core/diagnosis/naming/lag_and_delay.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/model/as_many_samples.h"
#include "core/diagnosis/naming/material.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

double likelier_by(const JointModel& a, const JointModel& than) {
  return likelier_by({a.minus_two_log_likelihood(), a.scalars()}, {than.minus_two_log_likelihood(), than.scalars()});
}

namespace {

bool is_of_lag(const AcceptedEffect& a) { return a.effect->lags_behind_commands(); }

AcceptedEffect& accepted_lag(JointModel& joint) {
  return *std::find_if(joint.accepted.begin(), joint.accepted.end(), is_of_lag);
}

JointModel with_lag_at(JointModel joint, double time_constant_s) {
  AcceptedEffect& lag = accepted_lag(joint);
  lag.shape[0] = lag.value[0] = time_constant_s;
  lag.is_held = true;
  joint.fit(3);
  return joint;
}

const Effect* lag_behind_commands() {
  const auto lag = std::find_if(catalogue().begin(), catalogue().end(), std::mem_fn(&Effect::lags_behind_commands));
  return lag == catalogue().end() ? nullptr : &*lag;
}

// In the place of so much of the clocks' delay. Moments that put a clock right know of no lag.
JointModel with_lag_for(JointModel joint, const Effect& lag, double delay_s) {
  AcceptedEffect a;
  a.effect = &lag;
  a.shape = a.value = {delay_s};
  joint.accepted.push_back(a);
  for (double& clock : joint.clock_s) clock -= delay_s;
  joint.clocks_are_held = false;
  return joint;
}

double mean_delay_s(const JointModel& joint) {
  return std::accumulate(joint.clock_s.begin(), joint.clock_s.end(), 0.0) / static_cast<double>(joint.clock_s.size());
}

bool is_likelier(const JointModel& a, const JointModel& b) { return likelier_by(a, b) > 0.0; }

// Under the noise as it is. Uphill by strides until the top lies between two of them, then to that of a parabola.
void put_where_likeliest(JointModel& joint, std::initializer_list<double> strides_of_size) {
  constexpr double kLeast_s = 1e-3;
  constexpr int kMostSteps = 24;
  JointModel best = with_lag_at(joint, std::max(accepted_lag(joint).value[0], kLeast_s));
  for (const double stride : strides_of_size) {
    std::optional<JointModel> more, less;  // one stride on and one back: one of them is where it came from
    for (int step = 0; step < kMostSteps; ++step) {
      const double here_s = accepted_lag(best).value[0];
      if (!more) more = with_lag_at(best, here_s * (1.0 + stride));
      if (!less) less = with_lag_at(best, here_s / (1.0 + stride));
      const double by_more = likelier_by(*more, best), by_less = likelier_by(*less, best);
      if (std::max(by_more, by_less) > 0.0) {
        std::optional<JointModel>&next = by_more > by_less ? more : less, &behind = by_more > by_less ? less : more;
        behind = std::exchange(best, std::move(*next));
        next.reset();
        continue;
      }
      if (by_more + by_less < 0.0) {
        const double strides = 0.5 * (by_less - by_more) / (by_more + by_less);
        JointModel top = with_lag_at(best, here_s * std::pow(1.0 + stride, strides));
        if (is_likelier(top, best)) best = std::move(top);
      }
      break;
    }
  }
  joint = std::move(best);
}

}  // namespace

void put_lag_where_likeliest(JointModel& joint) {
  constexpr double kEven_s = 0.01;
  constexpr double kFurther = 1.0;  // in twice the log-likelihood
  constexpr int kMostTimes = 4;
  put_where_likeliest(joint, {0.15, 0.04});
  // The noise took up what the lag was off by: each time it is less of both.
  for (int time = 0; time < kMostTimes; ++time) {
    joint.fit_noise_and_all();
    JointModel even = joint;
    even.model.noise.command_timing_s = std::min(kEven_s, joint.model.noise.command_timing_s);
    put_where_likeliest(even, {0.04, 0.01});
    even.fit_noise_and_all();
    if (likelier_by(even, joint) < kFurther) break;
    joint = std::move(even);
  }
}

void put_lag_anew(JointModel& joint) {
  const std::vector<AcceptedEffect>& all = joint.accepted;
  if (std::any_of(all.begin(), all.end(), is_of_lag) && !is_of_lag(all.back())) put_lag_where_likeliest(joint);
}

void let_lag_in(JointModel& joint) {
  constexpr double kShortest_s = 0.005;
  constexpr double kLikelier = 25.0;  // in twice the log-likelihood; a lag is one number more than a delay
  if (std::none_of(joint.views().begin(), joint.views().end(), std::mem_fn(&DriveView::from_commands))) return;
  const Effect* lag = lag_behind_commands();
  const double delay_s = mean_delay_s(joint);
  if (!lag || delay_s < kShortest_s) return;
  JointModel late = joint;
  late.clocks_are_held = false;
  late.fit(3);
  late.fit_noise_and_all();
  JointModel half = with_lag_at(with_lag_for(joint, *lag, 0.5 * delay_s), 0.5 * delay_s),
             whole = with_lag_at(with_lag_for(joint, *lag, delay_s), delay_s);
  JointModel best = std::move(is_likelier(half, whole) ? half : whole);
  put_lag_where_likeliest(best);
  best.fit_noise_and_all();
  if (likelier_by(best, late) > kLikelier) joint = std::move(best);
}

std::optional<Alternative> lag_instead(const JointModel& joint, double delay_s, double gain_of_delay) {
  constexpr double kClearlyLess = 20.0;  // in twice the log-likelihood: forms of both are nobody's
  const Effect* lag = lag_behind_commands();
  if (!lag) return std::nullopt;
  JointModel late = joint;
  late.fit(3);
  late.fit_noise_and_all();
  double likelier = -1e300;
  for (const double share : {0.5, 1.0}) {  // the rest is the clock's
    JointModel lagging = with_lag_at(with_lag_for(joint, *lag, share * delay_s), share * delay_s);
    lagging.fit_noise_and_all();
    likelier = std::max(likelier, likelier_by(lagging, late));
  }
  if (likelier < -kClearlyLess) return std::nullopt;
  return Alternative{lag->name, lag->component, gain_of_delay + 0.5 * likelier, lag->told_apart_by};
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
  // Not known to more than itself; nor better than it is known when the base acts on a change of its command.
  return 2.0 * by * by / std::max(bend, 2.0 * kStride * kStride) + std::pow(joint.model.noise.command_timing_s, 2);
}

}  // namespace odolab
