#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/fitted_model.h"
#include "core/diagnosis/units/merged.h"
#include "core/diagnosis/units/merged_findings.h"
#include "core/odometry/prediction.h"
#include "test/support/crooked_vehicles.h"
#include "test/support/other_clock.h"

namespace odolab::test {
namespace {

Diagnosis diagnosed(const std::vector<Recording>& runs, const VehicleKind& nominal) {
  Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(nominal));
  EXPECT_TRUE(d) << (d ? "" : d.error().message());
  return d ? std::move(*d) : Diagnosis{};
}

std::string verdict_said(const Diagnosis& d) {
  std::string s = std::to_string(static_cast<int>(d.verdict)) + ": ";
  for (const Finding& f : d.findings) s += f.effect + ":" + f.component + " ";
  return s;
}

TEST(DiagnoseUnits, FindNothingWhereOnlyTheLengthsAreWrong) {
  EXPECT_EQ(diagnosed(clapper_runs(crooked_clapper(), {}, 21), Clapper{}).verdict, Verdict::nothing_missing);
  std::vector<Recording> towed, castors;
  for (std::uint64_t k = 0; k < 3; ++k) {
    towed.push_back(trailer_run(crooked_trailer(), {}, 31 + k));
    castors.push_back(castor_run(crooked_castors(), {}, 41 + k));
  }
  const Diagnosis of_trailer = diagnosed(towed, EncoderTrailer{}),
                  of_castors = diagnosed(castors, three_castor_vehicle());
  EXPECT_EQ(of_trailer.verdict, Verdict::nothing_missing) << verdict_said(of_trailer);
  EXPECT_EQ(of_castors.verdict, Verdict::nothing_missing) << verdict_said(of_castors);
}

TEST(DiagnoseUnits, SayWhichWheelOfWhichTruckAndPredictTheBetterForIt) {
  LinkedRunSettings s;
  s.b_left = [](double, double, double by_rad) { return std::abs(by_rad) > 0.03 ? -0.04 * by_rad : 0.0; };  // 3 rad/s
  const std::vector<Recording> runs = clapper_runs(crooked_clapper(), s, 51);
  const Diagnosis d = diagnosed(runs, Clapper{});
  ASSERT_FALSE(d.findings.empty()) << verdict_said(d);
  EXPECT_EQ(d.findings.front().effect, "encoder_missed_counts") << verdict_said(d);
  EXPECT_EQ(d.findings.front().component, "truck_b.left_wheel");
  EXPECT_NEAR(d.findings.front().parameters[0].value, 0.04, 0.006);
  const FittedModel model = model_of(d);
  // Where one run ends is chance; of eight it is not.
  double with_m2 = 0.0, without_m2 = 0.0;
  for (std::uint64_t seed = 61; seed < 69; ++seed) {
    const Recording unseen = linked_run(crooked_clapper(), s, seed);
    const Result<Track> with = predicted_track(unseen, model.vehicle, model.effects_in("")),
                        without = predicted_track(unseen, calibrated_model_of(d).vehicle);
    ASSERT_TRUE(with && without);
    const auto end_m = [&](const Track& track) { return track_error(track, truth_track(unseen))->end_position_m; };
    with_m2 += end_m(*with) * end_m(*with);
    without_m2 += end_m(*without) * end_m(*without);
  }
  EXPECT_LT(with_m2, without_m2);
}

// An effect is asked for in every unit, a bias in every joint; each is said once, of where it is likeliest.
TEST(DiagnoseUnits, SayOfEveryEffectThatWasAskedForWhatBecameOfIt) {
  LinkedRunSettings s;
  s.b_left = [](double, double, double by_rad) { return std::abs(by_rad) > 0.03 ? -0.04 * by_rad : 0.0; };  // 3 rad/s
  const Diagnosis d = diagnosed(clapper_runs(crooked_clapper(), s, 51), Clapper{});
  std::multiset<std::string> asked;
  for (const AskedEffect& a : d.asked) {
    asked.insert(a.effect);
    const bool is_found =
        std::any_of(d.findings.begin(), d.findings.end(), [&](const Finding& f) { return f.effect == a.effect; });
    EXPECT_EQ(a.named, is_found) << a.effect;
  }
  for (const char* effect : {"encoder_missed_counts", "turn_scrub", "link_angle_bias", "link_length_bias"})
    EXPECT_EQ(asked.count(effect), 1u) << effect;
  ASSERT_FALSE(d.asked.empty());
  EXPECT_EQ(d.asked.front().effect, "encoder_missed_counts");
  EXPECT_EQ(d.asked.front().component, "truck_b.left_wheel");
}

TEST(DiagnoseUnits, TellABiasedLinkEncoderFromTheTrucks) {
  Clapper actual = crooked_clapper();
  actual.link_angle_a_offset_rad = 0.012;
  const Diagnosis d = diagnosed(clapper_runs(actual, {}, 71), Clapper{});
  ASSERT_EQ(d.findings.size(), 1u) << verdict_said(d);
  EXPECT_EQ(d.findings[0].effect, "link_angle_bias");
  EXPECT_EQ(d.findings[0].component, "truck_a");
  EXPECT_NEAR(d.findings[0].parameters[0].value, 0.012, 4.0 * d.findings[0].parameters[0].stderr_value);
}

// A camera that reads headings to a degree puts truck B to 2 cm; by their wheels the trucks know it to a tenth of that.
TEST(DiagnoseUnits, NameABiasThatACoarseTruthCannotShowByWhatTheTrucksSayOfEachOther) {
  Clapper actual = crooked_clapper();
  actual.link_angle_a_offset_rad = 0.005;
  LinkedRunSettings settings;
  settings.duration_s = 60.0;
  settings.truth_m = 0.008;
  settings.truth_rad = 0.02;
  const Diagnosis d = diagnosed(clapper_runs(actual, settings, 75), Clapper{});
  ASSERT_EQ(d.findings.size(), 1u) << verdict_said(d);
  EXPECT_EQ(d.findings[0].effect, "link_angle_bias");
  EXPECT_EQ(d.findings[0].component, "truck_a");
  EXPECT_NEAR(d.findings[0].parameters[0].value, 0.005, 4.0 * d.findings[0].parameters[0].stderr_value);
  EXPECT_LT(d.findings[0].parameters[0].stderr_value, 0.0008);
}

// All lengths as shares of the wheels': a link 2.5 % longer, in its file, than wheels 2.5 % too small in theirs.
TEST(DiagnoseUnits, TakeWheelsThatAreAllTooSmallFromTheInsideForNoBiasOfTheLink) {
  Clapper file = fine_clapper();
  const Clapper actual = file;
  for (DifferentialDrive* truck : {&file.truck_a, &file.truck_b}) {
    truck->wheel_radius_left_m *= 0.975;
    truck->wheel_radius_right_m *= 0.975;
  }
  std::vector<Recording> runs = clapper_runs(actual, {}, 211);
  for (Recording& r : runs) r.channels.resize(r.channels.size() - 3);
  const Diagnosis d = diagnosed(runs, file);
  EXPECT_EQ(d.verdict, Verdict::nothing_missing) << verdict_said(d);
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(), [](const std::string& w) {
    return w.find("a straight measured with a tape") != std::string::npos;
  }));
}

