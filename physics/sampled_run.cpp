#include "physics/sampled_run.h"

#include <algorithm>
#include <limits>

namespace odolab {

Recording recording_of(const SampledRun& run, const Sensors& sensors, const std::string& name) {
  Recording recording;
  recording.name = name;
  recording.provenance = "simulated: " + name;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t channels = run.channels.size(), samples = run.time_s.size();
  std::vector<Channel> sensed;
  for (const std::string& channel : run.channels) sensed.push_back({channel, {}});
  std::vector<double> speed, rate, x, y, heading;
  for (std::size_t w = 0, t = 0; w < samples || t < run.truth.size();) {
    const double robot_s = w < samples ? run.time_s[w] : kNever;
    const double truth_s = t < run.truth.size() ? run.truth[t].time_s : kNever;
    const bool robot = robot_s <= truth_s, truth = truth_s <= robot_s;
    const bool command = robot && w < run.commands.size();
    recording.time_s.push_back(std::min(robot_s, truth_s));
    for (std::size_t i = 0; i < channels; ++i)
      sensed[i].values.push_back(robot ? run.readings[w * channels + i] : none);
    // A minus zero, adding zero, loses its sign.
    speed.push_back(command ? run.commands[w].speed_mps + 0.0 : none);
    rate.push_back(command ? run.commands[w].yaw_rate_radps + 0.0 : none);
    x.push_back(truth ? run.truth[t].pose.x_m : none);
    y.push_back(truth ? run.truth[t].pose.y_m : none);
    heading.push_back(truth ? run.truth[t].pose.heading_rad : none);
    w += robot;
    t += truth;
  }
  if (sensors.record_encoders) recording.channels = std::move(sensed);
  if (sensors.record_commands) {
    recording.channels.push_back({"command_speed_mps", speed});
    recording.channels.push_back({"command_yaw_rate_radps", rate});
  }
  recording.channels.push_back({"truth_x_m", x});
  recording.channels.push_back({"truth_y_m", y});
  if (sensors.truth_heading) recording.channels.push_back({"truth_heading_rad", heading});
  return recording;
}

}  // namespace odolab
