#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/fitted_model.h"
#include "core/odometry/prediction.h"
#include "test/support/missing_physics.h"
#include "test/support/other_clock.h"

namespace odolab::test {
namespace {

struct OwnClocks {
  Case of;
  std::vector<double> offset_s, rate;
};

// Clocks that were set by hand, each at the start and at the end of its recording.
OwnClocks with_own_clocks(std::vector<double> rate, const std::string& effect = "", double size = 1.0) {
  CaseSettings settings;
  settings.effect = effect;
  settings.size = size;
  settings.runs = static_cast<int>(rate.size());
  settings.duration_s = 50.0;
  OwnClocks c{generated_case(settings, 8311), {0.03, -0.05, 0.08, -0.02}, std::move(rate)};
  for (std::size_t r = 0; r < c.of.recordings.size(); ++r)
    c.of.recordings[r] = with_truths_clock(c.of.recordings[r], c.offset_s[r], c.rate[r]);
  return c;
}

const FoundParameter& parameter(const Finding& f, const std::string& name) {
  for (const FoundParameter& p : f.parameters)
    if (p.name == name) return p;
  ADD_FAILURE() << name;
  return f.parameters.front();
}

TEST(ClocksFirst, ThatWereSetByHandHaveARateEach) {
  const OwnClocks c = with_own_clocks({-0.003, 0.002, -0.0008});
  const Result<Diagnosis> d = diagnose(c.of.recordings, {}, c.of.nominal);
  ASSERT_TRUE(d) << d.error().message();
  ASSERT_FALSE(d->findings.empty());
  const Finding& clock = d->findings.front();
  ASSERT_EQ(clock.effect, "clock_rate");
  for (std::size_t r = 0; r < c.rate.size(); ++r) {
    const FoundParameter& p = parameter(clock, "rate_" + std::to_string(r + 1));
    // Four standard errors of three numbers are exceeded by chance once in 5000 cases.
    EXPECT_NEAR(p.value, c.rate[r], 4.0 * p.stderr_value) << r;
    EXPECT_LT(p.stderr_value, 1e-4);  // a fiftieth of a second over the recording is plain to see
  }
  EXPECT_NEAR(parameter(clock, "rate").value, -0.0006, 4.0 * parameter(clock, "rate").stderr_value);
  for (const Finding& f : d->findings)
    EXPECT_TRUE(f.effect == "clock_rate" || f.effect.rfind("truth_", 0) == 0) << f.effect;
  // With its own clock each run is predicted from the others down to the noise, which calibration alone is not.
  ASSERT_TRUE(d->held_out.with_findings && d->held_out.calibrated && d->held_out.noise_floor);
  EXPECT_LT(d->held_out.with_findings->position_rms_m, 1.1 * d->held_out.noise_floor->position_rms_m);
  EXPECT_GT(d->held_out.calibrated->position_rms_m, 2.0 * d->held_out.noise_floor->position_rms_m);

  // A model that is made of it gives each recording its own.
  const FittedModel model = model_of(*d);
  for (std::size_t r = 0; r < c.rate.size(); ++r) {
    double rate = 0.0;
    for (const ActiveEffect& a : model.effects_in(c.of.recordings[r].name))
      if (a.effect == "clock_rate") rate += a.parameter("rate");
    EXPECT_NEAR(rate, c.rate[r], 4.0 * parameter(clock, "rate").stderr_value * std::sqrt(3.0)) << r;
  }
}

// By a share of a hundredth of all evidence, as other names must have, it had been their trace.
TEST(ClocksFirst, HideNoWheelThatIsOutOfRound) {
  const OwnClocks c = with_own_clocks({-0.003, 0.002, -0.0008, 0.001}, "wheel_eccentricity", 0.5);
  const Result<Diagnosis> d = diagnose(c.of.recordings, {}, c.of.nominal);
  ASSERT_TRUE(d) << d.error().message();
  const auto wheel = std::find_if(d->findings.begin(), d->findings.end(),
                                  [](const Finding& f) { return f.effect == "wheel_eccentricity"; });
  ASSERT_NE(wheel, d->findings.end());
  EXPECT_LT(wheel->share_of_mismatch, 0.01);
  EXPECT_NEAR(parameter(*wheel, "amplitude").value, 0.0025, 3.0 * parameter(*wheel, "amplitude").stderr_value);
}

TEST(ClocksFirst, AreKnownThoughSomethingElseHasNoName) {
  const OwnClocks c = with_own_clocks({-0.003, 0.002, -0.0008, 0.001}, "compass");
  const Result<Diagnosis> d = diagnose(c.of.recordings, {}, c.of.nominal);
  ASSERT_TRUE(d) << d.error().message();
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  const auto clock =
      std::find_if(d->findings.begin(), d->findings.end(), [](const Finding& f) { return f.effect == "clock_rate"; });
  ASSERT_NE(clock, d->findings.end());
  for (std::size_t r = 0; r < c.rate.size(); ++r)  // beside what is not described, to a tenth of the largest
    EXPECT_NEAR(parameter(*clock, "rate_" + std::to_string(r + 1)).value, c.rate[r], 3e-4) << r;
  for (const Alternative& a : d->findings.front().alternatives) EXPECT_NE(a.effect, "clock_rate");
  // They are in the model that is said: it predicts what calibration alone does not.
  EXPECT_LT(d->held_out.with_findings->position_rms_m, 0.5 * d->held_out.calibrated->position_rms_m);
}

TEST(ClocksFirst, OfOneRateInAllRecordingsAreOneNumber) {
  const OwnClocks c = with_own_clocks({0.002, 0.002, 0.002});
  const Result<Diagnosis> d = diagnose(c.of.recordings, {}, c.of.nominal);
  ASSERT_TRUE(d) << d.error().message();
  ASSERT_FALSE(d->findings.empty());
  const Finding& clock = d->findings.front();
  ASSERT_EQ(clock.effect, "clock_rate");
  ASSERT_EQ(clock.parameters.size(), 1u);
  EXPECT_NEAR(clock.parameters[0].value, 0.002, 4.0 * clock.parameters[0].stderr_value);
}

TEST(ClocksFirst, AreAlignedInAHeldOutRunBeforeItIsJudged) {
  const OwnClocks c = with_own_clocks({-0.003, 0.002, -0.0008, 0.003});
  const std::vector<Recording> train(c.of.recordings.begin(), c.of.recordings.end() - 1);
  const Result<Diagnosis> d = diagnose(train, {c.of.recordings.back()}, c.of.nominal);
  ASSERT_TRUE(d) << d.error().message();
  ASSERT_TRUE(d->held_out.with_findings && d->held_out.calibrated && d->held_out.noise_floor);
  EXPECT_LT(d->held_out.with_findings->position_rms_m, 1.15 * d->held_out.noise_floor->position_rms_m);
  EXPECT_GT(d->held_out.calibrated->position_rms_m, 2.0 * d->held_out.noise_floor->position_rms_m);
}

// By clocks that run apart a long drive shows no radius: 0.3 % of seven minutes are more than a second.
TEST(ClocksFirst, HideNothingOfTheCalibrationOnceTheyAreRight) {
  CaseSettings settings;
  settings.runs = 1;
  settings.duration_s = 400.0;
  const Case c = generated_case(settings, 8312);
  const Recording apart = with_truths_clock(c.recordings[0], 0.02, 0.003);
  const Result<Diagnosis> d = diagnose({apart}, {}, c.nominal);
  ASSERT_TRUE(d) << d.error().message();
  for (const Finding& f : d->findings)
    EXPECT_TRUE(f.effect == "clock_rate" || f.effect.rfind("truth_", 0) == 0) << f.effect;
  EXPECT_FALSE(d->calibration.scale_is_open);
  const std::map<std::string, double> actual = {{"wheel_radius_left_m", c.actual.wheel_radius_left_m},
                                                {"wheel_radius_right_m", c.actual.wheel_radius_right_m},
                                                {"wheelbase_m", c.actual.wheelbase_m}};
  for (const ParameterEstimate& p : d->calibration.parameters) {
    const auto known = actual.find(p.name);
    if (known == actual.end()) continue;
    EXPECT_TRUE(p.determined) << p.name;
    EXPECT_NEAR(p.value, known->second, 4.0 * p.stderr_value) << p.name;
  }
}

// What happens at a place happens where the wheels are, whatever their clock says: by the truth's stamps alone the
// patch had moved by 7 cm.
TEST(ClocksFirst, MoveNoPatchOfTheFloor) {
  CaseSettings settings;
  settings.effect = "slip_zone";
  settings.size = 2.0;
  settings.runs = 2;
  settings.duration_s = 150.0;
  const Case c = generated_case(settings, 8313);
  const auto patch_by_clocks_apart = [&](double rate) {
    std::vector<Recording> recordings;
    for (const Recording& r : c.recordings) recordings.push_back(with_truths_clock(r, 0.0, rate));
    const Diagnosis d = diagnose(recordings, {}, c.nominal).value();
    for (const Finding& f : d.findings)
      if (f.effect == "slip_zone" && f.where.zone) return Vec2{f.where.zone->x_m, f.where.zone->y_m};
    ADD_FAILURE() << rate;
    return Vec2{};
  };
  // Each is known to 1 cm.
  EXPECT_LT(length(patch_by_clocks_apart(0.003) - patch_by_clocks_apart(0.0)), 0.02);
}

// A truth that begins long after the wheels: the clocks agree where it begins, in the fit and in what it predicts.
TEST(ClocksFirst, AgreeWhereTheTruthBegins) {
  CaseSettings settings;
  settings.runs = 1;
  settings.duration_s = 60.0;
  const Case c = generated_case(settings, 8314);
  Recording late = c.recordings[0];
  for (Channel& channel : late.channels)
    if (channel.name.rfind("truth_", 0) == 0)
      for (std::size_t i = 0; i < late.time_s.size() && late.time_s[i] < 40.0; ++i) channel.values[i] = std::nan("");
  constexpr double kRate = 0.003;
  const Track right = predicted_track(late, c.nominal).value(),
              apart = predicted_track(with_truths_clock(late, 0.0, kRate), c.nominal,
                                      {{"clock_rate", "vehicle", {{"rate", kRate}}}})
                          .value();
  ASSERT_EQ(right.size(), apart.size());
  // By a clock that agreed where the wheels begin it had begun 0.12 s of the way elsewhere.
  for (std::size_t i = 0; i < right.size(); i += 100)
    EXPECT_LT(length(right[i].pose.position() - apart[i].pose.position()), 1e-4) << i;
}

}  // namespace
}  // namespace odolab::test
