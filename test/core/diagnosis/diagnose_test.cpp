#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/chi_square.h"
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/model/joint_model.h"
#include "core/odometry/prediction.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

CaseSettings short_case(const std::string& effect, double size) {
  CaseSettings c;
  c.effect = effect;
  c.size = size;
  c.runs = 3;
  c.duration_s = 40.0;
  return c;
}

Diagnosis diagnosed(const Case& c) {
  Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  EXPECT_TRUE(d) << (d ? "" : d.error().message());
  return d ? std::move(*d) : Diagnosis{};
}

std::string said(const Diagnosis& d) {
  std::string s;
  for (const Finding& f : d.findings) s += f.effect + ":" + f.component + " ";
  return s;
}

TEST(Diagnose, FindsNothingWhereNothingIsMissingWhateverTheNoiseAndWhereverCalibrationStarted) {
  // 3 % is the bar; 14 cases with at most one alarm are passed by a tool that holds it in 94 % of seeds, and these
  // seeds are fixed.
  int alarms = 0;
  std::string what;
  for (int k = 0; k < 14; ++k) {
    const Diagnosis d = diagnosed(generated_case(short_case("", 0.0), 7000 + static_cast<std::uint64_t>(k)));
    if (d.verdict == Verdict::nothing_missing || d.verdict == Verdict::cannot_say) continue;
    ++alarms;
    what += "seed " + std::to_string(7000 + k) + ": " + said(d) + "; ";
  }
  EXPECT_LE(alarms, 1) << what;
}

// Calls `change(k, x, y, heading)` for the k-th truth sample.
template <typename Change>
void change_truth(Recording& r, Change&& change) {
  Channel *x = nullptr, *y = nullptr, *heading = nullptr;
  for (Channel& channel : r.channels) {
    if (channel.name == "truth_x_m") x = &channel;
    if (channel.name == "truth_y_m") y = &channel;
    if (channel.name == "truth_heading_rad") heading = &channel;
  }
  for (std::size_t i = 0, k = 0; i < r.time_s.size(); ++i)
    if (!std::isnan(x->values[i])) change(k++, x->values[i], y->values[i], heading->values[i]);
}

TEST(Diagnose, TakesATrackerThatLosesItselfForAMomentAndComesBackForNoPush) {
  Case c = generated_case(short_case("", 0.0), 7061);
  for (Recording& r : c.recordings)
    change_truth(r, [](std::size_t k, double& x, double& y, double& heading) {
      if (k % 700 < 400 || k % 700 >= 408) return;  // eight samples in a row
      x += 0.5, y -= 0.3, heading += 0.4;
    });
  const Diagnosis d = diagnosed(c);
  EXPECT_EQ(d.verdict, Verdict::nothing_missing) << said(d);
}

// As of most motion capture: a third of the noise is that of the sample before. It had been enough to turn away
// whatever lowers the error by less than 1.5 %.
TEST(Diagnose, NamesWhatIsMissingUnderATruthWhoseNoiseLastsForSomeSamples) {
  CaseSettings of = short_case("one_sided_drag", 1.0);
  of.runs = 4;
  of.duration_s = 60.0;
  Case c = generated_case(of, 7062);
  Random random(7063);
  for (Recording& r : c.recordings) {
    double a = 0.0, b = 0.0;
    change_truth(r, [&](std::size_t, double& x, double& y, double&) {
      a = 0.7 * a + 0.0015 * random.normal();
      b = 0.7 * b + 0.0015 * random.normal();
      x += a, y += b;
    });
  }
  const Diagnosis d = diagnosed(c);
  EXPECT_GT(d.calibration_alone.truth_apart_s, 0.0);
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
  EXPECT_EQ(d.findings[0].effect, "one_sided_drag");
}

