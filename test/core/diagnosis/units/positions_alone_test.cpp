// Linked and castor vehicles whose truth has places and no headings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/outside_truth.h"
#include "core/diagnosis/units/together/joined_model.h"
#include "test/support/known_lengths.h"
#include "test/support/linked_runs.h"

namespace odolab::test {
namespace {

// A total station that errs by five millimetres.
LinkedRunSettings under_a_total_station() {
  LinkedRunSettings s;
  s.duration_s = 60.0;
  s.truth_m = 0.005;
  return s;
}

std::vector<Recording> positions_alone(std::vector<Recording> runs) {
  for (Recording& r : runs) std::erase_if(r.channels, [](const Channel& c) { return c.name == "truth_heading_rad"; });
  return runs;
}

TEST(JoinedFilter, FindsItsHeadingByPositionsAlone) {
  const Clapper trucks = fine_clapper();
  const Vehicle vehicle = vehicle_of(trucks);
  LinkedRunSettings s = under_a_total_station();
  s.wheel_noise = 1e-4;
  const Recording with_headings = linked_run(trucks, s, 410);
  JoinedRun run{unit_samples(with_headings, vehicle), tracked_positions(with_headings), false};
  constexpr double kTurned_rad = 2.0;  // the room's axes are anywhere
  for (TimedPose& t : run.tracked) {
    const Vec2 turned = rotated(t.pose.position(), kTurned_rad);
    t.pose = {turned.x_m, turned.y_m, 0.0};
  }
  JoinedFilter filter(run, vehicle, 0.0);
  filter.run({});
  const Track by_filter = filter.track(0);
  const double actual_rad = truth_samples(with_headings).back().heading_rad.value() + kTurned_rad;
  // Five millimetres over the metres of a drive; the recording's own headings err by 2 mrad.
  EXPECT_NEAR(wrapped(by_filter.back().pose.heading_rad - actual_rad), 0.0, 0.012);
}

// Standing still, however long: a trailer's axle is half a metre behind the point that is seen, and whichever way it
// looks that point is where it is. By the axle's own place each sample seemed to tell a little of the heading, which
// was believed when the drive began: a push of 16 and 31 mm where nothing was.
TEST(JoinedFilter, IsToldNoHeadingByPlacesAtRest) {
  const EncoderTrailer train;
  const Vehicle vehicle = vehicle_of(train);
  LinkedRunSettings s;
  s.truth_m = 0.001;
  const Recording read = trailer_run(train, s, 420);
  constexpr int kStood = 100;
  JoinedRun run{unit_samples(read, vehicle), tracked_positions(read), false};
  Random random(420);
  const double period_s = run.samples[1].time_s - run.samples[0].time_s;
  const UnitSample first = run.samples.front();
  const Pose stood = run.tracked.front().pose;
  for (int i = 1; i <= kStood; ++i) {
    UnitSample sample = first;
    sample.time_s = first.time_s - period_s * i;
    run.samples.insert(run.samples.begin(), sample);
    run.tracked.insert(
        run.tracked.begin(),
        {sample.time_s, {stood.x_m + 0.001 * random.normal(), stood.y_m + 0.001 * random.normal(), 0.0}});
  }
  JoinedFilter filter(run, vehicle, 0.0);
  JoinedNoise noise;
  noise.truth_position_m = 0.001;
  filter.run(noise);
  const Track track = filter.track(0);
  const auto rests_to =
      std::find_if(track.begin(), track.end(), [&](const TimedPose& t) { return t.time_s > first.time_s; });
  ASSERT_GT(rests_to - track.begin(), kStood - 1);
  for (auto t = track.begin(); t != rests_to; ++t)
    EXPECT_NEAR(t->pose.heading_rad, track.front().pose.heading_rad, 1e-3) << t->time_s;
}

// One sample in twenty is a metre off, the first among them.
TEST(JoinedFilter, FindsItsHeadingThoughARadioIsAMetreOffNowAndThen) {
  const Clapper trucks = fine_clapper();
  const Vehicle vehicle = vehicle_of(trucks);
  const Recording read = linked_run(trucks, under_a_total_station(), 415);
  JoinedRun run{unit_samples(read, vehicle), tracked_positions(read), false};
  Random random(415);
  for (std::size_t i = 0; i < run.tracked.size(); i += 20)
    run.tracked[i].pose = {run.tracked[i].pose.x_m + random.normal(), run.tracked[i].pose.y_m + random.normal(), 0.0};
  JoinedFilter filter(run, vehicle, 0.0);
  JoinedNoise noise;
  noise.truth_position_m = 0.005;
  filter.run(noise);
  const double actual_rad = truth_samples(read).back().heading_rad.value();
  EXPECT_NEAR(wrapped(filter.track(0).back().pose.heading_rad - actual_rad), 0.0, 0.012);  // as without them
}

// Satellites: 5 mm of each sample by itself, and a frame that is off by 12 mm and forgets it in 30 s.
TEST(JoinedModel, KnowsATruthWhoseFrameWanders) {
  constexpr double kFrame_m = 0.012, kLasts_s = 30.0;
  const Clapper trucks = fine_clapper();
  const auto noise_under = [&](double frame_m) {
    std::vector<JoinedRun> runs;
    Random random(416);
    for (std::uint64_t k = 0; k < 2; ++k) {
      const Recording read = linked_run(trucks, under_a_total_station(), 416 + k);
      runs.push_back({unit_samples(read, vehicle_of(trucks)), tracked_positions(read), false});
      Vec2 frame{frame_m * random.normal(), frame_m * random.normal()};
      double last_s = 0.0;
      for (TimedPose& t : runs.back().tracked) {
        const double kept = std::exp(-(t.time_s - last_s) / kLasts_s), anew = frame_m * std::sqrt(1.0 - kept * kept);
        frame = kept * frame + Vec2{anew * random.normal(), anew * random.normal()};
        last_s = t.time_s;
        t.pose = {t.pose.x_m + frame.x_m, t.pose.y_m + frame.y_m, 0.0};
      }
    }
    JoinedModel model(runs, vehicle_of(trucks), {}, {"1", "2"});
    model.fit_all();
    return model.noise();
  };
  const JoinedNoise still = noise_under(0.0), wandering = noise_under(kFrame_m);
  EXPECT_EQ(still.wander_m_per_sqrt_s, 0.0);
  EXPECT_NEAR(wandering.truth_position_m, 0.005, 0.0008);  // a step of the search is 15 %
  EXPECT_NEAR(wandering.wander_m_per_sqrt_s / (kFrame_m * std::sqrt(2.0 / kLasts_s)), 1.0, 0.3);
}

// How far tracks are from where the truck was, root mean square.
double off_m(const Track& track, const Recording& actual) {
  const Track way = tracked_poses(actual);
  double squares_m2 = 0.0;
  for (const TimedPose& t : track) {
    const Vec2 off = t.pose.position() - pose_at(way, t.time_s)->position();
    squares_m2 += dot(off, off) / static_cast<double>(track.size());
  }
  return std::sqrt(squares_m2);
}

// What comes after says as much as what came before: a radio that errs by 50 mm.
TEST(JoinedFilter, KnowsItsWayBetterByWhatComesAfter) {
  const Clapper trucks = fine_clapper();
  const Vehicle vehicle = vehicle_of(trucks);
  LinkedRunSettings s = under_a_total_station(), exactly = s;
  s.truth_m = 0.05;
  exactly.truth_m = exactly.truth_rad = 0.0;
  const Recording actual = linked_run(trucks, exactly, 414), read = linked_run(trucks, s, 414);
  JoinedFilter filter({unit_samples(read, vehicle), tracked_positions(read), false}, vehicle, 0.0);
  JoinedNoise noise;
  noise.truth_position_m = s.truth_m;
  noise.wheel_m_per_sqrt_m = s.wheel_noise;
  filter.run(noise);
  const double filtered_m = off_m(filter.track(0), actual), smoothed_m = off_m(filter.smoothed()[0], actual);
  EXPECT_LT(smoothed_m, 0.7 * filtered_m);
}

// What units contradict each other by is noise, and would be less were they all smaller: a radio that errs by 0.1 m
// does not stand against that.
TEST(JoinedModel, LetsUnitsSayNothingOfHowLargeTheyAllAre) {
  const Clapper trucks = fine_clapper();
  LinkedRunSettings s = under_a_total_station();
  s.truth_m = 0.1;
  constexpr int kRobots = 3;
  double mean = 0.0;  // in standard errors
  for (std::uint64_t robot = 0; robot < kRobots; ++robot) {
    std::vector<JoinedRun> runs;
    for (std::uint64_t run = 0; run < 2; ++run) {
      const Recording r = linked_run(trucks, s, 450 + 10 * robot + run);
      runs.push_back({unit_samples(r, vehicle_of(trucks)), tracked_positions(r), false});
    }
    JoinedModel model(runs, vehicle_of(trucks), {}, {"1", "2"});
    model.fit_all();
    double share = 0.0;
    for (const VehicleUnit& unit : units_of(model.vehicle()))
      share += 0.25 * (unit.drive.wheel_radius_left_m + unit.drive.wheel_radius_right_m);
    mean += (share / trucks.truck_a.wheel_radius_left_m - 1.0) / model.stderr_of_scale() / kRobots;
  }
  EXPECT_LT(std::abs(mean), 3.0 / std::sqrt(kRobots));  // they had been five too small
}

// From the inside only ratios would show.
TEST(DiagnoseUnits, MeasureHowLargeAllWheelsAreByPositionsAlone) {
  const Clapper actual = larger(fine_clapper(), 0.01);
  const LinkedRunSettings s = under_a_total_station();
  const Result<Diagnosis> d =
      diagnose(positions_alone({linked_run(actual, s, 411), linked_run(actual, s, 412), linked_run(actual, s, 413)}),
               {}, vehicle_of(fine_clapper()));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::nothing_missing);
  EXPECT_FALSE(d->calibration.scale_is_open);
  expect_known(*d, "truck_a.wheel_radius_left_m", actual.truck_a.wheel_radius_left_m, 0.001);
  expect_known(*d, "truck_a.wheelbase_m", actual.truck_a.wheelbase_m, 0.005);
  expect_known(*d, "truck_b.wheel_radius_right_m", actual.truck_b.wheel_radius_right_m, 0.001);
  expect_known(*d, "truck_b.wheelbase_m", actual.truck_b.wheelbase_m, 0.005);
}

// A link that reads 3 mm too little is, from the inside, all wheels too small by a percent.
TEST(DiagnoseUnits, TellALinkThatReadsShortFromSmallWheelsByPositionsAlone) {
  constexpr double kBias_m = -0.004;
  Clapper actual = larger(fine_clapper(), -0.01);
  actual.link_length_offset_m = kBias_m;
  const LinkedRunSettings s = under_a_total_station();
  const Result<Diagnosis> d =
      diagnose(positions_alone({linked_run(actual, s, 421), linked_run(actual, s, 422), linked_run(actual, s, 423)}),
               {}, vehicle_of(fine_clapper()));
  ASSERT_TRUE(d);
  ASSERT_EQ(d->findings.size(), 1u);
  EXPECT_EQ(d->findings[0].effect, "link_length_bias");
  const FoundParameter& bias = d->findings[0].parameters[0];
  EXPECT_NEAR(bias.value, kBias_m, 3.5 * bias.stderr_value);
  EXPECT_LT(bias.stderr_value, 0.1 * std::abs(kBias_m));
}

// The towing vehicle's wheels are not looked at: its heading is the trailer's, and what the hitch reads.
TEST(DiagnoseUnits, MeasureATrailerByPositionsOfWhatTowsIt) {
  EncoderTrailer actual;
  actual.hitch_angle_resolution_rad = 0.0005;
  const EncoderTrailer file = actual;
  for (double* length : {&actual.trailer.wheel_radius_left_m, &actual.trailer.wheel_radius_right_m,
                         &actual.trailer.wheelbase_m, &actual.drawbar_length_m})
    *length *= 1.008;
  const LinkedRunSettings s = under_a_total_station();
  const Result<Diagnosis> d =
      diagnose(positions_alone({trailer_run(actual, s, 441), trailer_run(actual, s, 442), trailer_run(actual, s, 443)}),
               {}, vehicle_of(file));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::nothing_missing);
  expect_known(*d, "trailer.wheel_radius_left_m", actual.trailer.wheel_radius_left_m, 0.001);
  expect_known(*d, "trailer.wheelbase_m", actual.trailer.wheelbase_m, 0.005);
  expect_known(*d, "drawbar_length_m", actual.drawbar_length_m, 0.006);
}