TEST(DiagnoseUnits, NameABiasOfTheLinkFromTheInsideOnlyBesideTheScaleOfTheWheels) {
  const Clapper file = fine_clapper();
  Clapper actual = file;
  actual.link_length_offset_m = 0.06 * actual.link_length_m;  // twice what wheels of 3 % would make of it
  std::vector<Recording> runs = clapper_runs(actual, {}, 221);
  for (Recording& r : runs) r.channels.resize(r.channels.size() - 3);
  const Diagnosis d = diagnosed(runs, file);
  const auto bias = std::find_if(d.findings.begin(), d.findings.end(),
                                 [](const Finding& f) { return f.effect == "link_length_bias"; });
  ASSERT_NE(bias, d.findings.end()) << verdict_said(d);
  EXPECT_NEAR(bias->parameters[0].value, actual.link_length_offset_m, 6.0 * bias->parameters[0].stderr_value);
  EXPECT_EQ(d.verdict, Verdict::ambiguous);
  ASSERT_EQ(bias->alternatives.size(), 1u);
  EXPECT_EQ(bias->alternatives[0].effect, "wheel_scale");
}

TEST(DiagnoseUnits, FindALinkThatIsFourMillimetresLongerThanItReadsWithAnOutsideTruth) {
  const Clapper file = fine_clapper();
  Clapper actual = crooked(file);
  actual.link_length_offset_m = -0.004;
  const Diagnosis d = diagnosed(clapper_runs(actual, {}, 231), file);
  ASSERT_EQ(d.findings.size(), 1u) << verdict_said(d);
  EXPECT_EQ(d.findings[0].effect, "link_length_bias");
  EXPECT_NEAR(d.findings[0].parameters[0].value, -0.004, 4.0 * d.findings[0].parameters[0].stderr_value);
}