// As of a localisation by laser: 9 poses a second, each 12 mm and 10 mrad off, which lasts for a third of a second.
void localise_by_laser(Case& c, std::uint64_t seed) {
  constexpr double kLasts_s = 0.35, kOff_m = 0.012, kOff_rad = 0.01;
  Random random(seed);
  for (Recording& r : c.recordings) {
    const double period_s = (r.time_s.back() - r.time_s.front()) / static_cast<double>(r.time_s.size() - 1);
    const std::size_t every = static_cast<std::size_t>(std::lround(0.11 / period_s));
    const double stays = std::exp(-static_cast<double>(every) * period_s / kLasts_s),
                 more = std::sqrt(1.0 - stays * stays);
    double off[3] = {random.normal(), random.normal(), random.normal()};
    change_truth(r, [&](std::size_t k, double& x, double& y, double& heading) {
      if (k % every != 0) {
        x = y = heading = std::numeric_limits<double>::quiet_NaN();
        return;
      }
      for (double& o : off) o = stays * o + more * random.normal();
      x += kOff_m * off[0], y += kOff_m * off[1], heading += kOff_rad * off[2];
    });
  }
}

// The same, begun by so long a rest under a truth with the noise of motion capture.
Recording standing_first(Recording r, double stands_s, Random& random) {
  Recording all;
  all.name = r.name;
  const double period_s = (r.time_s.back() - r.time_s.front()) / static_cast<double>(r.time_s.size() - 1);
  const std::size_t rows = static_cast<std::size_t>(stands_s / period_s);
  for (std::size_t i = 0; i < rows; ++i)
    all.time_s.push_back(r.time_s.front() - period_s * static_cast<double>(rows - i));
  all.time_s.insert(all.time_s.end(), r.time_s.begin(), r.time_s.end());
  for (const Channel& c : r.channels) {
    const bool is_truth = c.name.rfind("truth", 0) == 0;
    const double first = *std::find_if(c.values.begin(), c.values.end(), [](double v) { return !std::isnan(v); });
    std::vector<double>& values = all.add_channel(c.name).values;
    for (std::size_t i = 0; i < rows; ++i) values[i] = is_truth ? first + 0.0005 * random.normal() : first;
    std::copy(c.values.begin(), c.values.end(), values.begin() + static_cast<std::ptrdiff_t>(rows));
  }
  return all;
}

// What swings while the robot drives, and not where it stands, is no noise of the truth that lasts: had only samples
// far apart been used, nothing would have been missing.
TEST(Diagnose, SaysThatSomethingIsMissingWhereTheHeadingSwingsOnlyAsTheRobotDrives) {
  constexpr double kSwing_rad = 0.06, kPer_s = 1.7, kStands_s = 1.5;
  Case c = generated_case(short_case("", 0.0), 7064);
  Random random(7065);
  for (Recording& r : c.recordings) {
    std::vector<double> driven_s;  // at each sample of the truth
    const std::vector<WheelSample> wheels = wheel_samples(r, DifferentialDrive{});
    double drives_s = 0.0;
    std::size_t w = 1;
    for (const TruthSample& t : truth_samples(r)) {
      for (; w < wheels.size() && wheels[w].time_s <= t.time_s; ++w)
        if (wheels[w].left_rad != wheels[w - 1].left_rad || wheels[w].right_rad != wheels[w - 1].right_rad)
          drives_s += wheels[w].time_s - wheels[w - 1].time_s;
      driven_s.push_back(drives_s);
    }
    change_truth(r, [&](std::size_t k, double&, double&, double& heading) {
      heading += kSwing_rad * std::sin(2.0 * kPi * kPer_s * driven_s[k]);
    });
    r = standing_first(std::move(r), kStands_s, random);
  }
  const Diagnosis d = diagnosed(c);
  EXPECT_EQ(d.calibration_alone.truth_apart_s, 0.0);
  EXPECT_EQ(d.verdict, Verdict::unknown_effect) << said(d);
}

