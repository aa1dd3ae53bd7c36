// What lies between the units: the encoders of joints, the truth's mounting on a vehicle that tows, pushes of the
// whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/heading_of_way.h"
#include "core/diagnosis/units/joint_errors.h"
#include "core/diagnosis/units/merged_findings.h"
#include "core/diagnosis/units/unit_recordings.h"
#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

EncoderTrailer trailer_with_a_fine_hitch() {
  EncoderTrailer train;
  train.hitch_angle_resolution_rad = 0.0005;
  return train;
}

std::vector<Recording> trailer_runs(const EncoderTrailer& actual, std::uint64_t seed) {
  std::vector<Recording> runs;
  for (std::uint64_t k = 0; k < 4; ++k) {
    runs.push_back(trailer_run(actual, {}, seed + k));
    runs.back().name = "run_" + std::to_string(k + 1) + ".csv";
  }
  return runs;
}

// Four runs, of which every third sample of the truth is left: some eight a second.
std::vector<Recording> under_a_slow_camera(const Clapper& actual, const LinkedRunSettings& settings,
                                           std::uint64_t seed) {
  std::vector<Recording> runs;
  for (std::uint64_t k = 0; k < 4; ++k) {
    runs.push_back(linked_run(actual, settings, seed + k));
    runs.back().name = "run_" + std::to_string(k + 1) + ".csv";
    for (Channel& c : runs.back().channels)
      if (c.name.rfind("truth_", 0) == 0)
        for (std::size_t row = 0; row < c.values.size(); ++row)
          if (row % 3 != 0) c.values[row] = std::nan("");
  }
  return runs;
}

void turn_truth(std::vector<Recording>& runs, double by_rad) {
  for (Recording& r : runs)
    for (Channel& c : r.channels)
      if (c.name == "truth_heading_rad")
        for (double& heading : c.values) heading += by_rad;
}

void wobble_each(std::vector<Recording>& runs, double amplitude_rad) {
  for (Recording& r : runs)
    for (Channel& c : r.channels)
      if (c.name == "hitch_angle_rad")
        for (double& reading : c.values) reading += amplitude_rad * std::sin(3.0 * reading);
}

TEST(JointErrors, OfAHitchThatWobblesByFourMilliradiansHaveNoNameAndAShape) {
  std::vector<Recording> runs = trailer_runs(trailer_with_a_fine_hitch(), 311);
  EXPECT_EQ(diagnose(runs, {}, vehicle_of(trailer_with_a_fine_hitch()))->verdict, Verdict::nothing_missing);
  constexpr double kWobble_rad = 0.004;
  wobble_each(runs, kWobble_rad);
  const Diagnosis d = diagnose(runs, {}, vehicle_of(trailer_with_a_fine_hitch())).value();
  ASSERT_EQ(d.verdict, Verdict::unknown_effect);
  EXPECT_EQ(d.findings.front().component, "trailer");
  EXPECT_NE(d.findings.front().where.regime.find("what it reads"), std::string::npos);
  ASSERT_FALSE(d.responses.empty());
  const Response& shape = d.responses.front();
  ASSERT_EQ(shape.variable, "the hitch angle [rad]");
  // The wave that was put in, but for what a constant takes of it, which is a bias, and a slope, which is the
  // drawbar's: half of the points within the band that nineteen in twenty should be in where nothing had been taken.
  int inside = 0;
  for (std::size_t i = 0; i < shape.at.size(); ++i) {
    const double put_in = kWobble_rad * std::sin(3.0 * shape.at[i]);
    inside += shape.low[i] - 0.5 * kWobble_rad < put_in && put_in < shape.high[i] + 0.5 * kWobble_rad;
  }
  EXPECT_GT(2 * inside, static_cast<int>(shape.at.size()));
}

TEST(HeadingOfWay, TellsHowATruthIsTurnedOnAVehicleWhoseWheelsSayNothing) {
  // A point 0.2 m ahead of the axle and 0.1 m to its left, on straights and wide bends, forward and in reverse.
  constexpr double kTurned_rad = 0.031;
  Random random(5);
  std::vector<Track> tracked;
  for (int run = 0; run < 4; ++run) {
    Track track;
    Pose axle{0.0, 0.0, random.uniform(-3.0, 3.0)};
    for (int i = 0; i < 1500; ++i) {
      const double t = 0.02 * i, speed = run == 3 ? -0.4 : 0.5, rate = 0.06 * std::sin(0.3 * t + run);
      axle = axle * Pose{0.02 * speed, 0.0, 0.02 * rate};
      const Pose seen = axle * Pose{0.2, 0.1, kTurned_rad};
      track.push_back({t,
                       {seen.x_m + 0.003 * random.normal(), seen.y_m + 0.003 * random.normal(),
                        seen.heading_rad + 0.004 * random.normal()}});
    }
    tracked.push_back(track);
  }
  const std::optional<HeadingOfWay> found = heading_of_way(tracked);
  ASSERT_TRUE(found);
  EXPECT_LT(found->stderr_rad, 0.001);  // 3 mm over a metre are 3 mrad at most, and there are fifty metres
  EXPECT_NEAR(found->mounting_rad, kTurned_rad, 4.0 * found->stderr_rad);
  EXPECT_FALSE(heading_of_way({Track(tracked[0].begin(), tracked[0].begin() + 300)}));  // three metres
}

