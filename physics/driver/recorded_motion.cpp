#include "physics/driver/recorded_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/recording/aligned_rows.h"

namespace odolab {

namespace {

// Cubic Hermite interpolation over one interval of length h at u in [0, 1].
double hermite(double a, double slope_a, double b, double slope_b, double h, double u) {
  const double u2 = u * u, u3 = u2 * u;
  return (2.0 * u3 - 3.0 * u2 + 1.0) * a + (u3 - 2.0 * u2 + u) * h * slope_a + (3.0 * u2 - 2.0 * u3) * b +
         (u3 - u2) * h * slope_b;
}

// The left and right wheel of a recording, where a vehicle is driven by such a pair.
struct PairOfWheels {
  using Drive = std::optional<DifferentialDrive>;
  Drive operator()(const DifferentialDrive& v) const { return v; }
  Drive operator()(const Tracked& v) const { return as_differential_drive(v); }
  Drive operator()(const EncoderTrailer& v) const { return v.tow; }
  Drive operator()(const SmartEncoderTrailer& v) const { return v.tow; }
  Drive operator()(const SynchroDrive&) const { return {}; }
  Drive operator()(const LinkedTrucks&) const { return {}; }
  Drive operator()(const MultiCastor&) const { return {}; }
};

// The finest step of a wheel: a count, or what the readings were rounded to where that is more.
double resolution_rad(const std::vector<WheelSample>& wheels, double count_rad) {
  double least_rad = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < wheels.size(); ++i)
    for (const double step_rad :
         {wheels[i].left_rad - wheels[i - 1].left_rad, wheels[i].right_rad - wheels[i - 1].right_rad})
      if (step_rad != 0.0) least_rad = std::min(least_rad, std::abs(step_rad));
  return std::isinf(least_rad) ? count_rad : std::max(count_rad, least_rad);
}

// Each wheel's mean over a time about each sample, shorter near the ends.
void smooth(const std::vector<double>& time_s, double over_s, std::vector<std::vector<double>>& rows) {
  const std::size_t wheels = rows.front().size();
  std::vector<std::vector<double>> sum = {std::vector<double>(wheels, 0.0)};  // integral up to each sample
  for (std::size_t i = 1; i < rows.size(); ++i) {
    sum.push_back(sum.back());
    for (std::size_t w = 0; w < wheels; ++w)
      sum.back()[w] += 0.5 * (rows[i - 1][w] + rows[i][w]) * (time_s[i] - time_s[i - 1]);
  }
  const auto sum_until = [&](double t, std::size_t w) {
    const auto after = std::upper_bound(time_s.begin() + 1, time_s.end() - 1, t);
    const std::size_t i = static_cast<std::size_t>(after - time_s.begin()) - 1;
    const double dt = t - time_s[i], span = time_s[i + 1] - time_s[i];
    return sum[i][w] + dt * (rows[i][w] + 0.5 * (dt / span) * (rows[i + 1][w] - rows[i][w]));
  };
  std::vector<std::vector<double>> smoothed = rows;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    const double half_s = std::min({0.5 * over_s, time_s[i] - time_s.front(), time_s.back() - time_s[i]});
    for (std::size_t w = 0; w < wheels; ++w)
      smoothed[i][w] = (sum_until(time_s[i] + half_s, w) - sum_until(time_s[i] - half_s, w)) / (2.0 * half_s);
  }
  rows = std::move(smoothed);
}

}  // namespace