// The noise of neighbours had been taken for that of the wheels, which hid scrubs and loads of 15 to 30 standard errors
// and made the wheelbase's error five times what it is.
TEST(Diagnose, NamesWhatIsMissingUnderATruthWhoseNoiseLastsForTenthsOfASecond) {
  for (const double size : {0.0, 3.0}) {
    CaseSettings of = short_case(size > 0.0 ? "turn_scrub" : "", size);
    of.runs = 4;
    of.duration_s = 60.0;
    Case c = generated_case(of, 7067);
    localise_by_laser(c, 7068);
    const Diagnosis d = diagnosed(c);
    EXPECT_GE(d.calibration_alone.truth_apart_s, 0.5);
    if (size == 0.0) {
      EXPECT_EQ(d.verdict, Verdict::nothing_missing) << said(d);
      continue;
    }
    ASSERT_EQ(d.findings.size(), 1u) << said(d);
    ASSERT_EQ(d.findings[0].effect, "turn_scrub");
    const FoundParameter& p = d.findings[0].parameters[0];
    EXPECT_NEAR(p.value, 0.03, 3.0 * p.stderr_value);
  }
}

// From one marker: each window of a metre begins with the heading that the way before it shows.
TEST(Diagnose, ProvesByTheWayAloneWhereTheTruthHasNoHeadings) {
  Case c = generated_case(short_case("one_sided_drag", 8.0), 7069);
  for (Recording& r : c.recordings)
    change_truth(
        r, [](std::size_t, double&, double&, double& heading) { heading = std::numeric_limits<double>::quiet_NaN(); });
  const Diagnosis d = diagnosed(c);
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
  ASSERT_TRUE(d.held_out.calibrated && d.held_out.with_findings && d.held_out.noise_floor);
  const FitFigures &before = *d.held_out.calibrated, &after = *d.held_out.with_findings;
  ASSERT_TRUE(before.gathered());
  EXPECT_FALSE(before.has_heading());
  // A heading that is off by 0.08 at the end of a metre has led 40 mm aside, of which calibration takes what goes one
  // way; what is left is noise, to within the chance of some 80 windows.
  EXPECT_GT(before.position_rms_m, 0.010);
  EXPECT_LT(after.position_rms_m, 0.8 * before.position_rms_m);
  EXPECT_LT(after.position_rms_m, 1.25 * d.held_out.noise_floor->position_rms_m);
}

// As of localisation in a map: it is matched anew each time it is far enough off.
void let_truth_jump(Case& c, std::uint64_t seed) {
  constexpr std::size_t kSamples = 240;  // from one jump to the next, 4 s
  constexpr double kBy_m = 0.008, kBy_rad = 0.005;
  Random random(seed);
  for (Recording& r : c.recordings) {
    double dx = 0.0, dy = 0.0, dheading = 0.0;
    change_truth(r, [&](std::size_t k, double& x, double& y, double& heading) {
      if (k % kSamples == kSamples / 2)
        dx = kBy_m * random.normal(), dy = kBy_m * random.normal(), dheading = kBy_rad * random.normal();
      x += dx, y += dy, heading += dheading;
    });
  }
}

TEST(Diagnose, TakesATruthThatJumpsTimeAndAgainForNoPushes) {
  Case c = generated_case(short_case("", 0.0), 7064);
  let_truth_jump(c, 7065);
  const Diagnosis d = diagnosed(c);
  EXPECT_EQ(d.verdict, Verdict::nothing_missing) << said(d);
  EXPECT_TRUE(std::any_of(d.warnings.begin(), d.warnings.end(),
                          [](const std::string& w) { return w.find("the truth jumps at ") == 0; }));
}

TEST(Diagnose, NamesWhatIsMissingUnderATruthThatJumps) {
  Case c = generated_case(short_case("one_sided_drag", 1.0), 7066);
  let_truth_jump(c, 7067);
  const Diagnosis d = diagnosed(c);
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
  EXPECT_EQ(d.findings[0].effect, "one_sided_drag");
}