TEST(DiagnoseUnits, TakeATruthThatIsTurnedOnATowForNoBiasOfTheHitch) {
  std::vector<Recording> runs = trailer_runs(trailer_with_a_fine_hitch(), 411);
  turn_truth(runs, 0.03);
  const Diagnosis d = diagnose(runs, {}, vehicle_of(trailer_with_a_fine_hitch())).value();
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].effect, "truth_mounting_offset");
  const auto heading = std::find_if(d.findings[0].parameters.begin(), d.findings[0].parameters.end(),
                                    [](const FoundParameter& p) { return p.name == "heading_rad"; });
  ASSERT_NE(heading, d.findings[0].parameters.end());
  EXPECT_NEAR(heading->value, 0.03, 4.0 * heading->stderr_value);
}

// A camera of eight samples a second, 15 mm and two degrees tells nothing of how long the link is; both trucks know it.
TEST(DiagnoseUnits, NameABiasOfTheLinksLengthOfWhichTheTruthTellsNothing) {
  const Clapper file = fine_clapper();
  Clapper actual = file;
  constexpr double kBias_m = -0.015;
  actual.link_length_offset_m = kBias_m;
  LinkedRunSettings settings;
  settings.duration_s = 60.0;
  settings.truth_m = 0.015;
  settings.truth_rad = 0.035;
  const Diagnosis d = diagnose(under_a_slow_camera(actual, settings, 331), {}, vehicle_of(file)).value();
  const auto bias = std::find_if(d.findings.begin(), d.findings.end(),
                                 [](const Finding& f) { return f.effect == "link_length_bias"; });
  ASSERT_NE(bias, d.findings.end());
  EXPECT_NEAR(bias->parameters[0].value, kBias_m, 4.0 * bias->parameters[0].stderr_value);
}

// Under that camera an oval wheel of a third of a per cent is a twentieth of a sample's error; the other truck sees it.
TEST(DiagnoseUnits, NameWhatOneTruckDoesThatTheOtherSeesBetterThanACoarseTruth) {
  const Clapper file = fine_clapper();
  constexpr double kAmplitude = 0.003;
  for (const double amplitude : {0.0, kAmplitude}) {
    LinkedRunSettings settings;
    settings.duration_s = 60.0;
    settings.truth_m = 0.015;
    settings.truth_rad = 0.02;
    settings.b_left = [amplitude](double, double rotation_rad, double by_rad) {
      return amplitude * std::sin(rotation_rad) * by_rad;
    };
    const Diagnosis d = diagnose(under_a_slow_camera(file, settings, 341), {}, vehicle_of(file)).value();
    if (amplitude == 0.0) {
      EXPECT_EQ(d.verdict, Verdict::nothing_missing);
      continue;
    }
    ASSERT_EQ(d.findings.size(), 1u);
    EXPECT_EQ(d.findings[0].effect, "wheel_eccentricity");
    EXPECT_EQ(d.findings[0].component, "truck_b.left_wheel");
    EXPECT_NEAR(d.findings[0].parameters[0].value, kAmplitude, 4.0 * d.findings[0].parameters[0].stderr_value);
    for (const NotTestable& n : d.not_testable) EXPECT_NE(n.effect, "wheel_eccentricity");
  }
}

TEST(DiagnoseUnits, FindATruthThatFreezesThoughNoCastorCarriesIt) {
  std::vector<Recording> runs;
  for (std::uint64_t k = 0; k < 3; ++k) {
    runs.push_back(castor_run(three_castor_vehicle(), {}, 331 + k));
    runs.back().name = "run_" + std::to_string(k + 1) + ".csv";
  }
  constexpr std::size_t kFrom = 300, kTo = 312;
  for (Channel& c : runs[1].channels)
    if (c.name.rfind("truth_", 0) == 0) std::fill(c.values.begin() + kFrom, c.values.begin() + kTo, c.values[kFrom]);
  const Diagnosis d = diagnose(runs, {}, vehicle_of(three_castor_vehicle())).value();
  ASSERT_EQ(d.findings.size(), 1u);
  EXPECT_EQ(d.findings[0].effect, "truth_frozen");
  EXPECT_EQ(d.findings[0].where.recording, "run_2.csv");
  ASSERT_EQ(d.findings[0].where.time_s.size(), 1u);
  EXPECT_EQ(d.findings[0].where.time_s[0].first, runs[1].time_s[kFrom]);
  EXPECT_EQ(d.findings[0].where.time_s[0].second, runs[1].time_s[kTo - 1]);
}

