#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/diagnosis/diagnosis.h"

namespace odolab {
namespace {

// Commands that change at once, logged 50 times a second. The base asks for one now and then, 0.05 to 0.25 s after the
// last time, and keeps it until it asks again; of its forward speed it loses `loss` for each radian a second. Truth of
// a millimetre at 100 Hz.
Recording asked_now_and_then(int number, double loss) {
  Random random(static_cast<std::uint64_t>(400 + number));
  Recording r;
  r.name = "run_" + std::to_string(number);
  std::vector<double> speed, yaw_rate, x, y, heading;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN(), kStep_s = 0.0005;
  double command_v = 0.0, command_w = 0.0, v = 0.0, w = 0.0, asks_at_s = 0.0, changes_at_s = 1.0;
  Pose pose;
  for (int i = 0; i < 120000; ++i) {
    const double t = kStep_s * i;
    if (t >= changes_at_s) {
      changes_at_s = t + random.uniform(0.4, 2.0);
      const double kind = random.uniform();
      command_v = kind < 0.15 ? 0.0 : random.uniform(0.1, 0.4);
      command_w = kind < 0.5 ? 0.0 : random.uniform(-0.8, 0.8);
    }
    if (t >= asks_at_s) {
      asks_at_s = t + random.uniform(0.05, 0.25);
      v = command_v * (1.0 - loss * std::abs(command_w));
      w = command_w;
    }
    if (i % 20 == 0) {
      r.time_s.push_back(t);
      speed.push_back(i % 40 == 0 ? command_v : kNone);
      yaw_rate.push_back(i % 40 == 0 ? command_w : kNone);
      x.push_back(pose.x_m + 0.001 * random.normal());
      y.push_back(pose.y_m + 0.001 * random.normal());
      heading.push_back(pose.heading_rad + 0.002 * random.normal());
    }
    const double middle = pose.heading_rad + 0.5 * w * kStep_s;
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

Diagnosis diagnosed(double loss) {
  std::vector<Recording> recordings;
  for (int n = 1; n <= 3; ++n) recordings.push_back(asked_now_and_then(n, loss));
  return diagnose(recordings, {}, Vehicle{}).value();
}

// That the base is late, and on average takes up a change bit by bit, is no more than it does.
bool is_late(const Finding& f) {
  return f.effect == "actuator_delay" || f.effect == "actuator_lag" || f.effect == "truth_time_offset";
}

// Commands that are acted on sooner one time and later the next leave what looks like pushes, and hid what is missing:
// of a real robot a loss in turns had been *unknown*.
TEST(CommandTiming, IsNoiseWhereABaseAsksForCommandsNowAndThen) {
  const Diagnosis d = diagnosed(0.0);
  EXPECT_NE(d.verdict, Verdict::unknown_effect);
  for (const Finding& f : d.findings) EXPECT_TRUE(is_late(f)) << f.effect;
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), [](const std::string& w) {
    return w.find("acts on each change of its command") != std::string::npos;
  }));
}

TEST(CommandTiming, HidesNoLossInTurns) {
  constexpr double kLoss = 0.3;
  const Diagnosis d = diagnosed(kLoss);
  EXPECT_NE(d.verdict, Verdict::unknown_effect);
  ASSERT_FALSE(d.findings.empty());
  const Finding& f = d.findings.front();
  ASSERT_EQ(f.effect, "turn_speed_loss");
  EXPECT_NEAR(f.parameters[0].value, kLoss, 3.0 * f.parameters[0].stderr_value);
  for (std::size_t k = 1; k < d.findings.size(); ++k) EXPECT_TRUE(is_late(d.findings[k])) << d.findings[k].effect;
}

}  // namespace
}  // namespace odolab
