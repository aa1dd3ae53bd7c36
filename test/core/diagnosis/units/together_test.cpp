#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/outside_truth.h"
#include "core/diagnosis/units/together/joined_model.h"
#include "core/diagnosis/units/together/told_together.h"
#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

// A camera of 10 Hz that errs by a centimetre and a degree.
LinkedRunSettings under_a_coarse_truth() {
  LinkedRunSettings s;
  s.duration_s = 60.0;
  s.truth_m = 0.01;
  s.truth_rad = 0.017;
  return s;
}

std::vector<JoinedRun> joined(const std::vector<Recording>& recordings, const Vehicle& vehicle) {
  std::vector<JoinedRun> runs;
  for (const Recording& r : recordings) runs.push_back({unit_samples(r, vehicle), tracked_poses(r)});
  return runs;
}

// A platform at rest under truths of its heading that err by so much: as the filter has it in the end, and their mean.
struct HeadingAtRest {
  double filtered_rad = 0.0, mean_rad = 0.0;
};
HeadingAtRest heading_at_rest(double truth_rad) {
  const MultiCastor platform = three_castor_vehicle();
  const Vehicle vehicle = vehicle_of(platform);
  CastorKinematics machine(platform, {}, trailing_angles(platform, {0.3, 0.0, 0.0, 1.0}));
  Random random(5);
  JoinedRun run;
  const Recording at_rest = recording_of(std::vector<CastorSample>{machine.reading(), machine.reading()});
  const std::vector<double> joints = unit_samples(at_rest, vehicle).front().joints;
  HeadingAtRest heading;
  constexpr int kTruths = 100, kEach = 10;
  for (int i = 0; i < kTruths * kEach; ++i) {
    UnitSample sample{0.1 * i, std::vector<WheelRotation>(platform.castors.size()), joints};
    for (double& joint : sample.joints) joint += 0.0005 * random.normal();
    run.samples.push_back(std::move(sample));
    if (i % kEach != 0) continue;
    const double heading_rad = truth_rad * random.normal();
    heading.mean_rad += heading_rad / kTruths;
    run.tracked.push_back({0.1 * i, {0.0, 0.0, heading_rad}});
  }
  JoinedFilter filter(run, vehicle, 0.0);
  JoinedNoise noise;
  noise.truth_heading_rad = truth_rad;
  filter.run(noise);
  heading.filtered_rad = (filter.track(0).back().pose * inverse(tracked_T_axle(vehicle, 0, joints))).heading_rad;
  return heading;
}

// At rest the joints are read a thousand times: the heading is known by the mean of what the truth says of it, and by
// nothing else.
TEST(JoinedFilter, LearnsNothingOfTheRoomFromJointsThatAreReadAtRest) {
  const HeadingAtRest heading = heading_at_rest(0.02);
  EXPECT_NEAR(heading.filtered_rad, heading.mean_rad, 0.001);  // the mean itself errs by 0.002
}

TEST(JoinedFilter, LearnsNothingOfTheRoomFromItsJointsUnderATruthOfSixDegrees) {
  const HeadingAtRest heading = heading_at_rest(0.1);
  EXPECT_NEAR(heading.filtered_rad, heading.mean_rad, 0.005);  // the mean itself errs by 0.01
}

// A platform that is turned as one piece, in the middle of a drive, contradicts no joint: however the truth corrects
// the poses before and behind, only the truth may say anything of it.
TEST(JoinedFilter, HasJointsSayNothingOfATurnOfAllUnitsAlike) {
  const MultiCastor platform = three_castor_vehicle();
  const Vehicle vehicle = vehicle_of(platform);
  LinkedRunSettings s = under_a_coarse_truth();
  s.duration_s = 20.0;
  s.truth_rad = 0.05;
  JoinedFilter filter(joined({castor_run(platform, s, 7)}, vehicle).front(), vehicle, 0.0);
  JoinedNoise noise;
  noise.truth_heading_rad = s.truth_rad;
  filter.run(noise);
  JoinedColumn turned = filter.nothing();
  const auto epochs = static_cast<Eigen::Index>(filter.readings() - 1);
  const Eigen::Index at = 1;
  const Pose first = filter.track(0)[static_cast<std::size_t>(at)].pose;
  for (std::size_t u = 0; u < filter.units(); ++u) {
    const Pose unit = filter.track(u)[static_cast<std::size_t>(at)].pose;
    const Vec2 arm = unit.position() - first.position();
    const Vec2 by = rotated({-arm.y_m, arm.x_m}, -unit.heading_rad);
    turned.moved[u] = Eigen::Matrix3Xd::Zero(3, epochs);
    turned.moved[u].col(at) << by.x_m, by.y_m, 1.0;
  }
  const Eigen::MatrixXd column = filter.carried({turned});
  const Eigen::Index rows = filter.rows();
  double of_joints = 0.0, of_truth = 0.0;
  for (Eigen::Index r = 0; r < column.rows(); r += rows) {
    of_joints += column.col(0).segment(r, rows - 3).squaredNorm();
    of_truth += column.col(0).segment(r + rows - 3, 3).squaredNorm();
  }
  // What is left is of second order: 7e-5; 1 to 2 % where what turns the first is not seen to turn what it sees, and 15
  // to 100 % where errors are kept in the room.
  EXPECT_LT(of_joints, 0.001 * of_truth);
}