// As of satellites: exact from sample to sample, and a centimetre off after some seconds, whether it drives or stands.
TEST(Diagnose, TakesATruthThatWandersForNoPush) {
  constexpr double kAfter_s = 30.0, kOff_m = 0.015, kSample_s = 1.0 / 60.0;
  for (std::uint64_t seed = 7068; seed < 7072; ++seed) {
    Case c = generated_case(short_case("", 0.0), seed);
    Random random(seed + 100);
    const double stays = std::exp(-kSample_s / kAfter_s), step_m = kOff_m * std::sqrt(1.0 - stays * stays);
    for (Recording& r : c.recordings) {
      double dx = kOff_m * random.normal(), dy = kOff_m * random.normal();
      change_truth(r, [&](std::size_t, double& x, double& y, double&) {
        dx = stays * dx + step_m * random.normal();
        dy = stays * dy + step_m * random.normal();
        x += dx, y += dy;
      });
    }
    const Diagnosis d = diagnosed(c);
    EXPECT_TRUE(d.findings.empty()) << seed << ": " << said(d);
  }
}

TEST(Diagnose, TakesNothingForAnEffectWhereThereIsNoNoiseAtAll) {
  // Only the path between two readings is left, some hundredths of a millimetre.
  CaseSettings c = short_case("", 0.0);
  c.without_noise = true;
  const Diagnosis d = diagnosed(generated_case(c, 7050));
  EXPECT_EQ(d.verdict, Verdict::nothing_missing) << said(d);
}

TEST(Diagnose, NamesAnEffectAloneWhereThereIsNoNoiseAtAll) {
  CaseSettings c = short_case("lateral_slip", 1.0);
  c.without_noise = true;
  const Diagnosis d = diagnosed(generated_case(c, 7051));
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
  EXPECT_EQ(d.findings.front().effect, "lateral_slip");
}

class NamesEffect : public testing::TestWithParam<const char*> {};

TEST_P(NamesEffect, FirstWhereItIsStrong) {
  // Compressed tyres hide in the wheelbase on a drive this short and slow.
  const double size = std::string(GetParam()) == "tyre_compression" ? 10.0 : 3.0;
  const Diagnosis d = diagnosed(generated_case(short_case(GetParam(), size), 7100));
  ASSERT_FALSE(d.findings.empty()) << static_cast<int>(d.verdict);
  EXPECT_EQ(d.findings.front().effect, GetParam()) << said(d);
  // What was named must make the recordings themselves better predicted.
  ASSERT_TRUE(d.train.calibrated && d.train.with_findings);
  EXPECT_LE(d.train.with_findings->normalised_chi2, 1.01 * d.train.calibrated->normalised_chi2);
}
INSTANTIATE_TEST_SUITE_P(Catalogue, NamesEffect,
                         testing::Values("wheel_eccentricity", "encoder_missed_counts", "drivetrain_backlash",
                                         "castor_reversal_kick", "radius_drift", "tyre_compression",
                                         "speed_dependent_radius", "payload_radius_change", "lateral_slip",
                                         "traction_slip", "turn_scrub", "one_sided_drag", "bump", "slip_zone",
                                         "floor_slope_creep", "collision", "turn_speed_loss", "wheel_toe"),
                         [](const testing::TestParamInfo<const char*>& p) { return std::string(p.param); });

TEST(Diagnose, MeasuresAnEffectToWithinItsUncertainty) {
  const Diagnosis d = diagnosed(generated_case(short_case("lateral_slip", 1.0), 7201));
  ASSERT_FALSE(d.findings.empty());
  ASSERT_EQ(d.findings.front().effect, "lateral_slip");
  const FoundParameter& p = d.findings.front().parameters.front();
  EXPECT_NEAR(p.value, 0.02, 4.0 * p.stderr_value + 0.0004);  // and 2 % for the form's own error
}

