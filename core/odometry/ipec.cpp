#include "core/odometry/ipec.h"

#include <cmath>

namespace odolab {

namespace {

// The link's direction from the trucks' positions.
double link_heading(const Pose& a, const Pose& b, LinkDirection rule) {
  if (rule == LinkDirection::from_b_to_a) return std::atan2(a.y_m - b.y_m, a.x_m - b.x_m);
  return std::atan((b.y_m - a.y_m) / (b.x_m - a.x_m));
}

// Truck B where the link puts it, Eq. 16.
Pose behind(const Pose& a, double link_heading_rad, double link_length_m, double heading_b_rad) {
  return {a.x_m - link_length_m * std::cos(link_heading_rad), a.y_m - link_length_m * std::sin(link_heading_rad),
          heading_b_rad};
}

// Truck A turned back about the wheel that did not climb anything, Eqs. 14, 15.
Pose composite_corrected(const Pose& a, double correction_rad, double travel_m, double wheelbase_m,
                         CompositeCorrection rule) {
  double back_m = wheelbase_m * std::sin(0.5 * correction_rad);  // Eq. 14
  if (rule == CompositeCorrection::none) return a;
  if (rule == CompositeCorrection::against_travel) back_m = std::copysign(back_m, travel_m);
  return {a.x_m - back_m * std::cos(a.heading_rad), a.y_m - back_m * std::sin(a.heading_rad), a.heading_rad};
}

LinkedSample without_offsets(LinkedSample sample, const LinkedTrucks& vehicle) {
  sample.link_angle_a_rad -= vehicle.link_angle_a_offset_rad;
  sample.link_angle_b_rad -= vehicle.link_angle_b_offset_rad;
  sample.link_length_m -= vehicle.link_length_offset_m;
  return sample;
}

std::vector<IpecState> ipec_along(const std::vector<LinkedSample>& readings, const IpecTrucks& trucks,
                                  const Pose& start, const IpecOptions& options) {
  std::vector<IpecState> states;
  states.reserve(readings.size());
  for (std::size_t i = 0; i < readings.size(); ++i)
    states.push_back(i == 0 ? ipec_start(readings[0], start)
                            : ipec_step(states.back(), readings[i - 1], readings[i], trucks, options));
  return states;
}

}  // namespace

IpecState ipec_start(const LinkedSample& reading, const Pose& truck_a) {
  const double theta_l = truck_a.heading_rad - reading.link_angle_a_rad;
  return {reading.time_s, truck_a, behind(truck_a, theta_l, reading.link_length_m, theta_l + reading.link_angle_b_rad)};
}

IpecState ipec_step(const IpecState& state, const LinkedSample& before, const LinkedSample& now,
                    const IpecTrucks& trucks, const IpecOptions& options) {
  Pose a = dead_reckoned(state.a, before.a, now.a, trucks.a, options.heading);  // Eq. 9
  Pose b = dead_reckoned(state.b, before.b, now.b, trucks.b, options.heading);
  const double theta_l = link_heading(a, b, options.direction);                // Eq. 10
  const double expected_alpha = a.heading_rad - theta_l;                       // Eq. 11a
  const double expected_beta = b.heading_rad - theta_l;                        // Eq. 11b
  const double difference_a = wrapped(now.link_angle_a_rad - expected_alpha);  // Eq. 12a
  const double difference_b = wrapped(now.link_angle_b_rad - expected_beta);   // Eq. 12b
  const double correction_a = options.gain * correction_rad(difference_a, trucks.angle_step_a_rad, options.resolution);
  const double correction_b = options.gain * correction_rad(difference_b, trucks.angle_step_b_rad, options.resolution);
  a.heading_rad += correction_a;  // Eq. 13a
  b.heading_rad += correction_b;  // Eq. 13b
  const double travel_m = trucks.a.wheel_radius_left_m * (now.a.left_rad - before.a.left_rad) +
                          trucks.a.wheel_radius_right_m * (now.a.right_rad - before.a.right_rad);
  a = composite_corrected(a, correction_a, travel_m, trucks.a.wheelbase_m, options.composite);
  b = behind(a, theta_l, now.link_length_m, b.heading_rad);  // Eq. 16
  return {now.time_s, a, b, correction_a, correction_b};
}

std::vector<IpecState> ipec(const std::vector<LinkedSample>& samples, const LinkedTrucks& vehicle, const Pose& start,
                            const IpecOptions& options) {
  std::vector<LinkedSample> readings;
  readings.reserve(samples.size());
  for (const LinkedSample& sample : samples) readings.push_back(without_offsets(sample, vehicle));
  const double step_rad = vehicle.link_angle_resolution_rad;
  return ipec_along(readings, {vehicle.truck_a, vehicle.truck_b, step_rad, step_rad}, start, options);
}

std::vector<IpecState> ipec(const std::vector<TrailerSample>& samples, const SmartEncoderTrailer& vehicle,
                            const Pose& start, const IpecOptions& options) {
  std::vector<LinkedSample> readings;
  readings.reserve(samples.size());
  for (const TrailerSample& s : samples)
    readings.push_back({s.time_s, s.tow, s.trailer, s.hitch_angle_rad - vehicle.hitch_angle_offset_rad, 0.0,
                        vehicle.drawbar_length_m});
  return ipec_along(readings, {vehicle.tow, vehicle.trailer, vehicle.hitch_angle_resolution_rad, 0.0}, start, options);
}

Track track_of_truck_a(const std::vector<IpecState>& states) {
  Track track;
  track.reserve(states.size());
  for (const IpecState& state : states) track.push_back({state.time_s, state.a});
  return track;
}

}  // namespace odolab
