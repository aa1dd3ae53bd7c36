#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/fitted_model.h"
#include "core/diagnosis/units/component_names.h"
#include "core/diagnosis/units/geometry_fit.h"
#include "core/diagnosis/units/joint_residuals.h"
#include "core/diagnosis/units/merged.h"
#include "core/diagnosis/units/merged_findings.h"
#include "core/diagnosis/units/outside_truth.h"
#include "core/diagnosis/units/traces.h"
#include "core/diagnosis/units/unit_recordings.h"
#include "core/odometry/prediction.h"
#include "test/support/linked_runs.h"
#include "test/support/other_clock.h"

namespace odolab::test {
namespace {

Clapper crooked(Clapper actual) {
  actual.truck_a.wheel_radius_left_m *= 1.003;
  actual.truck_b.wheel_radius_right_m *= 0.996;
  actual.truck_b.wheelbase_m *= 1.008;
  return actual;
}

Clapper crooked_clapper() { return crooked({}); }

EncoderTrailer crooked_trailer() {
  EncoderTrailer actual;
  actual.trailer.wheel_radius_left_m *= 1.004;
  actual.trailer.wheelbase_m *= 0.99;
  return actual;
}

MultiCastor crooked_castors() {
  MultiCastor actual = three_castor_vehicle();
  actual.castors[1].wheel_radius_left_m *= 1.002;
  actual.castors[2].offset_m *= 0.997;
  return actual;
}

std::vector<Recording> clapper_runs(const Clapper& actual, const LinkedRunSettings& s, std::uint64_t seed) {
  return {linked_run(actual, s, seed), linked_run(actual, s, seed + 1), linked_run(actual, s, seed + 2)};
}

Diagnosis diagnosed(const std::vector<Recording>& runs, const VehicleKind& nominal) {
  Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(nominal));
  EXPECT_TRUE(d) << (d ? "" : d.error().message());
  return d ? std::move(*d) : Diagnosis{};
}

std::string said(const Diagnosis& d) {
  std::string s = std::to_string(static_cast<int>(d.verdict)) + ": ";
  for (const Finding& f : d.findings) s += f.effect + ":" + f.component + " ";
  return s;
}

TEST(VehicleUnits, StandWhereTheKinematicsPutThem) {
  const Clapper trucks = crooked_clapper();
  LinkedKinematics linked(trucks, {1.0, 2.0, 0.3}, 0.4, -0.2, 1.02);
  linked.move({0.3, 0.5}, {0.25, -0.2}, 2.0);
  const LinkedSample read = linked.reading();
  const Pose b = linked.a() * tracked_T_axle(vehicle_of(trucks), 1,
                                             {read.link_angle_a_rad, read.link_angle_b_rad, read.link_length_m});
  EXPECT_NEAR(length(b.position() - linked.b().position()), 0.0, 1e-12);
  EXPECT_NEAR(wrapped(b.heading_rad - linked.b().heading_rad), 0.0, 1e-12);

  // A castor's axle: its pivot goes with the body, and the axle rolls along itself.
  const MultiCastor platform = crooked_castors();
  CastorKinematics body(platform, {}, {0.1, 0.2, 0.3});
  const auto axle = [&] {
    std::vector<double> pivots;
    for (const CastorReading& c : body.reading().castors) pivots.push_back(c.pivot_rad);
    return body.body() * tracked_T_axle(vehicle_of(platform), 2, pivots);
  };
  const Pose before = axle();
  body.move({0.2, 0.1, 0.3, 0.001});
  const Pose moved = between(before, axle());
  EXPECT_GT(moved.x_m, 1e-5);
  EXPECT_NEAR(moved.y_m, 0.5 * moved.x_m * moved.heading_rad, 1e-9);  // the chord of an arc, and nothing sideways
}

TEST(UnitRecordings, FollowTheUnitWithTheTruthsNoiseAndTheRoundingOfTheJoints) {
  LinkedRunSettings s;
  s.truth_m = s.truth_rad = s.wheel_noise = 0.0;
  Clapper actual;
  actual.link_angle_resolution_rad = actual.link_length_resolution_m = 0.0;
  const Recording run = linked_run(actual, s, 1);
  const Vehicle vehicle = vehicle_of(actual);
  const Recording of_b = recording_of_unit(run, unit_samples(run, vehicle), tracked_poses(run), vehicle, 1, 0.0, true);
  const Result<Track> reckoned = predicted_track(of_b, vehicle_of_unit(units_of(vehicle)[1], vehicle));
  ASSERT_TRUE(reckoned);
  const auto error = track_error(*reckoned, truth_track(of_b));
  ASSERT_TRUE(error);
  EXPECT_LT(error->position_rms_m, 3e-4);  // wheels of 2000 counts: 0.24 mm each, and no more
}

// The truth comes as often as the readings and between them: what is made of two of its samples would share each of
// them with the next, and errors that are shared look like less noise than there is.
TEST(UnitRecordings, HaveTheTruthsNoiseFreshInEachSample) {
  LinkedRunSettings s;
  s.truth_m = s.wheel_noise = 0.0;
  s.truth_rad = 0.005;
  Clapper actual;
  actual.link_angle_resolution_rad = actual.link_length_resolution_m = 0.0;
  const Recording run = linked_run(actual, s, 1);
  const Vehicle vehicle = vehicle_of(actual);
  constexpr double kHalfAReading_s = 0.02;
  const Recording of_b =
      recording_of_unit(run, unit_samples(run, vehicle), tracked_poses(run), vehicle, 1, kHalfAReading_s, true);
  const Track truth = truth_track(of_b);
  double squares = 0.0;
  for (std::size_t i = 3; i < truth.size(); ++i) {
    const auto heading = [&](std::size_t back) { return truth[i - back].pose.heading_rad; };
    squares += std::pow(wrapped(heading(0) - 3.0 * heading(1) + 3.0 * heading(2) - heading(3)), 2);
  }
  // Third differences of white noise have 1 + 9 + 9 + 1 times its variance, and the motion next to none; 5 % is three
  // standard errors of 750 of them.
  const double scatter_rad = std::sqrt(squares / 20.0 / static_cast<double>(truth.size() - 3));
  EXPECT_NEAR(scatter_rad, s.truth_rad, 0.15 * s.truth_rad);
}

TEST(GeometryFit, FindsTheOffsetsOfTheLinkAndTheClockOfTheTruth) {
  Clapper actual = crooked_clapper();
  actual.link_angle_a_offset_rad = 0.008;
  actual.link_angle_b_offset_rad = -0.012;
  actual.link_length_offset_m = 0.006;
  std::vector<JoinedRun> runs;
  for (const Recording& r : clapper_runs(actual, {}, 11)) {
    runs.push_back({unit_samples(r, vehicle_of(Clapper{})), tracked_poses(r)});
    for (TimedPose& p : runs.back().tracked) p.time_s += 0.03;
  }
  const GeometryFit fit = fitted_geometry(runs, vehicle_of(Clapper{}));
  for (const JointEstimate& e : fit.joints) {
    Vehicle truth = vehicle_of(actual);
    EXPECT_TRUE(e.determined) << e.parameter.name;
    EXPECT_NEAR(e.value, e.parameter.of(truth), 4.0 * e.stderr_value) << e.parameter.name;
    EXPECT_LT(e.stderr_value, 0.002) << e.parameter.name;
  }
  for (std::size_t r = 0; r < runs.size(); ++r) EXPECT_NEAR(fit.clock_s[r], 0.03, 4.0 * fit.clock_stderr_s[r]);
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
  EXPECT_EQ(of_trailer.verdict, Verdict::nothing_missing) << said(of_trailer);
  EXPECT_EQ(of_castors.verdict, Verdict::nothing_missing) << said(of_castors);
}

TEST(DiagnoseUnits, SayWhichWheelOfWhichTruckAndPredictTheBetterForIt) {
  LinkedRunSettings s;
  s.b_left = [](double, double, double by_rad) { return std::abs(by_rad) > 0.03 ? -0.04 * by_rad : 0.0; };  // 3 rad/s
  const std::vector<Recording> runs = clapper_runs(crooked_clapper(), s, 51);
  const Diagnosis d = diagnosed(runs, Clapper{});
  ASSERT_FALSE(d.findings.empty()) << said(d);
  EXPECT_EQ(d.findings.front().effect, "encoder_missed_counts") << said(d);
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
// What has no name and predicts nothing is a trace of joints that are rounded, where it is small; but dead reckoning
// that is off by three times its noise is off, and "nothing is missing" is no answer.
TEST(LeaveOutTraces, TakesOnlyForATraceWhatLeavesLittle) {
  for (const double off : {1.3, 3.0}) {
    Diagnosis d;
    d.verdict = Verdict::unknown_effect;
    Finding f;
    f.effect = "unknown";
    f.component = "vehicle";
    f.log_likelihood_gain = 800.0;
    d.findings = {f};
    FitFigures floor, calibrated;
    floor.position_rms_m = 0.01, floor.heading_rms_rad = 0.01;
    calibrated.position_rms_m = off * floor.position_rms_m, calibrated.heading_rms_rad = off * floor.heading_rms_rad;
    d.held_out.calibrated = d.held_out.with_findings = d.held_out.spline = calibrated;
    d.held_out.noise_floor = floor;
    leave_out_traces(d, false);
    EXPECT_EQ(d.verdict == Verdict::unknown_effect, off > 2.0) << off;
  }
}

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
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
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
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
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
  EXPECT_EQ(d.verdict, Verdict::nothing_missing) << said(d);
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
  ASSERT_NE(bias, d.findings.end()) << said(d);
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
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
  EXPECT_EQ(d.findings[0].effect, "link_length_bias");
  EXPECT_NEAR(d.findings[0].parameters[0].value, -0.004, 4.0 * d.findings[0].parameters[0].stderr_value);
}

TEST(DiagnoseUnits, FindABiasedPivotAndSayThatToeWouldLookTheSame) {
  MultiCastor actual = crooked_castors();
  actual.castors[1].pivot_encoder_offset_rad = 0.015;
  std::vector<Recording> runs;
  for (std::uint64_t k = 0; k < 3; ++k) runs.push_back(castor_run(actual, {}, 81 + k));
  const Diagnosis d = diagnosed(runs, three_castor_vehicle());
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
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
  EXPECT_EQ(d.verdict, Verdict::nothing_missing) << said(d);
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
  ASSERT_NE(clock, d.findings.end()) << said(d);
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
  ASSERT_FALSE(d.findings.empty()) << said(d);
  EXPECT_EQ(d.findings[0].effect, "encoder_missed_counts") << said(d);
  EXPECT_EQ(d.findings[0].component, "truck_b.left_wheel");
  EXPECT_NEAR(d.findings[0].parameters[0].value, 0.04, 0.006);
  const auto slope = std::find_if(d.not_testable.begin(), d.not_testable.end(),
                                  [](const NotTestable& n) { return n.effect == "floor_slope_creep"; });
  EXPECT_NE(slope, d.not_testable.end());
}

TEST(RoundingFromInside, HidesAPushThatOneCountOfTheOtherTruckMakesThroughTheLink) {
  const Clapper trucks = fine_clapper();  // 0.24 mm a count, 0.7 mrad of its truck, 0.7 mm at the far end of a metre
  const Vehicle vehicle = vehicle_of(trucks);
  const JointRounding rounding = rounding_from_inside(vehicle);
  const VehicleUnit b = units_of(vehicle)[1];
  Finding push;
  push.effect = "collision";
  push.parameters = {
      {"dx_m", 0.0011, 0.0002, "m"}, {"dy_m", 0.0010, 0.0002, "m"}, {"dheading_rad", -0.0015, 3e-4, "rad"}};
  EXPECT_TRUE(may_be_rounding(push, b, rounding));
  push.parameters[2].value = -0.006;
  EXPECT_FALSE(may_be_rounding(push, b, rounding));
  Finding bump;
  bump.effect = "bump";
  bump.parameters = {{"extra_distance_m", 0.0009, 0.0001, "m"}};
  EXPECT_TRUE(may_be_rounding(bump, b, rounding));
  bump.parameters[0].value = 0.004;
  EXPECT_FALSE(may_be_rounding(bump, b, rounding));
}

std::vector<JoinedRun> joined(const std::vector<Recording>& runs, const Vehicle& vehicle) {
  std::vector<JoinedRun> joined;
  for (const Recording& r : runs) joined.push_back({unit_samples(r, vehicle), tracked_poses(r)});
  return joined;
}

void wobble(Recording& run, double amplitude_rad) {
  for (Channel& c : run.channels)
    if (c.name == "link_angle_a_rad")
      for (double& reading : c.values) reading += amplitude_rad * std::sin(3.0 * reading);
}

TEST(ErringJoint, IsTheEncoderThatWobblesAsItTurns) {
  const Clapper trucks = fine_clapper();
  const Vehicle vehicle = vehicle_of(trucks);
  std::vector<Recording> runs = clapper_runs(trucks, {}, 241);
  EXPECT_FALSE(erring_joint(joined(runs, vehicle), {0.0, 0.0, 0.0}, vehicle, 1));
  for (Recording& r : runs) wobble(r, 0.008);
  const std::optional<ErringJoint> erring = erring_joint(joined(runs, vehicle), {0.0, 0.0, 0.0}, vehicle, 1);
  ASSERT_TRUE(erring);
  EXPECT_EQ(erring->joint, 0u);
  EXPECT_LT(erring->size, 0.008);  // root mean square of a wave of 8 mrad
  EXPECT_GT(erring->size, 0.002);
  EXPECT_LT(erring->left_out_ratio, 0.9);
}

TEST(ErringJoint, IsThePivotWhoseEncoderHasPlay) {
  const MultiCastor platform = three_castor_vehicle();
  const Vehicle vehicle = vehicle_of(platform);
  std::vector<Recording> runs;
  for (std::uint64_t k = 0; k < 3; ++k) runs.push_back(castor_run(platform, {}, 251 + k));
  EXPECT_FALSE(erring_joint(joined(runs, vehicle), {0.0, 0.0, 0.0}, vehicle, 1));
  constexpr double kPlay_rad = 0.04;
  for (Recording& r : runs)
    for (Channel& c : r.channels)
      if (c.name == "castor2_pivot_rad") {
        double shown = c.values[0];
        for (double& reading : c.values) {
          shown = std::clamp(shown, reading - 0.5 * kPlay_rad, reading + 0.5 * kPlay_rad);
          reading = shown;
        }
      }
  const std::optional<ErringJoint> erring = erring_joint(joined(runs, vehicle), {0.0, 0.0, 0.0}, vehicle, 1);
  ASSERT_TRUE(erring);
  EXPECT_EQ(erring->joint, 1u);
  EXPECT_NEAR(erring->play, kPlay_rad, 0.25 * kPlay_rad);  // on the way from one side to the other it is neither
}

TEST(DiagnoseUnits, SayThatSomethingIsMissingWhereALinksEncoderWobbles) {
  std::vector<Recording> runs = clapper_runs(fine_clapper(), {}, 261);
  for (Recording& r : runs) wobble(r, 0.008);
  const Diagnosis d = diagnosed(runs, fine_clapper());
  EXPECT_EQ(d.verdict, Verdict::unknown_effect) << said(d);
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.findings[0].effect, "unknown");
  EXPECT_EQ(d.findings[0].component, "truck_a");
  ASSERT_FALSE(d.responses.empty());
  EXPECT_EQ(d.responses[0].variable, "the link angle A [rad]");
}