// What a filter leaves where the file has a number a little more is the number's column; noise that the whitened
// numbers share with it had moved the truth's mounting and clock by 6 mm and 14 ms (a platform of another program).
TEST(JoinedFilter, LeavesWhatALengthsColumnSays) {
  MultiCastor platform = three_castor_vehicle();
  platform.wheel_encoder_resolution_rad = 0.02;
  LinkedRunSettings s = under_a_coarse_truth();
  s.duration_s = 30.0;
  const JoinedRun run = joined({castor_run(platform, s, 8)}, vehicle_of(platform)).front();
  const JoinedNoise noise;
  const auto left_by = [&](const Vehicle& v) {
    JoinedFilter filter(run, v, 0.0);
    filter.run(noise);
    return Eigen::VectorXd(filter.residual());
  };
  const Vehicle vehicle = vehicle_of(platform);
  JoinedFilter filter(run, vehicle, 0.0);
  filter.run(noise);
  const auto castor = [](Vehicle& v) -> Castor& { return std::get<MultiCastor>(v.kind).castors[1]; };
  const std::vector<std::function<void(Vehicle&, double)>> lengths = {
      [](Vehicle& v, double by) { v.truth.axle_T_tracked.x_m += by; },
      [](Vehicle& v, double by) { v.truth.axle_T_tracked.y_m += by; },
      [&](Vehicle& v, double by) { castor(v).offset_m += by; },
      [&](Vehicle& v, double by) { castor(v).pivot_encoder_offset_rad += by; }};
  for (const auto& add : lengths) {
    constexpr double kStep = 1e-5;
    Vehicle more = vehicle;
    add(more, kStep);
    const Eigen::VectorXd numeric = (left_by(vehicle) - left_by(more)) / kStep;
    const Eigen::VectorXd column = filter.carried({filter.by_length(add)}).col(0);
    // What is left is how the filter's gains change: a tenth of it in size, of the mounting.
    EXPECT_NEAR(column.dot(numeric), column.squaredNorm(), 0.01 * column.squaredNorm());
    EXPECT_LT((column - numeric).norm(), 0.15 * column.norm());
  }
}

// The score of a sudden motion, gathered backward, is the product of its column, carried forward, with what is left.
TEST(JoinedFilter, GathersTheScoreOfEachMomentAsItsColumnCarriesIt) {
  const Clapper trucks;
  const Vehicle vehicle = vehicle_of(trucks);
  LinkedRunSettings s = under_a_coarse_truth();
  s.duration_s = 10.0;
  JoinedFilter filter(joined({linked_run(trucks, s, 3)}, vehicle).front(), vehicle, 0.0);
  filter.run({});
  const std::vector<JoinedFilter::Impact> impacts = filter.impacts(filter.residual());
  for (const std::size_t epoch : {std::size_t{20}, impacts.size() / 2}) {
    JoinedColumn column = filter.nothing();
    column.moved[1] = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(impacts.size()));
    column.moved[1](2, static_cast<Eigen::Index>(epoch)) = 1.0;  // truck B turns
    const Eigen::VectorXd z = filter.carried({column}).col(0);
    const JoinedFilter::Impact& at = impacts[epoch];
    EXPECT_NEAR(at.score[5], z.dot(filter.residual()), 1e-9 * z.norm() * filter.residual().norm());
    EXPECT_NEAR(at.information(5, 5), z.squaredNorm(), 1e-9 * z.squaredNorm());
  }
}