TEST(PutPushesTogether, IsOnePushOfTheVehicleAsTheTruckWithTheTruthFeltIt) {
  Finding a, b, later;
  a.effect = b.effect = later.effect = "collision";
  a.component = "truck_a", b.component = "truck_b", later.component = "truck_b";
  a.where.recording = b.where.recording = later.where.recording = "run_1.csv";
  a.parameters = {{"dx_m", 0.01, 0.001, "m"}, {"at_s", 10.20, 0.05, "s"}};
  b.parameters = {{"dx_m", -0.02, 0.001, "m"}, {"at_s", 10.29, 0.05, "s"}};
  later.parameters = {{"dx_m", 0.03, 0.001, "m"}, {"at_s", 20.0, 0.05, "s"}};
  a.log_likelihood_gain = 10.0, b.log_likelihood_gain = 40.0, later.log_likelihood_gain = 30.0;
  std::vector<Finding> all = {b, a, later};
  put_pushes_together(all, units_of(vehicle_of(Clapper{})));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].component, "vehicle");
  EXPECT_EQ(all[0].parameters[0].value, 0.01);
  EXPECT_EQ(all[0].log_likelihood_gain, 50.0);
  EXPECT_EQ(all[1].component, "truck_b");
}

// What the geometry made of chance, the unit's own fit takes back.
TEST(AddBiases, SayTheSumOfWhatGeometryAndUnitSay) {
  const Vehicle vehicle = vehicle_of(EncoderTrailer{});
  GeometryFit geometry;
  for (const JointParameter& p : joint_parameters(vehicle))
    if (p.name == "hitch_angle_offset_rad") geometry.joints.push_back({p, 0.0, 0.0032, 0.0014, true});
  ASSERT_EQ(geometry.joints.size(), 1u);
  const auto left_by_unit = [](double bias_rad) {
    Finding f;
    f.effect = "link_angle_bias";
    f.component = "trailer";
    f.parameters = {{"bias_rad", bias_rad, 0.0005, "rad"}};
    return f;
  };
  std::vector<Finding> all = {left_by_unit(-0.0035)};
  add_biases(geometry, units_of(vehicle), all);
  EXPECT_TRUE(all.empty());
  all = {left_by_unit(0.02)};
  add_biases(geometry, units_of(vehicle), all);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all[0].parameters[0].value, 0.0232, 1e-12);
}

// A tracker that repeats itself does so in each recording by itself.
TEST(AddFindings, KeepsWhatIsWrongWithEachRecordingApart) {
  Diagnosis of_truck;
  for (const char* name : {"run_1.csv", "run_2.csv"}) {
    Finding f;
    f.effect = "truth_frozen";
    f.component = "truth";
    f.where.recording = name;
    f.where.time_s = {{10.0, 11.0}};
    of_truck.findings.push_back(f);
  }
  std::vector<Finding> all;
  add_findings_of(of_truck, units_of(vehicle_of(Clapper{}))[0], {}, all);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[1].where.recording, "run_2.csv");
}

// Whether anything is asked of the link's length as it is read.
bool is_asked_of_the_length(double wheel_noise) {
  const Clapper trucks = fine_clapper();
  LinkedRunSettings settings;
  settings.wheel_noise = wheel_noise;
  std::vector<std::vector<UnitSample>> samples;
  std::vector<std::string> names;
  for (std::uint64_t k = 0; k < 2; ++k) {
    samples.push_back(unit_samples(linked_run(trucks, settings, 870 + k), vehicle_of(trucks)));
    names.push_back("run_" + std::to_string(k));
  }
  const auto errors = joint_errors(samples, names, vehicle_of(trucks), 1);
  return std::any_of(errors->begin(), errors->end(), [](const TruthError& e) { return e.is_of_a_length; });
}

// Where what wheels slip alone moves a link in and out, its readings go with what the wheels err by: three CLAPPERs and
// OmniMates of another program had an encoder that "errs with what it reads", with gains of 16 to 294.
TEST(JointErrors, AreNotAskedOfALengthThatSlipAloneMoves) {
  EXPECT_TRUE(is_asked_of_the_length(1e-4));
  EXPECT_FALSE(is_asked_of_the_length(0.02));
}

}  // namespace
}  // namespace odolab::test