TEST(DiagnoseUnits, FindABiasedPivotAndSayThatToeWouldLookTheSame) {
  MultiCastor actual = crooked_castors();
  actual.castors[1].pivot_encoder_offset_rad = 0.015;
  std::vector<Recording> runs;
  for (std::uint64_t k = 0; k < 3; ++k) runs.push_back(castor_run(actual, {}, 81 + k));
  const Diagnosis d = diagnosed(runs, three_castor_vehicle());
  ASSERT_EQ(d.findings.size(), 1u) << verdict_said(d);
  EXPECT_EQ(d.findings[0].effect, "pivot_angle_bias");
  EXPECT_EQ(d.findings[0].component, "castor2");
  EXPECT_NEAR(d.findings[0].parameters[0].value, 0.015, 4.0 * d.findings[0].parameters[0].stderr_value);
  EXPECT_EQ(d.verdict, Verdict::ambiguous);
  EXPECT_EQ(d.findings[0].alternatives.at(0).effect, "wheel_toe");
}

// Nothing outside is known: what truck B's wheel does wrong shows in the link, and is not put on truck A.
// What nearly all castors have in common their own way tells last: four turns had left a bias of many standard errors.
TEST(DiagnoseUnits, TakeWheelsOfCastorsThatAreTwoPercentOffFromTheInsideForNoBiasOfAPivot) {
  MultiCastor actual = three_castor_vehicle();
  const double off[] = {0.02, -0.015, 0.01};
  for (std::size_t k = 0; k < 3; ++k) {
    actual.castors[k].wheel_radius_left_m *= 1.0 + off[k];
    actual.castors[k].wheel_radius_right_m *= 1.0 - 0.4 * off[k];
  }
  LinkedRunSettings settings;
  settings.duration_s = 60.0;
  std::vector<Recording> runs = {castor_run(actual, settings, 321), castor_run(actual, settings, 322)};
  for (Recording& r : runs) r.channels.resize(r.channels.size() - 3);
  const Diagnosis d = diagnosed(runs, three_castor_vehicle());
  EXPECT_EQ(d.verdict, Verdict::nothing_missing) << verdict_said(d);
  EXPECT_TRUE(d.calibration.scale_is_open);  // lengths that are all a percent too small turn the same way
}

// Each castor by itself had shown a tenth of it, since its pivot reads on the one clock and the truth on the other.
TEST(DiagnoseUnits, MeasureClocksThatRunApartThoughNoCastorCarriesTheTruth) {
  constexpr double kRate = 8e-4;
  LinkedRunSettings settings;
  settings.duration_s = 60.0;
  std::vector<Recording> runs;
  for (const std::uint64_t seed : {331u, 332u})
    runs.push_back(with_truths_clock(castor_run(three_castor_vehicle(), settings, seed), 0.0, kRate));
  const Diagnosis d = diagnosed(runs, three_castor_vehicle());
  ASSERT_FALSE(d.findings.empty());
  const auto clock =
      std::find_if(d.findings.begin(), d.findings.end(), [](const Finding& f) { return f.effect == "clock_rate"; });
  ASSERT_NE(clock, d.findings.end()) << verdict_said(d);
  EXPECT_EQ(clock->component, "vehicle");
  EXPECT_NEAR(clock->parameters[0].value, kRate, 3.0 * clock->parameters[0].stderr_value);
  EXPECT_LT(clock->parameters[0].stderr_value, 0.1 * kRate);
}

