#include "core/diagnosis/generic/adequacy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/missing_physics.h"
#include "test/support/other_room.h"

namespace odolab {
namespace {

// Seen through a lens that draws positions outward, by so much of their distance at one metre from its axis.
void bend(Recording& recording, double per_m2) {
  std::vector<double>& x = recording.add_channel("bent_x").values;
  std::vector<double>& y = recording.add_channel("bent_y").values;
  for (Channel& c : recording.channels) {
    if (c.name == "truth_x_m") x = c.values;
    if (c.name == "truth_y_m") y = c.values;
  }
  for (Channel& c : recording.channels)
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      const double by = 1.0 + per_m2 * (x[i] * x[i] + y[i] * y[i]);
      if (c.name == "truth_x_m" || c.name == "truth_y_m") c.values[i] *= by;
    }
}

TEST(Adequacy, CallsATruthSeenThroughALensUnknownAndSaysThatItsPositionsAreBent) {
  constexpr double kPerSquareMetre = 0.0005;
  test::Case c = test::case_of("", 1.0, 3, 4);
  for (Recording& r : c.recordings) bend(r, kPerSquareMetre);
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_NE(d->findings.front().where.regime.find("truth's position"), std::string::npos)
      << d->findings.front().where.regime;
  // Calibration absorbs the scale, but not what goes with the cube of the distance.
  const auto drawn = std::find_if(d->responses.begin(), d->responses.end(),
                                  [](const Response& r) { return r.channel == "truth off along x [m]"; });
  ASSERT_NE(drawn, d->responses.end());
  const std::vector<double>& off = drawn->value;  // at 25 places from one end of the floor to the other
  const double cubic = ((off[24] - off[0]) - 2.0 * (off[18] - off[6])) / 1.5;
  const double half_m = 0.5 * (drawn->at.back() - drawn->at.front());
  const double there = kPerSquareMetre * half_m * half_m * half_m;
  EXPECT_NEAR(cubic, there, 0.1 * there);  // 2 % at the rim, so much is the place itself off
}

// The same of its headings, as of a map that is bent: each is that of the bent way.
void bend_headings(Recording& recording, double per_m2) {
  std::vector<double>*x = nullptr, *y = nullptr, *heading = nullptr;
  for (Channel& c : recording.channels) {
    if (c.name == "truth_x_m") x = &c.values;
    if (c.name == "truth_y_m") y = &c.values;
    if (c.name == "truth_heading_rad") heading = &c.values;
  }
  for (std::size_t i = 0; i < x->size(); ++i) {
    const Vec2 at{(*x)[i], (*y)[i]}, ahead = rotated({1.0, 0.0}, (*heading)[i]);
    const Vec2 bent = (1.0 + per_m2 * dot(at, at)) * ahead + 2.0 * per_m2 * dot(at, ahead) * at;
    (*heading)[i] = unwrapped(std::atan2(bent.y_m, bent.x_m), (*heading)[i]);
  }
}

TEST(Adequacy, SaysThatPositionsAndHeadingsAreBentWhereBothAre) {
  constexpr double kPerSquareMetre = 0.0005;
  test::Case c = test::case_of("", 1.0, 3, 4);
  for (Recording& r : c.recordings) {
    bend_headings(r, kPerSquareMetre);
    bend(r, kPerSquareMetre);
  }
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_NE(d->findings.front().where.regime.find("truth's position and heading"), std::string::npos)
      << d->findings.front().where.regime;
  const auto drawn = std::find_if(d->responses.begin(), d->responses.end(),
                                  [](const Response& r) { return r.channel == "truth off along x [m]"; });
  ASSERT_NE(drawn, d->responses.end());
  const std::vector<double>& off = drawn->value;
  const double cubic = ((off[24] - off[0]) - 2.0 * (off[18] - off[6])) / 1.5;
  const double half_m = 0.5 * (drawn->at.back() - drawn->at.front());
  const double there = kPerSquareMetre * half_m * half_m * half_m;
  EXPECT_NEAR(cubic, there, 0.15 * there);
}

// Curves of six seconds to either side, one in three in reverse, with rests of a second and a half between.
test::SpeedProfile curves_and_rests(int run) {
  constexpr double kLeg_s = 6.0, kAll_s = 7.5;
  return [run](double t) {
    const int leg = static_cast<int>(t / kAll_s) + run;
    const double at_s = std::fmod(t, kAll_s);
    if (at_s >= kLeg_s) return test::WheelSpeedsAt{};
    const double pace = (leg % 3 == 2 ? -4.0 : 4.0) * (1.0 - std::cos(2.0 * kPi * at_s / kLeg_s));
    const double turn = leg % 2 == 0 ? 0.25 : -0.4;
    return test::WheelSpeedsAt{pace * (1.0 - turn), pace * (1.0 + turn)};
  };
}

TEST(Adequacy, CallsATyreThatIsFlatAfterStandingUnknownAndSaysThatItGoesWithTheWaySince) {
  test::GeneratorSettings g = test::under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.01);
  g.duration_s = 60.0;
  const auto flat = [](int) {  // the left one; it is round again half a metre on
    return [stood_s = 0.0, rolled_m = 1e3](test::InjectedStep& s) mutable {
      const bool stands = s.left_radps == 0.0 && s.right_radps == 0.0;
      if (!stands && stood_s > 1.0) rolled_m = 0.0;
      stood_s = stands ? stood_s + s.dt_s : 0.0;
      rolled_m += std::abs(s.left_m);
      s.left_m *= 1.0 - 0.02 * std::exp(-rolled_m / 0.5);
    };
  };
  Random random(64);
  const Result<Diagnosis> d = diagnose(test::three_runs(g, random, curves_and_rests, flat), {}, Vehicle{});
  ASSERT_TRUE(d);
  ASSERT_EQ(d->verdict, Verdict::unknown_effect);
  const std::string& regime = d->findings.front().where.regime;
  EXPECT_EQ(regime.find("left wheel per metre"), 0u) << regime;
  EXPECT_NE(regime.find("way since it stood"), std::string::npos) << regime;
}

