#include "physics/driver/recorded_motion.h"

namespace odolab {

namespace {

// Cubic Hermite interpolation over one interval of length h at u in [0, 1].
double hermite(double a, double slope_a, double b, double slope_b, double h, double u) {
  const double u2 = u * u, u3 = u2 * u;
  return (2.0 * u3 - 3.0 * u2 + 1.0) * a + (u3 - 2.0 * u2 + u) * h * slope_a + (3.0 * u2 - 2.0 * u3) * b +
         (u3 - u2) * h * slope_b;
}

}  // namespace

RecordedRotation::RecordedRotation(std::vector<WheelSample> samples) {
  for (const WheelSample& s : samples)  // two rows at one time cannot be passed through: the later one counts
    if (!samples_.empty() && s.time_s <= samples_.back().time_s)
      samples_.back() = {samples_.back().time_s, s.left_rad, s.right_rad};
    else
      samples_.push_back(s);
  speeds_radps_.assign(samples_.size(), WheelPair{});
  // The ends take the speed of their interval: a recording may begin and end in motion.
  if (samples_.size() > 1) {
    const auto mean_speed = [&](std::size_t i) {
      const double span_s = samples_[i + 1].time_s - samples_[i].time_s;
      return WheelPair{(samples_[i + 1].left_rad - samples_[i].left_rad) / span_s,
                       (samples_[i + 1].right_rad - samples_[i].right_rad) / span_s};
    };
    speeds_radps_.front() = mean_speed(0);
    speeds_radps_.back() = mean_speed(samples_.size() - 2);
  }
  for (std::size_t i = 1; i + 1 < samples_.size(); ++i) {
    const double span_s = samples_[i + 1].time_s - samples_[i - 1].time_s;
    speeds_radps_[i] = {(samples_[i + 1].left_rad - samples_[i - 1].left_rad) / span_s,
                        (samples_[i + 1].right_rad - samples_[i - 1].right_rad) / span_s};
  }
}

WheelPair RecordedRotation::at(double time_s) {
  if (time_s <= samples_.front().time_s) return {samples_.front().left_rad, samples_.front().right_rad};
  if (time_s >= samples_.back().time_s) return {samples_.back().left_rad, samples_.back().right_rad};
  while (samples_[segment_ + 1].time_s < time_s) ++segment_;
  const WheelSample &a = samples_[segment_], &b = samples_[segment_ + 1];
  const WheelPair va = speeds_radps_[segment_], vb = speeds_radps_[segment_ + 1];
  const double h = b.time_s - a.time_s, u = (time_s - a.time_s) / h;
  return {hermite(a.left_rad, va.left, b.left_rad, vb.left, h, u),
          hermite(a.right_rad, va.right, b.right_rad, vb.right, h, u)};
}

WheelPair RecordedRotation::speed_at(double time_s) {
  constexpr double kInstant_s = 1e-4;
  const WheelPair now = at(time_s), soon = at(time_s + kInstant_s);
  return {(soon.left - now.left) / kInstant_s, (soon.right - now.right) / kInstant_s};
}

CommandSample RecordedCommands::at(double time_s) {
  while (next_ < samples_.size() && samples_[next_].time_s <= time_s) ++next_;
  if (next_ == 0 || time_s > samples_.back().time_s) return {time_s, 0.0, 0.0};
  return samples_[next_ - 1];
}

}  // namespace odolab