TEST(DiagnoseUnits, TellFromTheInsideWhichTruckErrs) {
  LinkedRunSettings s;
  s.b_left = [](double, double, double by_rad) { return std::abs(by_rad) > 0.03 ? -0.04 * by_rad : 0.0; };  // 3 rad/s
  std::vector<Recording> runs = clapper_runs(crooked_clapper(), s, 95);
  for (Recording& r : runs) r.channels.resize(r.channels.size() - 3);
  ASSERT_TRUE(truth_samples(runs[0]).empty());
  const Diagnosis d = diagnosed(runs, Clapper{});
  ASSERT_FALSE(d.findings.empty()) << verdict_said(d);
  EXPECT_EQ(d.findings[0].effect, "encoder_missed_counts") << verdict_said(d);
  EXPECT_EQ(d.findings[0].component, "truck_b.left_wheel");
  EXPECT_NEAR(d.findings[0].parameters[0].value, 0.04, 0.006);
  const auto slope = std::find_if(d.not_testable.begin(), d.not_testable.end(),
                                  [](const NotTestable& n) { return n.effect == "floor_slope_creep"; });
  EXPECT_NE(slope, d.not_testable.end());
}

TEST(DiagnoseUnits, SayThatSomethingIsMissingWhereALinksEncoderWobbles) {
  std::vector<Recording> runs = clapper_runs(fine_clapper(), {}, 261);
  for (Recording& r : runs) wobble(r, 0.008);
  const Diagnosis d = diagnosed(runs, fine_clapper());
  EXPECT_EQ(d.verdict, Verdict::unknown_effect) << verdict_said(d);
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.findings[0].effect, "unknown");
  EXPECT_EQ(d.findings[0].component, "truck_a");
  ASSERT_FALSE(d.responses.empty());
  EXPECT_EQ(d.responses[0].variable, "the link angle A [rad]");
}

TEST(DiagnoseUnits, FindNothingWherePivotsStandAFewMillimetresElsewhere) {
  std::vector<Recording> runs;
  for (std::uint64_t k = 0; k < 3; ++k) runs.push_back(castor_run(castors_with_pivots_elsewhere(), {}, 281 + k));
  const Diagnosis d = diagnosed(runs, three_castor_vehicle());
  for (const Finding& f : d.findings) EXPECT_EQ(f.component, "truth") << verdict_said(d);
}

TEST(DiagnoseUnits, RefuseRecordingsWithoutTheJointsAndVehiclesWithoutUnits) {
  Recording run = linked_run(Clapper{}, {}, 91);
  run.channels.erase(run.channels.begin() + 4);
  const Result<Diagnosis> without = diagnose({run}, {}, vehicle_of(Clapper{}));
  ASSERT_FALSE(without);
  EXPECT_NE(without.error().message().find("link_angle_a_rad"), std::string::npos) << without.error().message();
  const Result<Diagnosis> synchro = diagnose({run}, {}, vehicle_of(SynchroDrive{}));
  ASSERT_FALSE(synchro);
  EXPECT_NE(synchro.error().message().find("synchro_drive"), std::string::npos);
}

TEST(Units, ABiasStandsBesideAnEncoderThatErrsOnlyWhereItSaysMore) {
  for (const double gain : {800.0, 1600.0}) {
    Finding erring, bias;
    erring.effect = "unknown";
    erring.component = "truck_b";
    erring.log_likelihood_gain = 1000.0;
    bias.effect = "link_length_bias";
    bias.log_likelihood_gain = gain;
    std::vector<Finding> found = {erring, bias};
    leave_out_biases_beside_erring_joints(found);
    EXPECT_EQ(found.size(), gain > erring.log_likelihood_gain ? 2u : 1u) << gain;
  }
}

TEST(Units, HowWellTheTruthsPlaceIsKnownMakesNothingElseSmall) {
  Finding unknown, mounting, slip;
  unknown.effect = "unknown";
  unknown.log_likelihood_gain = 50.0;
  mounting.effect = "truth_mounting_offset";
  mounting.log_likelihood_gain = 1e6;
  slip.effect = "lateral_slip";
  slip.log_likelihood_gain = 1000.0;
  std::vector<Finding> found = {unknown, mounting};
  EXPECT_FALSE(leave_out_small_rest(found));
  EXPECT_EQ(found.size(), 2u);
  found.push_back(slip);  // beside what has a name a twentieth is small
  EXPECT_TRUE(leave_out_small_rest(found));
  EXPECT_EQ(found.size(), 2u);
}

}  // namespace
}  // namespace odolab::test