TEST(Diagnose, CallsUnknownWhatIsInNoList) {
  for (const char* outside :
       {"magnet", "compass", "memory", "waves", "gusts", "wheelbase_with_time", "uneven_castor"}) {
    const Diagnosis d = diagnosed(generated_case(short_case(outside, 2.0), 7301));
    EXPECT_EQ(d.verdict, Verdict::unknown_effect) << outside << ": " << said(d);
    // Names that are not said leave no trace in the model.
    ASSERT_TRUE(d.fitted_vehicle);
    EXPECT_EQ(std::get<DifferentialDrive>(d.fitted_vehicle->kind).wheelbase_m,
              std::get<DifferentialDrive>(d.calibration_alone.vehicle.kind).wheelbase_m)
        << outside;
  }
}

TEST(Diagnose, CallsManyPushesAndNoOtherCauseUnknown) {
  Random random(7311);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.01);
  g.duration_s = 40.0;
  const auto pushed = [](int run) {
    return [run](InjectedStep& s) {
      for (const double at_s : {8.0, 19.0, 31.0})
        if (run == 1 && s.time_s >= at_s && s.time_s < at_s + 0.05) s.sideways_m += 0.3 * s.dt_s;  // 15 mm each
    };
  };
  const std::vector<Recording> recordings = three_runs(
      g, random, [&](int) { return varied_driving(random, g.duration_s); }, pushed);
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  EXPECT_EQ(d.verdict, Verdict::unknown_effect) << said(d);
  ASSERT_FALSE(d.findings.empty());
  EXPECT_EQ(d.findings.front().alternatives.size(), 3u);
}

TEST(Diagnose, SaysOfWhichWheelTheRadiusDependsOnSpeed) {
  Random random(7321);
  GeneratorSettings g = under_motion_capture({0.075, 0.075, 0.34}, 0.0008, 0.01);
  g.duration_s = 50.0;
  const auto growing = [](InjectedStep& s) { s.right_m *= 1.0 + 0.02 * std::abs(0.075 * s.right_radps); };
  const std::vector<Recording> recordings = three_runs(
      g, random, [&](int) { return varied_driving(random, g.duration_s); }, [&](int) { return growing; });
  const Diagnosis d = diagnose(recordings, {}, Vehicle{}).value();
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
  EXPECT_EQ(d.findings[0].effect, "speed_dependent_radius");
  EXPECT_EQ(d.findings[0].component, "right_wheel");
  const FoundParameter& p = d.findings[0].parameters.front();
  EXPECT_NEAR(p.value, 0.02, 4.0 * p.stderr_value);
}

// However much a marker that sits elsewhere explains, calibration does without a name.
TEST(Diagnose, SaysWhatCalibrationLeavesBeforeWhereTheTrackedPointSits) {
  Case c = generated_case(short_case("lateral_slip", 2.0), 7402);
  for (Recording& r : c.recordings)
    change_truth(r, [](std::size_t, double& x, double& y, double& heading) {
      x += 0.03 * std::cos(heading), y += 0.03 * std::sin(heading), heading += 0.2;
    });
  const Diagnosis d = diagnosed(c);
  ASSERT_EQ(d.findings.size(), 2u) << said(d);
  EXPECT_EQ(d.findings[0].effect, "lateral_slip");
  EXPECT_EQ(d.findings[1].effect, "truth_mounting_offset");
  EXPECT_GT(d.findings[1].log_likelihood_gain, d.findings[0].log_likelihood_gain);
}

TEST(Diagnose, SaysThatItCannotSayWhereTheTruthIsOnlyStartAndEnd) {
  CaseSettings c = short_case("lateral_slip", 3.0);
  c.truth = CaseSettings::Truth::ends;
  EXPECT_EQ(diagnosed(generated_case(c, 7401)).verdict, Verdict::cannot_say);
}