// Seen from behind, or as if from there: the measured heading is turned.
void turn_mounting(Recording& recording, double by_rad) {
  for (Channel& c : recording.channels)
    if (c.name == "truth_heading_rad")
      for (double& heading : c.values) heading += by_rad;
}

TEST(Adequacy, CallsUnknownWhatIsInNoListThoughTheMountingIsTurnedBesides) {
  test::Case c = test::case_of("compass", 4.0, 4, 9);
  for (Recording& r : c.recordings) turn_mounting(r, 0.015);
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
}

// A castor that shimmies as it rolls turns the vehicle to and fro, too quickly to carry it anywhere.
TEST(Adequacy, CallsACastorThatShimmiesUnknownAndSaysHowQuickly) {
  constexpr double kSwings_rad = 0.002, kPeriod_s = 0.43;
  test::Case c = test::case_of("", 1.0, 3, 12);
  for (Recording& r : c.recordings)
    for (Channel& channel : r.channels)
      if (channel.name == "truth_heading_rad")
        for (std::size_t i = 0; i < channel.values.size(); ++i)
          channel.values[i] += kSwings_rad * std::sin(2.0 * kPi * r.time_s[i] / kPeriod_s);
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_NE(d->findings.front().where.regime.find("waves of 0.43 s"), std::string::npos)
      << d->findings.front().where.regime;
}