// A trailer on a circle holds one angle, which its encoder rounds: by up to half a step, however often it is read.
TEST(JoinedModel, KnowsAnAngleThatIsHeldNoBetterThanItsEncoderRounds) {
  constexpr double kSpeed_mps = 0.3, kRate_radps = 0.15;
  const SmartEncoderTrailer train;
  const double hitch_rad = std::asin(kRate_radps * train.drawbar_length_m / kSpeed_mps);
  const double step_rad = train.hitch_angle_resolution_rad;
  JoinedRun run;
  for (int i = 0; i < 2000; ++i) {
    const double time_s = 0.04 * i;
    run.samples.push_back(
        {time_s,
         {wheel_rotation(train.tow, kSpeed_mps * time_s, kRate_radps * time_s),
          wheel_rotation(train.trailer, kSpeed_mps * std::cos(hitch_rad) * time_s, kRate_radps * time_s)},
         {step_rad * std::round(hitch_rad / step_rad)}});
  }
  const JoinedModel model({run}, vehicle_of(train), {}, {"circle"});
  const auto offset = model.length("hitch_angle_offset_rad");
  ASSERT_TRUE(offset);
  EXPECT_GT(offset->stderr_value, 0.25 * step_rad);  // evenly spread over a step: 0.29
}

// Truck B's left wheel is out of round by a quarter of a percent: 0.19 mm to either side of a truth that errs by 10 mm.
TEST(DiagnoseTogether, NamesAnOvalWheelOfATruckUnderATruthThatErrsFiftyTimesAsMuch) {
  constexpr double kAmplitude = 0.0025;
  LinkedRunSettings s = under_a_coarse_truth();
  s.b_left = [](double, double rotation_rad, double by_rad) { return kAmplitude * std::cos(rotation_rad) * by_rad; };
  const Clapper trucks = fine_clapper();
  const std::vector<Recording> runs = {linked_run(trucks, s, 301), linked_run(trucks, s, 302),
                                       linked_run(trucks, s, 303)};
  const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(trucks));
  ASSERT_TRUE(d);
  ASSERT_FALSE(d->findings.empty());
  EXPECT_EQ(d->verdict, Verdict::found);
  EXPECT_EQ(d->findings[0].effect, "wheel_eccentricity");
  EXPECT_EQ(d->findings[0].component, "truck_b.left_wheel");
  const FoundParameter& amplitude = d->findings[0].parameters[0];
  EXPECT_NEAR(amplitude.value, kAmplitude, 3.0 * amplitude.stderr_value);
  EXPECT_LT(amplitude.stderr_value, 0.2 * kAmplitude);
  // What is said of everything that was asked for says the same.
  const auto asked = std::find_if(d->asked.begin(), d->asked.end(),
                                  [](const AskedEffect& a) { return a.effect == "wheel_eccentricity"; });
  ASSERT_NE(asked, d->asked.end());
  EXPECT_TRUE(asked->named);
  EXPECT_EQ(asked->component, "truck_b.left_wheel");
  EXPECT_DOUBLE_EQ(asked->log_likelihood_gain, d->findings[0].log_likelihood_gain);
  for (const NotTestable& n : d->not_testable) EXPECT_NE(n.effect, "wheel_eccentricity");
  EXPECT_NEAR(d->findings[0].gathered.gain.back(), d->findings[0].log_likelihood_gain,
              1e-6 * d->findings[0].log_likelihood_gain);  // priors take a little
  EXPECT_EQ(d->findings[0].gathered.begins.size(), runs.size());
  EXPECT_GT(d->calibration.noise.wheel_m_per_sqrt_m, 0.0);
}

// 18 um to either side on a wheel of 75 mm, which the trucks' joints show under a camera of a centimetre.
TEST(DiagnoseTogether, TakesAWheelThatIsAsRoundAsAnyForNoFinding) {
  constexpr double kAmplitude = 0.00024;
  LinkedRunSettings s = under_a_coarse_truth();
  s.wheel_noise = 3e-5;
  s.b_left = [](double, double rotation_rad, double by_rad) { return kAmplitude * std::cos(rotation_rad) * by_rad; };
  const Clapper trucks = fine_clapper();
  const std::vector<Recording> runs = {linked_run(trucks, s, 304), linked_run(trucks, s, 305),
                                       linked_run(trucks, s, 306)};
  const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(trucks));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::nothing_missing);
  EXPECT_TRUE(d->findings.empty()) << d->findings.front().effect;
  EXPECT_TRUE(std::any_of(d->warnings.begin(), d->warnings.end(), [](const std::string& said) {
    return said.find("wheel eccentricity of the left wheel of truck B") != std::string::npos;
  }));
}

