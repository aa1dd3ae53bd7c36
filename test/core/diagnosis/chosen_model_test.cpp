#include "core/diagnosis/chosen_model.h"

#include <gtest/gtest.h>

#include "test/support/missing_physics.h"

namespace odolab {
namespace {

using test::Case;

double error_of(const FittedModel& model, const Recording& recording) {
  const Result<Track> track =
      predicted_track(recording, model.vehicle_in(recording.name), model.effects_in(recording.name));
  return track_error(*track, truth_track(recording))->heading_rms_rad;
}

Case with_scrub() {
  test::CaseSettings settings;
  settings.effect = "turn_scrub";
  settings.size = 2.0;
  settings.runs = 2;
  settings.duration_s = 40.0;
  return test::generated_case(settings, 5);
}

TEST(DiagnoseChosen, ModelWithNoneIsTheCalibrationAndWithAllTheFittedModel) {
  const Case c = with_scrub();
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  ASSERT_FALSE(d->findings.empty());
  const std::vector<bool> none(d->findings.size(), false), all(d->findings.size(), true);
  const Result<FittedModel> off = model_with(*d, none, c.recordings, c.nominal),
                            on = model_with(*d, all, c.recordings, c.nominal);
  ASSERT_TRUE(off && on);
  EXPECT_TRUE(off->effects.empty());
  EXPECT_EQ(on->effects.size(), model_of(*d).effects.size());
  EXPECT_LT(error_of(*on, c.recordings[0]), error_of(*off, c.recordings[0]));
}

// A second finding that is nothing: what is left on must be fitted to the data as if the other were not there, so that
// the calibration comes to what it was with the first alone.
TEST(DiagnoseChosen, CalibrationIsFittedAnewToWhatIsLeftOn) {
  const Case c = with_scrub();
  Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  std::vector<bool> on(d->findings.size(), true);
  Finding extra;
  extra.effect = "lateral_slip";
  extra.component = "vehicle";
  extra.parameters = {{"m_per_s_per_mps2", 0.0, 0.001, "s"}};
  d->findings.push_back(extra);
  on.push_back(false);
  const Result<FittedModel> some = model_with(*d, on, c.recordings, c.nominal);
  ASSERT_TRUE(some);
  const auto& fitted = std::get<DifferentialDrive>(some->vehicle.kind);
  const auto& whole = std::get<DifferentialDrive>(d->calibration.vehicle.kind);
  // the same data and the same effect at its size: some standard errors at most
  for (const ParameterEstimate& p : d->calibration.parameters)
    if (p.name == "wheelbase_m") {
      EXPECT_NEAR(fitted.wheelbase_m, whole.wheelbase_m, 4.0 * p.stderr_value);
    }
  EXPECT_NEAR(fitted.wheel_radius_left_m, whole.wheel_radius_left_m, 2e-5);
  EXPECT_EQ(some->effects.size(), d->findings.size() - 1);
}

TEST(ChosenModel, FaultsAndNamelessThingsHaveNoSwitch) {
  for (const char* name :
       {"unknown", "truth_frozen", "encoder_data_fault", "truth_mounting_offset", "link_angle_bias"}) {
    Finding f;
    f.effect = name;
    EXPECT_FALSE(can_be_switched_on(f)) << name;
  }
}

// The fit has a base that follows late as a truth that is late: it is one or the other, whatever else is on.
TEST(DiagnoseChosen, DelayIsNotInTheClocksAsWell) {
  const Case c = with_scrub();
  Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  std::vector<bool> on(d->findings.size(), true);
  Finding delay, extra;
  delay.effect = "actuator_delay";
  delay.component = "vehicle";
  delay.parameters = {{"delay_s", 0.1, 0.001, "s"}};
  extra.effect = "lateral_slip";
  extra.component = "vehicle";
  extra.parameters = {{"m_per_s_per_mps2", 0.0, 0.001, "s"}};
  d->findings.push_back(delay);
  d->findings.push_back(extra);
  on.insert(on.end(), {true, false});
  const Result<FittedModel> some = model_with(*d, on, c.recordings, c.nominal);
  ASSERT_TRUE(some);
  const FittedModel all = model_of(*d);
  ASSERT_EQ(some->truth_clock_s.size(), all.truth_clock_s.size());
  for (std::size_t r = 0; r < all.truth_clock_s.size(); ++r)  // clocks are known to a millisecond
    EXPECT_NEAR(some->truth_clock_s[r].second, all.truth_clock_s[r].second, 0.003);
}

}  // namespace
}  // namespace odolab
