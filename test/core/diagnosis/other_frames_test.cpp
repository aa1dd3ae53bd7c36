#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"
#include "test/support/other_room.h"

namespace odolab::test {
namespace {

const FoundParameter& frame_parameter(const Finding& f, const std::string& name) {
  for (const FoundParameter& p : f.parameters)
    if (p.name == name) return p;
  ADD_FAILURE() << name;
  return f.parameters.front();
}

// Stamps that count from 1970, in a room whose origin is that of a map.
Recording elsewhere(Recording r, double later_s, const Pose& room) {
  for (double& t : r.time_s) t += later_s;
  return in_room(std::move(r), room);
}

TEST(Diagnosis, KnowsAPushAsWellWhereStampsCountFrom1970AndTheRoomIsAMaps) {
  constexpr double kLater_s = 1.73e9;
  constexpr Pose kRoom{465000.0, 5247000.0, 0.7};
  CaseSettings settings;
  settings.effect = "collision";
  settings.size = 2.0;
  settings.runs = 3;
  settings.duration_s = 40.0;
  const Case c = generated_case(settings, 5);
  std::vector<Recording> there;
  for (const Recording& r : c.recordings) there.push_back(elsewhere(r, kLater_s, kRoom));
  const Diagnosis here = diagnose(c.recordings, {}, c.nominal).value(), d = diagnose(there, {}, c.nominal).value();
  ASSERT_FALSE(here.findings.empty());
  ASSERT_EQ(here.findings.front().effect, "collision");
  ASSERT_FALSE(d.findings.empty());
  const Finding &a = here.findings.front(), &b = d.findings.front();
  ASSERT_EQ(b.effect, "collision");
  // A stamp of 1970 holds a quarter of a microsecond; a place in such a map a nanometre.
  EXPECT_NEAR(b.log_likelihood_gain, a.log_likelihood_gain, 0.02 * a.log_likelihood_gain);
  EXPECT_NEAR(frame_parameter(b, "at_s").value - kLater_s, frame_parameter(a, "at_s").value, 0.01);
  EXPECT_NEAR(frame_parameter(b, "at_s").stderr_value, frame_parameter(a, "at_s").stderr_value,
              0.1 * frame_parameter(a, "at_s").stderr_value);
  const Vec2 pushed = rotated({frame_parameter(a, "dx_m").value, frame_parameter(a, "dy_m").value}, kRoom.heading_rad);
  EXPECT_NEAR(frame_parameter(b, "dx_m").value, pushed.x_m, 0.2 * frame_parameter(a, "dx_m").stderr_value);
  EXPECT_NEAR(frame_parameter(b, "dy_m").value, pushed.y_m, 0.2 * frame_parameter(a, "dy_m").stderr_value);
}

}  // namespace
}  // namespace odolab::test