// The wheel once counts 6 mm too much, at 22 s of the second run.
TEST(DiagnoseTogether, FeelsABumpUnderATruthThatErrsByMore) {
  const LinkedRunSettings even = under_a_coarse_truth();
  LinkedRunSettings bumped = even;
  constexpr double kAt_s = 22.0, kLasts_s = 0.1, kExtra_m = 0.006;
  const Clapper trucks = fine_clapper();
  bumped.b_left = [&](double time_s, double, double) {
    return std::abs(time_s - kAt_s) < 0.5 * kLasts_s
               ? kExtra_m / trucks.truck_b.wheel_radius_left_m * bumped.step_s / kLasts_s
               : 0.0;
  };
  const std::vector<Recording> runs = {linked_run(trucks, even, 311), linked_run(trucks, bumped, 312),
                                       linked_run(trucks, even, 313)};
  const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(trucks));
  ASSERT_TRUE(d);
  ASSERT_EQ(d->findings.size(), 1u);
  const Finding& f = d->findings[0];
  EXPECT_EQ(f.effect, "bump");
  EXPECT_EQ(f.component, "truck_b.left_wheel");
  EXPECT_EQ(f.where.recording, runs[1].name);
  for (const FoundParameter& p : f.parameters) {
    if (p.name == "at_s") {
      EXPECT_NEAR(p.value, kAt_s, 0.2);
    }
    if (p.name == "extra_distance_m") {
      EXPECT_NEAR(p.value, kExtra_m, 4.0 * p.stderr_value);
    }
  }
}

// The truth as if the vehicle had been pushed before one of its samples, until another.
void move_truth(Recording& run, std::size_t from_sample, std::size_t to_sample, const Pose& push) {
  const std::vector<TruthSample> truth = truth_samples(run);
  ASSERT_GT(truth.size(), from_sample);
  const Pose from{truth[from_sample].position.x_m, truth[from_sample].position.y_m, *truth[from_sample].heading_rad};
  const Pose to{from.x_m + push.x_m, from.y_m + push.y_m, from.heading_rad + push.heading_rad};
  const std::size_t n = run.channels.size();
  for (std::size_t i = 0, k = 0; i < run.time_s.size(); ++i) {
    if (std::isnan(run.channels[n - 3].values[i])) continue;
    if (k++ < from_sample || k > to_sample) continue;
    const Pose was{run.channels[n - 3].values[i], run.channels[n - 2].values[i], run.channels[n - 1].values[i]};
    const Pose is = to * between(from, was);
    run.channels[n - 3].values[i] = is.x_m;
    run.channels[n - 2].values[i] = is.y_m;
    run.channels[n - 1].values[i] = was.heading_rad + push.heading_rad;
  }
}

// Half a metre aside and a sixth of a turn, under a camera of 15 mm: thirty times its error, and no outlier.
TEST(DiagnoseTogether, SayThatAVehicleWasPushedByMoreThanItsTruthErrs) {
  constexpr std::size_t kAt = 700, kOnAndOn = 1000000;
  const Pose push{0.3, 0.4, 0.5};
  const LinkedRunSettings s = under_a_coarse_truth();
  const Clapper trucks = fine_clapper();
  std::vector<Recording> runs = {linked_run(trucks, s, 321), linked_run(trucks, s, 322), linked_run(trucks, s, 323)};
  Recording& pushed = runs[1];
  move_truth(pushed, kAt, kOnAndOn, push);
  const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(trucks));
  ASSERT_TRUE(d);
  ASSERT_EQ(d->findings.size(), 1u);
  EXPECT_EQ(d->findings[0].effect, "collision");
  EXPECT_EQ(d->findings[0].component, "vehicle");
  EXPECT_EQ(d->findings[0].where.recording, pushed.name);
  const double values[] = {push.x_m, push.y_m, push.heading_rad};
  for (std::size_t k = 0; k < 3; ++k) {
    const FoundParameter& p = d->findings[0].parameters[k];
    EXPECT_NEAR(p.value, values[k], 4.0 * p.stderr_value) << p.name;
    EXPECT_LT(p.stderr_value, 0.1) << p.name;
  }
}

