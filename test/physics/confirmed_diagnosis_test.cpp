#include "physics/confirmed_diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "test/support/linked_runs.h"
#include "test/support/missing_physics.h"

namespace odolab::test {
namespace {

double simulated_error_m(const std::vector<Recording>& recordings, const Vehicle& nominal) {
  const Result<Diagnosis> d = confirmed_diagnosis(recordings, {}, nominal);
  EXPECT_TRUE(d);
  EXPECT_TRUE(d->simulation.calibrated);
  return d->simulation.calibrated->position_rms_m;
}

TEST(ConfirmedDiagnosis, IsNotHeldAgainstOutliersOfTheTruth) {
  CaseSettings settings;
  settings.runs = 2;
  settings.duration_s = 30.0;
  Case c = generated_case(settings, 7401);
  const double clean_m = simulated_error_m(c.recordings, c.nominal);
  for (Recording& r : c.recordings)
    for (std::size_t i = 150; i < r.time_s.size(); i += 300)
      for (Channel& channel : r.channels)
        if (channel.name == "truth_x_m") channel.values[i] += 0.5;
  // They are a three-hundredth of the samples: at half a metre they would make 40 mm of it.
  EXPECT_NEAR(simulated_error_m(c.recordings, c.nominal), clean_m, 0.1 * clean_m);
  EXPECT_LT(clean_m, 0.01);
}

TEST(ConfirmedDiagnosis, OfTrucksIsNotHeldAgainstOutliersOfTheTruth) {
  LinkedRunSettings settings;
  settings.duration_s = 40.0;
  std::vector<Recording> runs;
  for (std::uint64_t k = 0; k < 2; ++k) {
    runs.push_back(linked_run(Clapper{}, settings, 351 + k));
    runs.back().name = "run_" + std::to_string(k + 1) + ".csv";
  }
  const double clean_m = simulated_error_m(runs, vehicle_of(Clapper{}));
  for (Recording& r : runs)
    for (Channel& channel : r.channels)
      if (channel.name == "truth_x_m")
        for (std::size_t i = 50; i < channel.values.size(); i += 100) channel.values[i] += 1.0;
  // One of a hundred samples: at a metre they would make 0.1 m of it. What they do to the joints stays.
  EXPECT_LT(simulated_error_m(runs, vehicle_of(Clapper{})), clean_m + 0.01);
  EXPECT_LT(clean_m, 0.005);
}

TEST(ConfirmedDiagnosis, IsNotHeldAgainstOutliersBetweenSamplesTakenFarApart) {
  CaseSettings settings;
  settings.runs = 2;
  settings.duration_s = 30.0;
  Case c = generated_case(settings, 7402);
  Random random(7402);
  constexpr double kLasts = 0.9, kNoise_m = 0.01;  // from sample to sample, as of a tracker that smooths
  for (Recording& r : c.recordings)
    for (Channel& channel : r.channels)
      if (channel.name == "truth_x_m" || channel.name == "truth_y_m") {
        double noise_m = 0.0;
        for (std::size_t i = 0; i < channel.values.size(); ++i) {
          noise_m = kLasts * noise_m + std::sqrt(1.0 - kLasts * kLasts) * kNoise_m * random.normal();
          channel.values[i] += noise_m;
        }
      }
  const auto by_samples_apart = [&] {
    const Result<Diagnosis> d = confirmed_diagnosis(c.recordings, {}, c.nominal);
    EXPECT_TRUE(d);
    EXPECT_TRUE(std::any_of(d->warnings.begin(), d->warnings.end(), [](const std::string& words) {
      return words.find("s apart were used") != std::string::npos;
    }));
    return d->simulation.calibrated->position_rms_m;
  };
  const double clean_m = by_samples_apart();
  for (Recording& r : c.recordings)
    for (std::size_t i = 155; i < r.time_s.size(); i += 300)
      for (Channel& channel : r.channels)
        if (channel.name == "truth_x_m") channel.values[i] += 2.0;
  // One of three hundred samples: at two metres they would make 0.16 m of it.
  EXPECT_NEAR(by_samples_apart(), clean_m, 0.2 * clean_m);
  EXPECT_LT(clean_m, 0.03);
}

// What a diagnosis leaves out of a run that was held out is no reason to say that the simulator goes other ways.
class ConfirmedByAHeldOutRun : public ::testing::Test {
 protected:
  ConfirmedByAHeldOutRun() {
    CaseSettings settings;
    settings.runs = 3;
    settings.duration_s = 30.0;
    c_ = generated_case(settings, 7403);
    clean_m_ = simulated_m();
    EXPECT_LT(clean_m_, 0.01);
  }

  std::vector<double>& held_out(const std::string& name) {
    for (Channel& channel : c_.recordings.back().channels)
      if (channel.name == name) return channel.values;
    static std::vector<double> none;
    return none;
  }

  double simulated_m() const {
    const Result<Diagnosis> d =
        confirmed_diagnosis({c_.recordings.begin(), c_.recordings.end() - 1}, {c_.recordings.back()}, c_.nominal);
    EXPECT_TRUE(d);
    EXPECT_TRUE(std::none_of(d->warnings.begin(), d->warnings.end(), [](const std::string& words) {
      return words.find("the simulator, driven by") != std::string::npos;
    }));
    return d->simulation.calibrated->position_rms_m;
  }

  // The samples of the held-out run in so many seconds from the middle of it on.
  template <typename Change>
  void change(const std::string& channel, double lasts_s, const Change& to) {
    const std::vector<double>& time_s = c_.recordings.back().time_s;
    std::vector<double>& values = held_out(channel);
    const double from_s = 0.5 * (time_s.front() + time_s.back());
    for (std::size_t i = 0; i < values.size(); ++i)
      if (time_s[i] >= from_s && time_s[i] < from_s + lasts_s && !std::isnan(values[i])) values[i] = to(values[i]);
  }

  Case c_;
  double clean_m_ = 0.0;
};

TEST_F(ConfirmedByAHeldOutRun, IsNotHeldAgainstATruthThatTookItsBodyForTurned) {
  change("truth_heading_rad", 1.4, [](double heading_rad) { return heading_rad + kPi; });
  EXPECT_NEAR(simulated_m(), clean_m_, 0.15 * clean_m_);
}

TEST_F(ConfirmedByAHeldOutRun, IsNotHeldAgainstOutliers) {
  change("truth_x_m", 0.03, [](double x_m) { return x_m + 1.0; });
  EXPECT_NEAR(simulated_m(), clean_m_, 0.15 * clean_m_);
}

TEST_F(ConfirmedByAHeldOutRun, IsNotHeldToTheWayThatAnEncoderDidNotCount) {
  // Half a second long it stands while the vehicle drives, and the counts of that time are gone.
  double last_rad = std::nan("");
  change("left_wheel_rad", 0.5, [&](double rad) { return last_rad = std::isnan(last_rad) ? rad : last_rad; });
  EXPECT_NEAR(simulated_m(), clean_m_, 0.15 * clean_m_);
}

}  // namespace
}  // namespace odolab::test