TEST(Diagnose, ReportsFrozenTruthAsAFaultOfTheDataAndNotAsPhysics) {
  Case c = generated_case(short_case("", 0.0), 7501);
  Recording& r = c.recordings[1];
  std::vector<double> last(r.channels.size(), 0.0);
  bool any = false;
  for (std::size_t i = 0; i < r.time_s.size(); ++i)
    for (std::size_t k = 2; k < r.channels.size(); ++k) {
      double& v = r.channels[k].values[i];
      if (!std::isfinite(v)) continue;
      if (r.time_s[i] > 12.0 && r.time_s[i] < 13.5) v = last[k], any = true;
      last[k] = v;
    }
  ASSERT_TRUE(any);
  const Diagnosis d = diagnosed(c);
  ASSERT_EQ(d.findings.size(), 1u) << said(d);
  EXPECT_EQ(d.findings[0].effect, "truth_frozen");
  EXPECT_NEAR(d.findings[0].where.time_s.front().first, 12.0, 0.2);
}

TEST(Diagnose, ReportsAnEncoderThatStoodStillAsAFaultOfTheData) {
  Case c = generated_case(short_case("", 0.0), 7502);
  Recording& r = c.recordings[0];
  double held = 0.0, lost = 0.0, before = 0.0, start_s = 0.0;
  // Freeze the left wheel for a second from the first moment after 10 s at which it turns quickly.
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    double& v = r.channels[0].values[i];
    if (!std::isfinite(v)) continue;
    const double true_value = v;
    if (start_s == 0.0 && r.time_s[i] > 10.0 && true_value - before > 0.06) start_s = r.time_s[i], held = before;
    if (start_s > 0.0 && r.time_s[i] < start_s + 1.0) {
      v = held;
      lost = true_value - held;
    } else {
      v = true_value - lost;
    }
    before = true_value;
  }
  ASSERT_GT(start_s, 0.0);
  const Diagnosis d = diagnosed(c);
  EXPECT_TRUE(std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& f) {
    return f.effect == "encoder_data_fault";
  })) << said(d);
  for (const Finding& f : d.findings) EXPECT_TRUE(f.effect == "encoder_data_fault") << f.effect;
}

// Wheels that were not read for a while: their counts go on behind.
void forget_wheels(Recording& r, double from_s, double to_s) {
  for (std::size_t i = 0; i < r.time_s.size(); ++i)
    if (r.time_s[i] > from_s && r.time_s[i] < to_s) r.channels[0].values[i] = r.channels[1].values[i] = std::nan("");
}

void expect_only_faults(const Diagnosis& d) {
  EXPECT_FALSE(d.findings.empty());
  for (const Finding& f : d.findings) EXPECT_EQ(f.effect, "encoder_data_fault") << f.sentence;
}

TEST(Diagnose, SaysWhereTheEncodersWereNotReadAndMakesNothingOfIt) {
  for (double lasts_s : {0.5, 4.0}) {
    Case c = generated_case(short_case("", 0.0), 7503);
    const Diagnosis whole = diagnosed(c);
    forget_wheels(c.recordings[1], 12.01, 12.0 + lasts_s);
    const Diagnosis d = diagnosed(c);
    ASSERT_EQ(d.findings.size(), 1u) << said(d);
    expect_only_faults(d);
    ASSERT_EQ(d.findings[0].where.time_s.size(), 1u);
    // To a reading, which is 0.02 s here.
    EXPECT_NEAR(d.findings[0].where.time_s[0].first, 12.0, 0.021);
    EXPECT_NEAR(d.findings[0].where.time_s[0].second, 12.0 + lasts_s, 0.021);
    EXPECT_EQ(d.findings[0].where.recording, "run_1");
    // The rest is as good as it was: a thirtieth of the drive is missing at most.
    EXPECT_LT(d.train.calibrated->position_rms_m, 1.15 * whole.train.calibrated->position_rms_m);
    EXPECT_LT(d.calibration.parameters[2].stderr_value, 1.3 * whole.calibration.parameters[2].stderr_value);
  }
}

