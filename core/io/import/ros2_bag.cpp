// ROS 2 bags: rotation of the drive wheels from joint states, commands from twists, truth from poses or transforms.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/io/import/bag_choice.h"
#include "core/io/import/format.h"
#include "core/io/import/truth_stream.h"
#include "core/io/number_text.h"

namespace odolab {

namespace {

// Between the clock of the stamps in the messages and that of the log, beyond which the two are not the same clock.
constexpr std::int64_t kOtherClock_ns = 1'000'000'000;

bool recognises_bag(const std::string& path, std::string_view) { return is_bag(path); }

// How the messages of a topic came by their stamps.
struct Stamps {
  std::uint64_t by_header = 0, by_log = 0;
  std::int64_t log_after_header_ns = std::numeric_limits<std::int64_t>::max();  // the least: with the shortest delay
  std::uint64_t broken = 0;

  bool compares() const { return log_after_header_ns != std::numeric_limits<std::int64_t>::max(); }

  std::int64_t of(std::optional<std::int64_t> header_ns, std::int64_t log_ns) {
    if (!header_ns || *header_ns == 0) {
      ++by_log;
      return log_ns;
    }
    ++by_header;
    // the difference of two times that a file may hold could leave the range
    const double apart_ns = static_cast<double>(log_ns) - static_cast<double>(*header_ns);
    if (std::abs(apart_ns) < 4e18) log_after_header_ns = std::min(log_after_header_ns, log_ns - *header_ns);
    return *header_ns;
  }
};

std::string plural(std::uint64_t n, const char* what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

void warn(const std::string& topic, const Stamps& stamps, bool has_header, std::vector<std::string>& warnings) {
  if (stamps.broken > 0)
    warnings.push_back(topic + ": " + plural(stamps.broken, "message") +
                       " left out: damaged, or not of the topic's type");
  if (stamps.by_log > 0)
    warnings.push_back(topic + ": " + (stamps.by_header > 0 ? plural(stamps.by_log, "message") : "all messages") +
                       " stamped by the time they were logged: " +
                       (has_header ? "their headers have no stamp" : "their type has no stamp of its own"));
}

Result<Done> stream_bag(const std::string& path, const ImportWishes& wishes, SampleStreams& streams) {
  const Result<BagContents> contents = contents_of_bag(path, streams.progress);
  if (!contents) return contents.error();
  Result<BagChoice> choice = chosen_of_bag(path, *contents, wishes);
  if (!choice) return choice.error();
  streams.warnings.insert(streams.warnings.end(), choice->warnings.begin(), choice->warnings.end());
  streams.warnings.insert(streams.warnings.end(), contents->damage.begin(), contents->damage.end());

  SampleSpool* wheels = nullptr;
  SampleSpool* commands = nullptr;
  std::optional<TruthStream> truth;
  if (!choice->wheels.empty()) {
    wheels = &streams.add_stream({"left_wheel_rad", "right_wheel_rad"});
    wheels->unwrap(0);
    wheels->unwrap(1);
  }
  if (!choice->commands.empty()) commands = &streams.add_stream({"command_speed_mps", "command_yaw_rate_radps"});
  if (!choice->truth.empty()) truth.emplace(streams, wishes.axes.value_or(SpaceAxes::z_up));

  Stamps wheel_stamps, command_stamps, truth_stamps;
  bool commands_have_header = false;
  std::uint64_t without_positions = 0;
  RosJointState joints;
  RosTwist twist;
  std::vector<RosPose> poses;
  std::optional<TransformChain> chain;
  if (!choice->truth_chain.empty()) chain.emplace(choice->truth_chain);
  const auto take_truth = [&](const RosPose& pose) {
    const SpacePose in_space{{pose.x, pose.y, pose.z}, rotation_of(pose.qx, pose.qy, pose.qz, pose.qw)};
    if (!truth->add(pose.stamp_ns, in_space)) ++truth_stamps.broken;
  };
  const auto is_truth = [&](const BagTopic& topic, RosKind kind) {
    if (!chain) return kind == RosKind::pose && topic.name == choice->truth;
    return kind == RosKind::transforms && std::any_of(choice->truth_chain.begin(), choice->truth_chain.end(),
                                                      [&](const TransformHop& h) { return h.topic == topic.name; });
  };
  const Result<BagFileReading> reading = read_bag(
      path,
      [&](const BagTopic& topic, std::int64_t log_ns, std::string_view bytes) {
        if (topic.encoding != "cdr") return;
        const RosKind kind = ros_kind(topic.type);
        if (wheels && kind == RosKind::joint_state && topic.name == choice->wheels) {
          if (!read_joint_state(bytes, joints)) return void(++wheel_stamps.broken);
          double values[2] = {std::nan(""), std::nan("")};
          bool named = false;
          for (std::size_t i = 0; i < joints.names.size(); ++i) {
            const int side = joints.names[i] == choice->left_joint    ? 0
                             : joints.names[i] == choice->right_joint ? 1
                                                                      : -1;
            if (side < 0) continue;
            named = true;
            if (i < joints.positions.size() && std::isfinite(joints.positions[i])) values[side] = joints.positions[i];
          }
          if (!named) return;  // other joints of the robot
          if (std::isnan(values[0]) && std::isnan(values[1])) return void(++without_positions);
          wheels->add(wheel_stamps.of(joints.stamp_ns, log_ns), values);
        } else if (commands && kind == RosKind::twist && topic.name == choice->commands) {
          if (!read_twist(topic.type, bytes, twist) || !std::isfinite(twist.forward_mps) ||
              !std::isfinite(twist.yaw_rate_radps))
            return void(++command_stamps.broken);
          commands_have_header = twist.stamp_ns.has_value();
          const double values[2] = {twist.forward_mps, twist.yaw_rate_radps};
          commands->add(command_stamps.of(twist.stamp_ns, log_ns), values);
        } else if (truth && is_truth(topic, kind)) {
          if (!read_poses(topic.type, bytes, poses)) return void(++truth_stamps.broken);
          for (RosPose& pose : poses) {
            if (chain && !chain->wants(topic.name, pose)) continue;
            pose.stamp_ns = truth_stamps.of(pose.stamp_ns, log_ns);
            if (chain)
              chain->add(topic.name, pose, take_truth);
            else
              take_truth(pose);
          }
        }
      },
      streams.progress);
  if (!reading) return reading.error();

  std::vector<std::string>& warnings = streams.warnings;
  if (wheels) warn(choice->wheels, wheel_stamps, true, warnings);
  if (commands) warn(choice->commands, command_stamps, commands_have_header, warnings);
  if (truth) {
    warn(choice->truth, truth_stamps, true, warnings);
    truth->warn(choice->truth, warnings);
    if (chain && chain->left_out() > 0)
      warnings.push_back(choice->truth + ": " + plural(chain->left_out(), "pose") +
                         " left out: another transform of the chain is missing there");
  }
  if (without_positions > 0)
    warnings.push_back(choice->wheels + ": " + plural(without_positions, "message") +
                       " left out: no position of the wheels in them");

  // Where the headers run on another clock than the log (simulated time, a computer with a clock of its own), what is
  // stamped by the log is moved onto the headers' clock.
  const Stamps& reference = wheel_stamps.by_header > 0 ? wheel_stamps : truth_stamps;
  if (reference.compares() && std::abs(reference.log_after_header_ns) > kOtherClock_ns) {
    if (commands && command_stamps.by_header == 0 && command_stamps.by_log > 0) {
      commands->shift(-reference.log_after_header_ns);
      warnings.push_back(choice->commands + ": moved by " +
                         number_text("%.3f", -static_cast<double>(reference.log_after_header_ns) * 1e-9) +
                         " s from the log's clock onto that of the other stamps");
    }
  }
  if (wheel_stamps.compares() && truth_stamps.compares()) {
    const double apart_s = 1e-9 * (static_cast<double>(wheel_stamps.log_after_header_ns) -
                                   static_cast<double>(truth_stamps.log_after_header_ns));
    if (std::abs(apart_s) > 0.1)
      warnings.push_back("messages of " + choice->wheels + " and " + choice->truth +
                         " that were logged together bear stamps " + number_text("%.3f", std::abs(apart_s)) +
                         " s apart: their clocks differ");
  }
  streams.provenance = "ROS 2 bag";
  return Done{};
}

}  // namespace

ForeignFormat ros2_bag_format() {
  return {"ROS 2 bags", "a ROS 2 bag (a folder, or its .mcap or .db3 file)", recognises_bag, nullptr, stream_bag};
}

}  // namespace odolab
