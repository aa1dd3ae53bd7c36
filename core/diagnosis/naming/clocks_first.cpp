#include "core/diagnosis/naming/clocks_first.h"

#include <numeric>
#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "core/calibration/aligned_clock.h"
#include "core/diagnosis/naming/material.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

namespace {

constexpr double kFreeEnough = 20.0;  // of twice the log-likelihood that slopes may lose

// Of a recording: how late its truth is at its first sample and at its last.
struct Lags {
  double first_s = 0.0, last_s = 0.0;
};

double truth_duration_s(const JointModel& joint, int run) {
  const std::vector<TruthSample>& truth = joint.runs()[static_cast<std::size_t>(run)].truth;
  return truth.back().time_s - truth.front().time_s;
}

double likelihood_at(JointModel& joint, int run, const Lags& lags) {
  joint.clock_s[static_cast<std::size_t>(run)] = lags.first_s;
  if (double* rate = joint.clock_rate_of(run)) *rate = (lags.first_s - lags.last_s) / truth_duration_s(joint, run);
  return -joint.minus_two_log_likelihood_of(run);
}

// Pattern search: both ends together, then one against the other.
Lags likeliest_lags(JointModel& joint, int run, Lags at) {
  constexpr double kFirst_s = 0.01, kLast_s = 0.0001;
  const bool with_rate = joint.clock_rate_of(run) != nullptr;
  double best = likelihood_at(joint, run, at);
  const auto better = [&](double first_s, double last_s) {
    const Lags there{at.first_s + first_s, at.last_s + last_s};
    const double likelihood = likelihood_at(joint, run, there);
    if (!(likelihood > best)) return false;
    best = likelihood;
    at = there;
    return true;
  };
  for (double step_s = kFirst_s; step_s > kLast_s; step_s *= 0.5)
    for (bool moved = true; moved;) {
      moved = better(step_s, step_s) || better(-step_s, -step_s);
      if (with_rate)
        moved = better(step_s, 0.0) || better(-step_s, 0.0) || better(0.0, step_s) || better(0.0, -step_s) || moved;
    }
  return at;
}

std::vector<std::optional<AlignedClock>> by_moments(const JointModel& joint) {
  return aligned_clocks(joint.runs(), [&](int run) { return joint.model_of(run); });
}

// From where the moments say or from where they are, whichever is likelier.
void align(JointModel& joint, const std::vector<std::optional<AlignedClock>>& moments) {
  std::vector<Lags> found(joint.runs().size());
  parallel_for(static_cast<int>(found.size()), [&](int run) {
    const auto r = static_cast<std::size_t>(run);
    JointModel own = joint;
    const double whole_s = truth_duration_s(own, run);
    const double* rate = own.clock_rate_of(run);
    Lags start{own.clock_s[r], own.clock_s[r] - (rate ? *rate * whole_s : 0.0)};
    if (moments[r]) {
      const Lags there{moments[r]->offset_s, moments[r]->offset_s - (rate ? moments[r]->rate * whole_s : 0.0)};
      if (likelihood_at(own, run, there) > likelihood_at(own, run, start)) start = there;
    }
    found[r] = likeliest_lags(own, run, start);
  });
  for (std::size_t r = 0; r < found.size(); ++r) likelihood_at(joint, static_cast<int>(r), found[r]);
}

// Noise that was fitted to clocks a second apart comes down in steps.
void fit_noise_to_the_end(JointModel& joint) {
  constexpr int kMostSteps = 6;
  double was = joint.minus_two_log_likelihood();
  for (int step = 0; step < kMostSteps; ++step) {
    joint.fit_noise_and_all();
    const double now = joint.minus_two_log_likelihood();
    if (!(now < was - kFreeEnough)) return;
    was = now;
  }
}

// With those rates let in, and clocks held where they are likeliest.
JointModel held(JointModel joint, const Effect* rates, const std::vector<double>& value,
                const std::vector<std::optional<AlignedClock>>& moments) {
  if (rates) joint.accepted.push_back({rates, {}, value});
  align(joint, moments);
  joint.clocks_are_held = true;
  joint.fit(2);
  fit_noise_to_the_end(joint);
  return joint;
}

bool is_decisively_likelier(const JointModel& a, const JointModel& b) {
  return a.minus_two_log_likelihood() < b.minus_two_log_likelihood() - kDecisive;
}

}  // namespace

void align_clocks(JointModel& joint) { align(joint, by_moments(joint)); }

void let_clocks_in(JointModel& joint) {
  const std::vector<std::optional<AlignedClock>> moments = by_moments(joint);
  if (!worth_a_try(moments)) return;

  // From the freest: the simplest that is not beaten by one freer.
  const std::size_t n = joint.runs().size();
  const Effect* shared = catalogue_entry({"clock_rate", "vehicle", {}});
  std::vector<double> own(n, 0.0);
  for (std::size_t r = 0; r < n; ++r)
    if (moments[r]) own[r] = moments[r]->rate;
  const Effect* each = n == 1 ? shared : &effects::clock_rate_of_each_run(static_cast<int>(n)).front();
  JointModel best = held(joint, each, own, moments);
  if (!is_decisively_likelier(best, joint) || !is_material(joint, joint.gathered_error(), best.gathered_error()))
    return;
  const auto simplify = [&](const Effect* rates, const std::vector<double>& value) {
    JointModel simpler = held(joint, rates, value, moments);
    if (is_decisively_likelier(best, simpler)) return false;
    best = std::move(simpler);
    return true;
  };
  bool simpler = true;
  if (n > 1) {
    own = best.accepted.back().value;
    simpler = simplify(shared, {std::accumulate(own.begin(), own.end(), 0.0) / static_cast<double>(n)});
  }
  if (simpler) simplify(nullptr, {});

  // Where the slopes say the same, clocks may move on with all else.
  JointModel free = best;
  free.clocks_are_held = false;
  free.fit(3);
  fit_noise_to_the_end(free);
  joint = free.minus_two_log_likelihood() < best.minus_two_log_likelihood() + kFreeEnough ? free : best;
}

}  // namespace odolab