RecordedRotation::RecordedRotation(const std::vector<double>& time_s,
                                   const std::vector<std::vector<double>>& rows_rad) {
  for (std::size_t i = 0; i < time_s.size();
       ++i)  // two rows at one time cannot be passed through: the later one counts
    if (!time_s_.empty() && time_s[i] <= time_s_.back()) {
      rows_rad_.back() = rows_rad[i];
    } else {
      time_s_.push_back(time_s[i]);
      rows_rad_.push_back(rows_rad[i]);
    }
  const std::size_t n = time_s_.size();
  for (const std::vector<double>& row : rows_rad_) speeds_radps_.emplace_back(row.size(), 0.0);
  if (n < 2) return;
  const auto mean_speed = [&](std::size_t from, std::size_t to, std::size_t wheel) {
    return (rows_rad_[to][wheel] - rows_rad_[from][wheel]) / (time_s_[to] - time_s_[from]);
  };
  // The ends take the speed of their interval: a recording may begin and end in motion.
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t wheel = 0; wheel < rows_rad_[i].size(); ++wheel)
      speeds_radps_[i][wheel] = mean_speed(i == 0 ? 0 : i - 1, i + 1 == n ? i : i + 1, wheel);
}

std::vector<double> RecordedRotation::at(double time_s) {
  if (time_s <= time_s_.front()) return rows_rad_.front();
  if (time_s >= time_s_.back()) return rows_rad_.back();
  while (time_s_[segment_ + 1] < time_s) ++segment_;
  const double h = time_s_[segment_ + 1] - time_s_[segment_], u = (time_s - time_s_[segment_]) / h;
  const std::vector<double>&a = rows_rad_[segment_], &b = rows_rad_[segment_ + 1];
  const std::vector<double>&va = speeds_radps_[segment_], &vb = speeds_radps_[segment_ + 1];
  std::vector<double> rotation(a.size());
  for (std::size_t wheel = 0; wheel < a.size(); ++wheel)
    rotation[wheel] = hermite(a[wheel], va[wheel], b[wheel], vb[wheel], h, u);
  return rotation;
}

std::vector<double> RecordedRotation::speed_at(double time_s) {
  constexpr double kInstant_s = 1e-4;
  const std::vector<double> now = at(time_s);
  std::vector<double> speed = at(time_s + kInstant_s);
  for (std::size_t wheel = 0; wheel < speed.size(); ++wheel) speed[wheel] = (speed[wheel] - now[wheel]) / kInstant_s;
  return speed;
}

RecordedRotation recorded_rotation(const Recording& recording, const VehicleKind& kind,
                                   const std::vector<std::string>& channels) {
  if (const std::optional<DifferentialDrive> drive = std::visit(PairOfWheels{}, kind)) {
    std::vector<double> time_s;
    std::vector<std::vector<double>> rows_rad;
    const std::vector<WheelSample> wheels = wheel_samples(recording, *drive);
    for (const WheelSample& sample : wheels) {
      if (!time_s.empty() && sample.time_s <= time_s.back()) time_s.pop_back(), rows_rad.pop_back();
      time_s.push_back(sample.time_s);
      rows_rad.push_back({sample.left_rad, sample.right_rad});
    }
    // A counter goes in jumps that its wheel did not make. One from a reading to the next would be a tenth of what
    // tyres hold; they are spread over twice the time after which it is no more than that.
    constexpr double kJerk_mps2 = 0.75;
    const double count_m =
        drive->wheel_radius_left_m * resolution_rad(wheels, 2.0 * kPi / drive->counts_per_wheel_turn());
    const double over_s = std::sqrt(count_m / kJerk_mps2);
    if (time_s.size() > 2 && over_s * static_cast<double>(time_s.size() - 1) > time_s.back() - time_s.front())
      smooth(time_s, 2.0 * over_s, rows_rad);
    return {time_s, rows_rad};
  }
  std::vector<AlignedChannel> wheels;
  for (const std::string& channel : channels) wheels.push_back({channel, false});
  const AlignedRows rows = aligned_rows(recording, wheels);
  return {rows.time_s, rows.values};
}

CommandSample RecordedCommands::at(double time_s) {
  while (next_ < samples_.size() && samples_[next_].time_s <= time_s) ++next_;
  if (next_ == 0 || time_s > samples_.back().time_s) return {time_s, 0.0, 0.0};
  return samples_[next_ - 1];
}

}  // namespace odolab