// A belt of its own stiffness between each wheel and its encoder: the wheel is behind by so much for each unit of its
// rim's acceleration.
TEST(Adequacy, CallsADriveUnknownThatYieldsToWhatItPushes) {
  constexpr double kYields_s2 = 0.008;
  Random random(17);
  test::GeneratorSettings g = test::under_motion_capture({0.075, 0.075, 0.34}, 0.0004, 0.01);
  g.duration_s = 60.0;
  const auto yielding = [](int) {
    return [speed = 0.0, behind_m = 0.0](test::InjectedStep& s) mutable {
      const double now = 0.075 * s.left_radps, behind = kYields_s2 * (now - speed) / s.dt_s;
      s.left_m -= behind - behind_m;
      speed = now, behind_m = behind;
    };
  };
  const std::vector<Recording> recordings = test::three_runs(
      g, random, [&](int) { return test::varied_driving(random, g.duration_s); }, yielding);
  const Result<Diagnosis> d = diagnose(recordings, {}, Vehicle{});
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_NE(d->findings.front().where.regime.find("yielded"), std::string::npos) << d->findings.front().where.regime;
}

// A belt in the floor, over which each run goes once, on a line of its own: each by itself is a push.
TEST(Adequacy, CallsUnknownWhatHappensTwiceAtOnePlaceOfTheFloor) {
  constexpr Vec2 kBelt{2.0, 0.0};
  constexpr double kHalf_m = 0.08, kCarries = 0.04;  // the share of the way by which it carries the vehicle aside
  Random random(29);
  test::GeneratorSettings g = test::under_motion_capture({0.075, 0.075, 0.34}, 0.0002, 0.01);
  g.duration_s = 40.0;
  const auto carried = [&](int run) {
    return [=](test::InjectedStep& s) {
      // Each way on past the place, the second run at a turn of the belt.
      if (run < 2 && length(s.pose.position() - kBelt) < kHalf_m)
        s.sideways_m += (run == 0 ? 1.0 : -1.0) * kCarries * s.left_m;
    };
  };
  const auto drives = [](int run) {
    return [=](double t) {
      const double bend = t < 14.0 ? 0.0 : (run == 2 ? 0.5 : 0.3) * std::sin(0.6 * t), slow = 2.0 + run;
      return test::WheelSpeedsAt{slow * (1.0 - bend), slow * (1.0 + bend)};
    };
  };
  const Result<Diagnosis> d = diagnose(test::three_runs(g, random, drives, carried), {}, Vehicle{});
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  ASSERT_FALSE(d->findings.empty());
  ASSERT_TRUE(d->findings.front().where.zone) << d->findings.front().where.regime;
  EXPECT_NEAR(d->findings.front().where.zone->x_m, kBelt.x_m, 0.1);
  EXPECT_NEAR(d->findings.front().where.zone->y_m, kBelt.y_m, 0.1);
}

bool may_be_the_truth(const Diagnosis& d) {
  return d.findings.front().where.regime.find("unless the truth sways") != std::string::npos;
}

// The place that is measured sways to and fro, each recording at a time of its own.
void sway(std::vector<Recording>& recordings, double by_m) {
  double phase = 0.0;
  for (Recording& r : recordings) {
    phase += 1.0;
    for (Channel& c : r.channels)
      for (std::size_t i = 0; i < c.values.size(); ++i) {
        const double angle = 2.0 * kPi * r.time_s[i] / 13.0 + phase;
        if (c.name == "truth_x_m") c.values[i] += by_m * std::sin(angle);
        if (c.name == "truth_y_m") c.values[i] += by_m * std::cos(1.1 * angle);
      }
  }
}

// Motion capture of a millimetre: cameras sway by as much, and no floor is known to a millimetre.
TEST(Adequacy, SaysThatItMayBeTheTruthThatSwaysWithinItsError) {
  test::Case c = test::case_of("", 1.0, 4, 8);
  sway(c.recordings, 0.0008);
  const Result<Diagnosis> small = diagnose(c.recordings, {}, c.nominal);
  EXPECT_EQ(small->verdict, Verdict::unknown_effect);
  EXPECT_TRUE(may_be_the_truth(*small)) << small->findings.front().where.regime;
  sway(c.recordings, 0.008);
  const Result<Diagnosis> large = diagnose(c.recordings, {}, c.nominal);
  EXPECT_EQ(large->verdict, Verdict::unknown_effect);
  EXPECT_FALSE(may_be_the_truth(*large)) << large->findings.front().where.regime;
}

