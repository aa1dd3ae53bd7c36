// What happens once and has no name: a vehicle that is lifted, a tracker that is elsewhere for a while.
#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

Case two_minutes(std::uint64_t seed) {
  CaseSettings settings;
  settings.runs = 1;
  settings.duration_s = 120.0;
  return generated_case(settings, seed);
}

// Moves what the truth says from a time on, by a pose on the floor's side.
void carry_truth(Recording& r, double from_s, const std::function<Pose(double time_s)>& room_T_said) {
  std::vector<double>*x = nullptr, *y = nullptr, *heading = nullptr;
  for (Channel& c : r.channels) {
    if (c.name == "truth_x_m") x = &c.values;
    if (c.name == "truth_y_m") y = &c.values;
    if (c.name == "truth_heading_rad") heading = &c.values;
  }
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    if (r.time_s[i] < from_s || std::isnan((*x)[i])) continue;
    const Pose moved = room_T_said(r.time_s[i]) * Pose{(*x)[i], (*y)[i], (*heading)[i]};
    (*x)[i] = moved.x_m, (*y)[i] = moved.y_m, (*heading)[i] = moved.heading_rad;
  }
}

// Carried through the air for six seconds, by a way of its own, with the wheels turning; all else is as it was.
TEST(Parted, AreTheTruthAndTheWheelsWhereAVehicleIsLiftedAndNowhereElse) {
  constexpr double kFrom_s = 60.0, kTo_s = 66.0;
  Case c = two_minutes(41);
  const Diagnosis before = diagnose(c.recordings, {}, c.nominal).value();
  ASSERT_EQ(before.verdict, Verdict::nothing_missing);
  carry_truth(c.recordings[0], kFrom_s, [&](double t) {
    const double u = std::min(1.0, (t - kFrom_s) / (kTo_s - kFrom_s)), swing = std::sin(4.0 * kPi * u);
    return Pose{1.3 * u + 0.3 * swing, -0.8 * u, 0.6 * u + 0.5 * swing};
  });
  const Diagnosis d = diagnose(c.recordings, {}, c.nominal).value();
  EXPECT_EQ(d.verdict, Verdict::unknown_effect);
  ASSERT_EQ(d.findings.size(), 1u);
  ASSERT_EQ(d.findings[0].where.time_s.size(), 1u);
  EXPECT_NEAR(d.findings[0].where.time_s[0].first, kFrom_s, 1.0);  // until a filter starts anew and agrees again
  EXPECT_NEAR(d.findings[0].where.time_s[0].second, kTo_s, 1.5);
  // The calibration is that of the rest: 5 % of the time are gone.
  for (const ParameterEstimate& p : d.calibration.parameters)
    for (const ParameterEstimate& q : before.calibration.parameters)
      if (p.name == q.name && p.determined) {
        EXPECT_NEAR(p.value, q.value, q.stderr_value + p.stderr_value) << p.name;
      }
}

// The run that was held out, and not those that were fitted.
TEST(Parted, TakeNothingFromWhatOthersSayWhereTheyDoSoInARunThatIsHeldOut) {
  CaseSettings settings;
  settings.runs = 3;
  Case c = generated_case(settings, 43);
  Recording held_out = c.recordings.back();
  c.recordings.pop_back();
  carry_truth(held_out, 20.0, [&](double t) {
    const double u = std::min(1.0, (t - 20.0) / 6.0), swing = std::sin(4.0 * kPi * u);
    return Pose{1.3 * u + 0.3 * swing, -0.8 * u, 0.6 * u + 0.5 * swing};
  });
  const Diagnosis d = diagnose(c.recordings, {held_out}, c.nominal).value();
  EXPECT_EQ(d.verdict, Verdict::nothing_missing);
  bool is_said = false;
  for (const std::string& w : d.warnings) is_said = is_said || w.find("the wheels part") != std::string::npos;
  EXPECT_TRUE(is_said);
}

// Two markers change places for so long and are themselves again.
TEST(Parted, IsNoTruthThatIsElsewhereForSecondsAndThenBackWhereTheWheelsWent) {
  for (const double lasts_s : {1.0, 3.0, 6.0}) {
    Case c = two_minutes(42);
    carry_truth(c.recordings[0], 50.0, [&](double t) { return t < 50.0 + lasts_s ? Pose{1.5, 0.4, 0.0} : Pose{}; });
    const Diagnosis d = diagnose(c.recordings, {}, c.nominal).value();
    EXPECT_EQ(d.verdict, Verdict::nothing_missing) << lasts_s;
    bool is_said = false;
    for (const std::string& w : d.warnings) is_said = is_said || w.find("the truth is elsewhere") != std::string::npos;
    EXPECT_TRUE(is_said) << lasts_s;
  }
}

}  // namespace
}  // namespace odolab::test