// A camera that has a tag elsewhere by where it looks, to 30 mm: what all units tell together has no word for it, and
// the one that carries the tag has.
TEST(DiagnoseTogether, LeaveATruthThatIsBentToTheUnitThatCarriesIt) {
  constexpr double kBent_m = 0.03;
  const Clapper trucks = fine_clapper();
  std::vector<Recording> runs;
  for (const std::uint64_t seed : {331u, 332u, 333u}) {
    Recording run = linked_run(trucks, under_a_coarse_truth(), seed);
    Channel* const truth = &run.channels[run.channels.size() - 3];  // x, y, heading
    for (std::size_t i = 0; i < run.time_s.size(); ++i) {
      const double heading_rad = truth[2].values[i];
      truth[0].values[i] += kBent_m * std::sin(3.0 * heading_rad);
      truth[1].values[i] += kBent_m * std::cos(2.0 * heading_rad);
    }
    runs.push_back(std::move(run));
  }
  const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(trucks));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  ASSERT_FALSE(d->findings.empty());
  EXPECT_EQ(d->findings[0].component, "truth");
}

// Of a wheel that slips by 2 % at random, a fifth of a second on end, the scores of all that lasts scatter by more than
// white noise makes: a push, two patches of floor and a load, once.
TEST(DiagnoseTogether, HaveNoNameForAWheelThatSlipsOnAsItDidJustNow) {
  constexpr double kSlip = 0.02, kOn_s = 0.2;
  LinkedRunSettings s = under_a_coarse_truth();
  s.truth_m = 0.015;
  s.truth_rad = 0.01;
  Random random(3528);
  double slip = 0.0;
  s.b_left = [&](double, double, double by_rad) {
    const double kept = std::exp(-s.step_s / kOn_s);
    slip = kept * slip + std::sqrt(1.0 - kept * kept) * kSlip * random.normal();
    return slip * by_rad;
  };
  const Clapper trucks = fine_clapper();
  std::vector<Recording> runs;
  for (const std::uint64_t seed : {5040u, 5041u, 5042u}) runs.push_back(linked_run(trucks, s, seed));
  const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(trucks));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  ASSERT_EQ(d->findings.size(), 1u);
  EXPECT_EQ(d->findings[0].component, "truck_b");
}

// A tracker that takes another marker for its own for a second and a half, and finds it again.
TEST(DiagnoseTogether, TakeATruthThatComesBackForNoPush) {
  const LinkedRunSettings s = under_a_coarse_truth();
  const Clapper trucks = fine_clapper();
  std::vector<Recording> runs = {linked_run(trucks, s, 321), linked_run(trucks, s, 322), linked_run(trucks, s, 323)};
  move_truth(runs[1], 700, 738, {0.3, 0.4, 0.5});
  const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(trucks));
  ASSERT_TRUE(d);
  EXPECT_TRUE(d->findings.empty()) << d->findings.front().effect;
}

// However true it is: in half a metre each unit by itself has a sample or two. A platform of another program, under
// motion capture once a second, had a pivot's bias of 2.3 mrad with 12 standard errors and nothing missing.
TEST(ToldTogether, IsWhatAMillimetreOnceASecondShowsAndNotWhatItShowsOften) {
  const Clapper trucks = fine_clapper();
  const Vehicle vehicle = vehicle_of(trucks);
  const std::vector<JoinedRun> often = joined({linked_run(trucks, {}, 880), linked_run(trucks, {}, 881)}, vehicle);
  std::vector<JoinedRun> seldom = often;
  for (JoinedRun& run : seldom) {
    Track each_second;
    for (const TimedPose& t : run.tracked)
      if (each_second.empty() || t.time_s > each_second.back().time_s + 0.99) each_second.push_back(t);
    run.tracked = each_second;
  }
  EXPECT_FALSE(told_together(often, vehicle, {}, {"a", "b"}, 0.02, {}));
  EXPECT_TRUE(told_together(seldom, vehicle, {}, {"a", "b"}, 0.02, {}));
}

}  // namespace
}  // namespace odolab::test