// By more than one sample errs, in one direction: a wall of the room that lies across it is nothing to it.
TEST(Adequacy, TellsHowFarItSwaysHoweverTheRoomIsTurned) {
  test::Case c = test::case_of("", 1.0, 4, 8);
  for (Recording& r : c.recordings)
    for (Channel& channel : r.channels)
      for (std::size_t i = 0; i < channel.values.size(); ++i)
        if (channel.name == "truth_x_m") channel.values[i] += 0.002 * std::sin(2.0 * kPi * r.time_s[i] / 7.0);
  for (const double turned_rad : {0.0, 0.25 * kPi}) {
    std::vector<Recording> recordings;
    for (const Recording& r : c.recordings) recordings.push_back(test::in_room(r, {0.0, 0.0, turned_rad}));
    const Result<Diagnosis> d = diagnose(recordings, {}, c.nominal);
    ASSERT_TRUE(d);
    EXPECT_EQ(d->verdict, Verdict::unknown_effect);
    EXPECT_FALSE(may_be_the_truth(*d)) << turned_rad << ": " << d->findings.front().where.regime;
  }
}

// To and fro along x by less than one sample errs: as the wheels turn or, of the truth, always.
TEST(Adequacy, TellsGustsFromATruthThatSwaysByItsRests) {
  constexpr double kBy_m = 0.0008, kPeriod_s = 7.0;
  test::GeneratorSettings g = test::under_motion_capture({0.075, 0.075, 0.34}, 0.0004, 0.01);
  g.duration_s = 60.0;
  const auto gusts = [](int) {
    return [](test::InjectedStep& s) {
      if (s.left_radps == 0.0 && s.right_radps == 0.0) return;
      const double by_m = 2.0 * kPi / kPeriod_s * kBy_m * std::cos(2.0 * kPi * s.time_s / kPeriod_s) * s.dt_s;
      s.left_m += by_m * std::cos(s.pose.heading_rad);
      s.right_m += by_m * std::cos(s.pose.heading_rad);
      s.sideways_m -= by_m * std::sin(s.pose.heading_rad);
    };
  };
  Random random(41);
  const Result<Diagnosis> carried = diagnose(test::three_runs(g, random, curves_and_rests, gusts), {}, Vehicle{});
  ASSERT_TRUE(carried);
  ASSERT_EQ(carried->verdict, Verdict::unknown_effect);
  const std::string& regime = carried->findings.front().where.regime;
  EXPECT_NE(regime.find("in waves of 7"), std::string::npos) << regime;  // 7.1 s: eight steps to each turn of a run
  EXPECT_NE(regime.find(", while it drives"), std::string::npos) << regime;
  EXPECT_FALSE(may_be_the_truth(*carried)) << regime;

  std::vector<Recording> recordings =
      test::three_runs(g, random, curves_and_rests, [](int) { return [](test::InjectedStep&) {}; });
  for (Recording& r : recordings)
    for (Channel& c : r.channels)
      for (std::size_t i = 0; i < c.values.size(); ++i)
        if (c.name == "truth_x_m") c.values[i] += kBy_m * std::sin(2.0 * kPi * r.time_s[i] / kPeriod_s);
  const Result<Diagnosis> swaying = diagnose(recordings, {}, Vehicle{});
  ASSERT_EQ(swaying->verdict, Verdict::unknown_effect);
  EXPECT_TRUE(may_be_the_truth(*swaying)) << swaying->findings.front().where.regime;
}

