#include "core/diagnosis/generic/swinging.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <iterator>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/diagnosis/generic/counted.h"

namespace odolab {

namespace {

// Each stands for those up to a tenth shorter and longer: what is halved within a period and a half is as wide.
constexpr double kPeriods_s[kSwingingTests] = {0.9, 1.1, 1.35, 1.65, 2.0, 2.45, 3.0};
constexpr double kHalvedWithin = 1.5;  // periods

// What sets it swinging, and what of the vehicle's motion it becomes.
struct SwingWay {
  const char *variable, *channel;
  double (*input)(const EffectStep&);
  double BodyMotion::*becomes;
};
double sideways_mps2(const EffectStep& s) { return s.speed_mps * s.yaw_rate_radps; }
constexpr SwingWay kWays[] = {
    {"time since its speed changed [s]", "pace, as a share of the change [1]",
     [](const EffectStep& s) { return s.speed_mps; }, &BodyMotion::forward_m},
    {"time since its yaw rate changed [s]", "yaw rate, as a share of the change [1]",
     [](const EffectStep& s) { return s.yaw_rate_radps; }, &BodyMotion::turn_rad},
    {"time since its lateral acceleration changed [s]", "yaw rate for that change [rad/s per m/s2]", sideways_mps2,
     &BodyMotion::turn_rad},
    {"time since its lateral acceleration changed [s]", "pace sideways for that change [m/s per m/s2]", sideways_mps2,
     &BodyMotion::sideways_m},
};
constexpr std::size_t kWaysOnTheSpot = 2;  // the first: what needs no bend
constexpr std::size_t kTermsOfAWay = 2;    // what goes on as it began, and what began a quarter of a period before

// Whether a fifth of its turning is done as it drives. Else lateral acceleration is but the moment between a straight
// and a turn on the spot.
bool drives_bends(const std::vector<DriveView>& views) {
  constexpr double kDrives = 0.5, kShare = 0.2;  // of the fastest
  double fastest_mps = 0.0, turned_rad = 0.0, in_bends_rad = 0.0;
  for (const DriveView& v : views)
    for (const EffectStep& s : v.steps) fastest_mps = std::max(fastest_mps, std::abs(s.speed_mps));
  for (const DriveView& v : views)
    for (const EffectStep& s : v.steps) {
      turned_rad += std::abs(s.turn_rad);
      if (std::abs(s.speed_mps) > kDrives * fastest_mps) in_bends_rad += std::abs(s.turn_rad);
    }
  return in_bends_rad > kShare * turned_rad;
}

std::vector<Motions> motions_of_swinging(const DriveView& view, std::size_t ways, double period_s) {
  std::vector<Motions> out(kTermsOfAWay * ways, Motions(view.steps.size()));
  const std::complex<double> fades(-std::log(2.0) / (kHalvedWithin * period_s), 2.0 * kPi / period_s);
  std::complex<double> swings[std::size(kWays)];  // as shares of all changes so far
  for (std::size_t i = 1; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    const std::complex<double> on = std::exp(s.duration_s * fades);
    for (std::size_t w = 0; w < ways; ++w) {
      swings[w] = on * swings[w] + (kWays[w].input(s) - kWays[w].input(view.steps[i - 1]));
      out[kTermsOfAWay * w][i].*kWays[w].becomes = s.duration_s * swings[w].real();
      out[kTermsOfAWay * w + 1][i].*kWays[w].becomes = s.duration_s * swings[w].imag();
    }
  }
  return out;
}

// How a change fades away.
GenericCurve fading_of(std::size_t number, std::size_t ways, double period_s) {
  constexpr int kPoints = 33;
  constexpr double kOver = 2.0;  // periods
  GenericCurve curve{kWays[number].variable, kWays[number].channel, {}, {}};
  for (int i = 0; i < kPoints; ++i) {
    const double since_s = kOver * period_s * i / (kPoints - 1);
    const double left = std::exp2(-since_s / (kHalvedWithin * period_s)), phase = 2.0 * kPi * since_s / period_s;
    std::vector<double> by(kTermsOfAWay * ways, 0.0);
    by[kTermsOfAWay * number] = left * std::cos(phase);
    by[kTermsOfAWay * number + 1] = left * std::sin(phase);
    curve.at.push_back(since_s);
    curve.basis.push_back(std::move(by));
  }
  return curve;
}

}  // namespace

std::vector<GenericTest> swinging_tests(const AskedModel& asked, double looked_at) {
  const std::vector<DriveView>& views = asked.joint.views();
  if (std::any_of(views.begin(), views.end(), std::mem_fn(&DriveView::from_commands))) return {};
  const std::size_t ways = drives_bends(views) ? std::size(kWays) : kWaysOnTheSpot;
  std::vector<GenericTest> tests(kSwingingTests);
  parallel_for(kSwingingTests, [&](int i) {
    const double period_s = kPeriods_s[i];
    const std::string variable = formatted("changes of its motion, as if something swung on in %.2g s", period_s);
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    t = asked_of(
        asked, variable, "pace, yaw rate and pace sideways", kTermsOfAWay * ways,
        [=](const DriveView& view, const std::vector<double>&) { return motions_of_swinging(view, ways, period_s); },
        looked_at);
    leave_displaced_to_counting(t, asked.joint);
    for (std::size_t w = 0; w < ways; ++w) t.curves.push_back(fading_of(w, ways, period_s));
  });
  return tests;
}

}  // namespace odolab