MultiCastor castors_with_pivots_elsewhere() {
  MultiCastor actual = crooked_castors();
  const double turned[] = {0.0095, 0.0040, 0.0088}, further_m[] = {0.0004, 0.0010, 0.0019};
  for (std::size_t k = 0; k < 3; ++k) {
    actual.castors[k].pivot_angle_rad += turned[k];
    actual.castors[k].pivot_radius_m += further_m[k];
  }
  return actual;
}

TEST(GeometryFit, FindsHowFarPivotsAreApart) {
  const MultiCastor actual = castors_with_pivots_elsewhere();
  std::vector<JoinedRun> runs;
  const Vehicle nominal = vehicle_of(three_castor_vehicle());
  for (std::uint64_t k = 0; k < 3; ++k) {
    const Recording r = castor_run(actual, {}, 271 + k);
    runs.push_back({unit_samples(r, nominal), tracked_poses(r)});
  }
  GeometryFit fit = fitted_geometry(runs, nominal);
  set_most_pivots_right(fit);
  const auto& found = std::get<MultiCastor>(fit.vehicle.kind).castors;
  double variance = 0.0, offset_error_rad = 0.0;  // of a pivot's place along one direction, at most
  for (const JointEstimate& e : fit.joints) {
    const bool radius = e.parameter.name.find("pivot_radius") != std::string::npos,
               angle = e.parameter.name.find("pivot_angle") != std::string::npos;
    const double error_m = radius ? e.stderr_value : angle ? 0.25 * e.stderr_value : 0.0;
    variance = std::max(variance, error_m * error_m);
    if (e.parameter.effect == "pivot_angle_bias") offset_error_rad = std::max(offset_error_rad, e.stderr_value);
  }
  const double error_m = std::sqrt(2.0 * variance);
  const auto apart_m = [](const std::vector<Castor>& castors, std::size_t k) {
    return length(castors[k].pivot() - castors[(k + 1) % castors.size()].pivot());
  };
  double off_in_file_m = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double actual_m = apart_m(actual.castors, k);
    off_in_file_m = std::max(off_in_file_m, std::abs(apart_m(three_castor_vehicle().castors, k) - actual_m));
    EXPECT_NEAR(apart_m(found, k), actual_m, 4.0 * error_m);
    EXPECT_NEAR(found[k].pivot_encoder_offset_rad, 0.0, 4.0 * offset_error_rad);
  }
  EXPECT_LT(4.0 * error_m, off_in_file_m);
}