// The line through a pivot meets its axle two or three millimetres from where the file has it, which travels in turns.
MultiCastor with_axles_aside() {
  MultiCastor platform = three_castor_vehicle();
  const double aside_m[] = {0.002, -0.003, 0.0015};
  for (std::size_t k = 0; k < 3; ++k) {
    platform.castors[k].wheel_offset_left_m += aside_m[k];
    platform.castors[k].wheel_offset_right_m -= aside_m[k];
  }
  return platform;
}

void expect_asides(const Diagnosis& d, const MultiCastor& actual) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string castor = "castor[" + std::to_string(k + 1) + "].";
    expect_known(d, castor + "wheel_offset_left_m", actual.castors[k].wheel_offset_left_m, 0.006);
    expect_known(d, castor + "wheel_offset_right_m", actual.castors[k].wheel_offset_right_m, 0.006);
    const Castor& fitted = std::get<MultiCastor>(d.fitted_vehicle->kind).castors[k];
    EXPECT_NEAR(fitted.wheel_offset_left_m, actual.castors[k].wheel_offset_left_m, 0.001);  // 3 standard errors
  }
}

TEST(DiagnoseUnits, MeasureWhereThePivotsLineMeetsTheAxle) {
  const MultiCastor actual = with_axles_aside();
  LinkedRunSettings s;
  s.duration_s = 60.0;
  const Result<Diagnosis> d =
      diagnose({castor_run(actual, s, 431), castor_run(actual, s, 432)}, {}, vehicle_of(three_castor_vehicle()));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::nothing_missing);
  expect_asides(*d, actual);
}