// As simulators hand it out: straight along x, or round on the spot, under a truth that errs by its last digit alone.
TEST(Adequacy, SaysNothingOfATruthOfWhichNoMoreThanTheLastDigitSways) {
  for (const double turns_radps : {0.0, 0.9}) {
    Recording r;
    r.name = "run";
    for (int i = 0; i < 1500; ++i) r.time_s.push_back(0.02 * i);
    std::vector<double> left_rad, right_rad, x_m, heading_rad;
    const DifferentialDrive drive;
    for (const double t : r.time_s) {
      const double by_m = turns_radps == 0.0 ? 0.075 * t : 0.5 * drive.wheelbase_m * turns_radps * t;
      const auto written = [](double v) { return std::round(1e6 * v) / 1e6; };
      left_rad.push_back(written((turns_radps == 0.0 ? by_m : -by_m) / drive.wheel_radius_left_m));
      right_rad.push_back(written(by_m / drive.wheel_radius_right_m));
      x_m.push_back(turns_radps == 0.0 ? written(by_m) : 0.0);
      heading_rad.push_back(written(turns_radps * t));
    }
    r.add_channel("left_wheel_rad").values = left_rad;
    r.add_channel("right_wheel_rad").values = right_rad;
    r.add_channel("truth_x_m").values = x_m;
    r.add_channel("truth_y_m").values.assign(x_m.size(), 0.0);
    r.add_channel("truth_heading_rad").values = heading_rad;
    const Result<Diagnosis> d = diagnose({r}, {}, Vehicle{});
    ASSERT_TRUE(d);
    EXPECT_NE(d->verdict, Verdict::unknown_effect) << d->findings.front().where.regime;
  }
}

// An encoder's reader that sleeps between slow counts: below 0.12 m/s of its own wheel three counts in a hundred are
// lost.
TEST(Adequacy, HearsAWheelThatIsOtherwiseAtASpeedOfItsOwn) {
  constexpr double kBelow_mps = 0.12, kLost = 0.03;
  test::GeneratorSettings g = test::under_motion_capture({0.075, 0.075, 0.34}, 0.0006, 0.02);
  g.duration_s = 60.0;
  Random random(51);
  std::vector<Recording> recordings;
  for (int run = 0; run < 4; ++run) {
    g.inject = [radius_m = g.drive.wheel_radius_left_m](test::InjectedStep& s) {
      if (std::abs(s.left_radps) * radius_m < kBelow_mps) s.left_m *= 1.0 + kLost;
    };
    recordings.push_back(test::generated(g, test::varied_driving(random, g.duration_s), random));
    recordings.back().name = "run_" + std::to_string(run + 1);
  }
  const Result<Diagnosis> d = diagnose(recordings, {}, Vehicle{});
  ASSERT_TRUE(d);
  ASSERT_EQ(d->verdict, Verdict::unknown_effect);
  const std::string& regime = d->findings.front().where.regime;
  EXPECT_NE(regime.find("left wheel per metre [1] that depends on its own speed"), std::string::npos) << regime;
}

// A map that turns by a tenth of a degree in a second, about a corner of the room. `room`: where the map has that.
void expect_unknown_where_the_frame_turns(const Pose& room) {
  constexpr double kTurns_radps = 0.002;
  test::Case c = test::case_of("", 1.0, 3, 8);
  for (Recording& r : c.recordings) {
    std::vector<double>*x = nullptr, *y = nullptr, *heading = nullptr, *other = nullptr;
    for (Channel& channel : r.channels)
      (channel.name == "truth_x_m"           ? x
       : channel.name == "truth_y_m"         ? y
       : channel.name == "truth_heading_rad" ? heading
                                             : other) = &channel.values;
    for (std::size_t i = 0; i < r.time_s.size(); ++i) {
      const double by = kTurns_radps * (r.time_s[i] - r.time_s.front());
      const Vec2 place = rotated({(*x)[i], (*y)[i]}, by);
      (*x)[i] = place.x_m;
      (*y)[i] = place.y_m;
      (*heading)[i] += by;
    }
    r = test::in_room(std::move(r), room);
  }
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  ASSERT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_EQ(d->findings.front().component, "truth");
  EXPECT_NE(d->findings.front().where.regime.find("truth's frame"), std::string::npos)
      << d->findings.front().where.regime;
}