TEST(DiagnoseUnits, FindNothingWherePivotsStandAFewMillimetresElsewhere) {
  std::vector<Recording> runs;
  for (std::uint64_t k = 0; k < 3; ++k) runs.push_back(castor_run(castors_with_pivots_elsewhere(), {}, 281 + k));
  const Diagnosis d = diagnosed(runs, three_castor_vehicle());
  for (const Finding& f : d.findings) EXPECT_EQ(f.component, "truth") << said(d);
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

TEST(Components, AreOfOneUnitOrOfAll) {
  EXPECT_EQ(component_of_unit("truck_b", "left_wheel"), "truck_b.left_wheel");
  EXPECT_EQ(component_of_unit("castor1", "vehicle"), "castor1");
  EXPECT_EQ(component_of_unit("truck_b", "floor"), "floor");
  EXPECT_EQ(component_of_unit("", "left_wheel"), "left_wheel");
  const std::vector<VehicleUnit> trucks = units_of(vehicle_of(Clapper{}));
  EXPECT_EQ(component_in_unit("truck_b", "truck_b.left_wheel", trucks), "left_wheel");
  EXPECT_EQ(component_in_unit("truck_b", "truck_b", trucks), "vehicle");
  EXPECT_EQ(component_in_unit("truck_b", "truck_a.left_wheel", trucks), std::nullopt);
  EXPECT_EQ(component_in_unit("truck_a", "floor", trucks), "floor");
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