TEST(DiagnoseUnits, MeasureWhereThePivotsLineMeetsTheAxleByPositionsAlone) {
  const MultiCastor actual = with_axles_aside();
  const LinkedRunSettings s = under_a_total_station();
  const Result<Diagnosis> d = diagnose(positions_alone({castor_run(actual, s, 433), castor_run(actual, s, 434)}), {},
                                       vehicle_of(three_castor_vehicle()));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::nothing_missing);
  expect_asides(*d, actual);
}

// A radio that errs by six centimetres five times a second tells a clock to 30 ms, and is not off by what it errs.
TEST(DiagnoseUnits, TakeNoClockForOffByWhatPositionsErr) {
  const MultiCastor castors = three_castor_vehicle();
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    LinkedRunSettings s = under_a_total_station();
    s.truth_m = 0.06;
    std::vector<Recording> runs = positions_alone({castor_run(castors, s, seed)});
    int sample = 0;
    for (std::size_t i = 0; i < runs[0].time_s.size(); ++i) {
      const bool is_seen = std::isfinite(runs[0].channel("truth_x_m")->values[i]) && sample++ % 5 == 0;
      for (Channel& c : runs[0].channels)
        if (c.name.rfind("truth", 0) == 0 && !is_seen) c.values[i] = std::nan("");
    }
    const Result<Diagnosis> d = diagnose(runs, {}, vehicle_of(castors));
    ASSERT_TRUE(d) << d.error().message();
    for (const Finding& f : d->findings)
      EXPECT_NE(f.effect, "truth_time_offset") << seed << ": " << f.log_likelihood_gain;
  }
}

}  // namespace
}  // namespace odolab::test
