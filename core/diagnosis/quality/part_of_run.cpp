#include "core/diagnosis/quality/part_of_run.h"

namespace odolab {

InnovationRun part_of_run(const InnovationRun& run, double from_s, double to_s, double offset_s) {
  constexpr double kAround_s = 1.5, kMore_s = 0.3;
  InnovationRun part;
  part.truth_has_heading = run.truth_has_heading;
  part.counts_show = run.counts_show;
  for (const WheelSample& w : run.wheels)
    if (w.time_s >= from_s - kAround_s - kMore_s && w.time_s <= to_s + kAround_s + kMore_s) part.wheels.push_back(w);
  for (std::size_t k = 0; k < run.truth.size(); ++k) {
    const double time_s = run.truth[k].time_s - offset_s;
    if (time_s < from_s - kAround_s || time_s > to_s + kAround_s) continue;
    part.truth.push_back(run.truth[k]);
    part.set_aside.push_back(0);
    part.cut.push_back(is_cut(run, k));
  }
  return part;
}

double misfit_of(const InnovationRun& part, const InnovationModel& calibrated) {
  if (part.truth.size() < 2) return 0.0;
  FilterOptions options;
  options.derivatives = false;
  const InnovationSums sums = filtered(part, summed_up(part, calibrated), calibrated, options);
  return sums.chi2 + sums.log_determinant;
}

std::optional<ShownShare> shown_share(const std::function<double(double share)>& misfit) {
  const double none = misfit(0.0), half = misfit(0.5), all = misfit(1.0), bend = 2.0 * (none - 2.0 * half + all),
               slope = all - none - bend;
  if (bend <= 0.0) return std::nullopt;
  return ShownShare{-0.5 * slope / bend, 0.25 * slope * slope / bend, none - all};
}

}  // namespace odolab