TEST(Diagnose, LeavesOutACounterThatStartsAgain) {
  Case c = generated_case(short_case("", 0.0), 7504);
  const Diagnosis whole = diagnosed(c);
  Recording& r = c.recordings[1];
  // At the first moment after 15 s at which both wheels have turned far enough for the step to be none of theirs.
  double left_rad = 0.0, right_rad = 0.0;
  bool again = false;
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    double &l = r.channels[0].values[i], &right = r.channels[1].values[i];
    if (!std::isfinite(l)) continue;
    if (!again && r.time_s[i] > 15.0 && std::abs(l) > 5.0 && std::abs(right) > 5.0)
      again = true, left_rad = l, right_rad = right;
    if (again) l -= left_rad, right -= right_rad;
  }
  ASSERT_TRUE(again);
  const Diagnosis d = diagnosed(c);
  expect_only_faults(d);
  EXPECT_LT(d.train.calibrated->position_rms_m, 1.15 * whole.train.calibrated->position_rms_m);
  EXPECT_LT(d.calibration.parameters[2].stderr_value, 1.3 * whole.calibration.parameters[2].stderr_value);
}

TEST(Diagnose, NamesNothingWhereTheTruthReachesBeyondTheWheelsAndItsClockIsLate) {
  CaseSettings settings = short_case("", 0.0);
  settings.truth_late_s = 0.08;
  Case c = generated_case(settings, 7505);
  for (Recording& r : c.recordings) {  // the wheels' log is cut while it drives
    forget_wheels(r, -1.0, 3.0);
    forget_wheels(r, 37.0, 50.0);
  }
  const Diagnosis d = diagnosed(c);
  for (const Finding& f : d.findings) EXPECT_EQ(f.effect, "truth_time_offset") << f.sentence;
  ASSERT_EQ(d.truth_clock_s.size(), 3u);
  for (const auto& [recording, late_s] : d.truth_clock_s) EXPECT_NEAR(late_s, 0.08, 0.002) << recording;
}

TEST(Diagnose, RefusesAnUnusableRecordingByName) {
  Case c = generated_case(short_case("", 0.0), 7601);
  c.recordings[1].time_s[5] = -100.0;
  const Result<Diagnosis> d = diagnose(c.recordings, {}, c.nominal);
  ASSERT_FALSE(d);
  EXPECT_EQ(d.error().where, "run_1");
}

TEST(PredictedTrack, WithoutEffectsIsTheVehiclesOwn) {
  const Case c = generated_case(short_case("", 0.0), 7701);
  const Result<Track> a = predicted_track(c.recordings[0], c.nominal),
                      b = predicted_track(c.recordings[0], c.nominal,
                                          {{"wheel_toe", "vehicle", {{"sideways_per_metre", 0.0}}}});
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->size(), b->size());
  // Two ways through the same arithmetic: rounding only.
  EXPECT_NEAR(a->back().pose.x_m, b->back().pose.x_m, 1e-9);
  EXPECT_NEAR(a->back().pose.heading_rad, b->back().pose.heading_rad, 1e-9);
}

TEST(ChiSquareTail, AgreesWithPublishedQuantiles) {
  EXPECT_NEAR(chi_square_tail(3.841, 1), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(9.210, 2), 0.01, 1e-4);
  EXPECT_NEAR(chi_square_tail(11.345, 3), 0.01, 1e-4);
  EXPECT_NEAR(chi_square_tail(18.307, 10), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(19.675, 11), 0.05, 1e-4);
}

// Quantiles of F(2, 60) and F(4, 30), times their first freedom.
TEST(ChiSquareTail, IsFishersFWhereTheScaleCameFromFewBatches) {
  EXPECT_NEAR(scaled_chi_square_tail(2 * 3.150, 2, 60.0), 0.05, 1e-4);
  EXPECT_NEAR(scaled_chi_square_tail(4 * 4.018, 4, 30.0), 0.01, 1e-4);
  // With many batches it is chi-square, but for a share of x^2 / (4 batches): 0.4 % of 0.01.
  EXPECT_NEAR(scaled_chi_square_tail(9.210, 2, 5e3), chi_square_tail(9.210, 2), 6e-5);
}

}  // namespace
}  // namespace odolab::test
