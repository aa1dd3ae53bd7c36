#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/diagnosis/diagnosis.h"

namespace odolab {
namespace {

constexpr double kLag_s = 0.065;

// Joystick driving of 50 Hz commands, each held until the next; the base follows with a lag, reckoned in steps of half a
// millisecond. Truth of a millimetre at 100 Hz.
Recording driven(int number, double lag_s) {
  Random random(static_cast<std::uint64_t>(70 + number));
  Recording r;
  r.name = "run_" + std::to_string(number);
  std::vector<double> speed, yaw_rate, x, y, heading;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN(), kStep_s = 0.0005;
  double command_v = 0.0, command_w = 0.0, v = 0.0, w = 0.0, wanted_v = 0.0, wanted_w = 0.0;
  Pose pose;
  for (int i = 0; i < 80000; ++i) {
    if (i % 3000 == 0) wanted_v = random.uniform(-0.3, 0.6), wanted_w = random.uniform(-0.9, 0.9);
    const bool commands = i % 40 == 0, seen = i % 20 == 0;
    if (commands) {
      command_v += std::clamp(wanted_v - command_v, -0.02, 0.02);
      command_w += std::clamp(wanted_w - command_w, -0.06, 0.06);
    }
    if (seen) {
      r.time_s.push_back(kStep_s * i);
      speed.push_back(commands ? command_v : kNone);
      yaw_rate.push_back(commands ? command_w : kNone);
      x.push_back(pose.x_m + 0.001 * random.normal());
      y.push_back(pose.y_m + 0.001 * random.normal());
      heading.push_back(pose.heading_rad + 0.002 * random.normal());
    }
    const double follows = 1.0 - std::exp(-kStep_s / lag_s);
    v += follows * (command_v - v), w += follows * (command_w - w);
    const double middle = pose.heading_rad + 0.5 * w * kStep_s;
    // its wheels roll a little unevenly
    const double rolled = v * kStep_s + 0.0005 * std::sqrt(std::abs(v) * kStep_s) * random.normal();
    pose = {pose.x_m + rolled * std::cos(middle), pose.y_m + rolled * std::sin(middle),
            pose.heading_rad + w * kStep_s + 0.001 * std::sqrt(std::abs(v) * kStep_s) * random.normal()};
  }
  r.add_channel("command_speed_mps").values = speed;
  r.add_channel("command_yaw_rate_radps").values = yaw_rate;
  r.add_channel("truth_x_m").values = x;
  r.add_channel("truth_y_m").values = y;
  r.add_channel("truth_heading_rad").values = heading;
  return r;
}

// Seen from its commands alone, a base that lags is nearly one that is late.
TEST(ActuatorLag, IsToldFromADelayThatTakesAlmostAllOfIt) {
  std::vector<Recording> recordings;
  for (int n = 1; n <= 4; ++n) recordings.push_back(driven(n, kLag_s));
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.verdict, Verdict::found);
  EXPECT_EQ(d.findings.front().effect, "actuator_lag");
  const FoundParameter& p = d.findings.front().parameters.front();
  EXPECT_LT(std::abs(p.value - kLag_s), 3.0 * p.stderr_value) << p.value << " +- " << p.stderr_value;
  EXPECT_NEAR(p.value, kLag_s, 0.05 * kLag_s);
  for (const Finding& f : d.findings) EXPECT_NE(f.effect, "actuator_delay");
}

}  // namespace
}  // namespace odolab
