#include "core/calibration/restamped.h"

namespace odolab {

namespace {

// Of all stamps of the wheels' clock.
template <typename Change>
void restamp(InnovationRun& run, Change&& change) {
  for (std::vector<WheelSample>* wheels : {&run.wheels, &run.smooth})
    for (WheelSample& w : *wheels) w.time_s = change(w.time_s);
  for (auto& [from_s, to_s] : run.left_out) from_s = change(from_s), to_s = change(to_s);
}

}  // namespace

void put_clock_right(InnovationRun& run, double rate, double offset_s) {
  const double t0 = run.truth.front().time_s - offset_s;
  restamp(run, [&](double time_s) { return t0 + (time_s - t0) / (1.0 + rate); });
}

double TwoClocks::wheels_stamp_s(double truth_stamp_s) const {
  return truth_stamp_s - offset_s + (truth_stamp_s - first_sample_s) * rate;
}

double TwoClocks::truth_stamp_s(double wheels_stamp_s) const {
  const double by_right_clock_s = wheels_stamp_s + offset_s;
  return by_right_clock_s - (by_right_clock_s - first_sample_s) * rate / (1.0 + rate);
}

void put_later(InnovationRun& run, double delay_s) {
  restamp(run, [&](double time_s) { return time_s + delay_s; });
}

}  // namespace odolab