TEST(Adequacy, CallsATruthWhoseFrameTurnsUnknown) { expect_unknown_where_the_frame_turns({}); }

// It had been a floor that creeps, from some twenty metres on.
TEST(Adequacy, KnowsAFrameThatTurnsInARoomThatIsFarFromWherePlacesAreCountedFrom) {
  expect_unknown_where_the_frame_turns({60.0, -40.0, 0.0});
  expect_unknown_where_the_frame_turns({465000.0, 5247000.0, 0.0});
}

TEST(Adequacy, CallsAClockThatWandersUnknownAndSaysThatTheTruthIsLateNowAndThen) {
  test::Case c = test::case_of("", 1.0, 3, 5);
  // 60 ms to and fro in 16 s: a pace of 2.4 %
  for (Recording& r : c.recordings) {
    Recording wheels = r, truth = r;
    for (Channel& channel : wheels.channels)
      if (channel.name.rfind("truth_", 0) == 0) channel.values.assign(channel.values.size(), std::nan(""));
    for (Channel& channel : truth.channels)
      if (channel.name.rfind("truth_", 0) != 0) channel.values.assign(channel.values.size(), std::nan(""));
    for (double& t : truth.time_s) t += 0.06 * std::sin(2.0 * kPi * t / 16.0);
    Recording both = wheels;
    std::vector<std::pair<double, std::pair<const Recording*, std::size_t>>> rows;
    for (const Recording* of : {&wheels, &truth})
      for (std::size_t i = 0; i < of->time_s.size(); ++i) rows.push_back({of->time_s[i], {of, i}});
    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    both.time_s.clear();
    for (Channel& channel : both.channels) channel.values.clear();
    for (const auto& [time_s, row] : rows) {
      both.time_s.push_back(time_s);
      for (std::size_t k = 0; k < both.channels.size(); ++k)
        both.channels[k].values.push_back(row.first->channels[k].values[row.second]);
    }
    r = both;
  }
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
  EXPECT_NE(d->findings.front().where.regime.find("truth late by"), std::string::npos)
      << d->findings.front().where.regime;
}

TEST(Adequacy, CallsItUnknownWhereTheTruthContradictsTheWheelsTimeAndAgain) {
  // Wheels that spin for a quarter of a second, now on one side and now on the other, at no place and no speed of their
  // own.
  test::Case c = test::case_of("", 1.0, 3, 6);
  Random random(9);
  for (Recording& r : c.recordings)
    for (int slips = 0; slips < 6; ++slips) {
      const double at_s = random.uniform(5.0, 45.0);
      const char* const wheel = random.uniform() < 0.5 ? "left_wheel_rad" : "right_wheel_rad";
      const double by_rad = random.uniform(2.0, 4.0);
      for (Channel& channel : r.channels)
        for (std::size_t i = 0; channel.name == wheel && i < channel.values.size(); ++i)
          channel.values[i] += by_rad * std::clamp((r.time_s[i] - at_s) / 0.25, 0.0, 1.0);
    }
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
}

TEST(Adequacy, CallsUnknownWhatOnlyRunsShowThatWereNotFitted) {
  const test::Case odd = test::case_of("memory", 8.0, 4, 7), sound = test::case_of("", 1.0, 4, 7);
  const std::vector<Recording> fitted(sound.recordings.begin(), sound.recordings.begin() + 3);
  const Result<Diagnosis> nothing = diagnose(fitted, {sound.recordings[3]}, sound.nominal);
  ASSERT_TRUE(nothing);
  EXPECT_EQ(nothing->verdict, Verdict::nothing_missing);
  const Result<Diagnosis> d = diagnose(fitted, {odd.recordings[3]}, sound.nominal);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->verdict, Verdict::unknown_effect);
}

}  // namespace
}  // namespace odolab
