#include "core/diagnosis/responses.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

constexpr double kWorthShowing = 0.01;  // p value of a wave in what is left

// `left`: the same group with the findings let in; null where there are none.
Response response_of(const GenericTest& g, const GenericTest* left) {
  Response r;
  r.variable = g.variable;
  r.channel = g.channel;
  for (std::size_t k = 0; k < g.at.size() && k < g.test.value.size(); ++k) {
    const double se = g.test.stderr_value[k] * std::sqrt(g.test.inflation);
    if (se > 1e3) continue;
    r.at.push_back(g.at[k]);
    r.value.push_back(g.test.value[k]);
    r.low.push_back(g.test.value[k] - 2.0 * se);
    r.high.push_back(g.test.value[k] + 2.0 * se);
    if (left && k < left->test.value.size()) r.after.push_back(left->test.value[k]);
  }
  return r;
}

// Around the angle. The values are held for independent of each other, as they are where all angles are driven alike.
Response response_of(const GenericTest& g, const GenericWave& wave, const GenericTest* left) {
  constexpr int kPoints = 25;
  Response r;
  r.variable = wave.variable;
  r.channel = g.channel;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * kPi * i / (kPoints - 1);
    double value = 0.0, variance = 0.0, after = 0.0;
    const auto add = [&](std::size_t k, double basis) {
      value += basis * g.test.value[k];
      variance += basis * basis * g.test.stderr_value[k] * g.test.stderr_value[k] * g.test.inflation;
      if (left) after += basis * left->test.value[k];
    };
    for (std::size_t n = 0; n < wave.cosine.size(); ++n) {
      add(wave.cosine[n], std::cos(static_cast<double>(n + 1) * angle));
      add(wave.sine[n], std::sin(static_cast<double>(n + 1) * angle));
    }
    const double se = std::sqrt(variance);
    if (se > 1e3) return r;
    r.at.push_back(angle);
    r.value.push_back(value);
    r.low.push_back(value - 2.0 * se);
    r.high.push_back(value + 2.0 * se);
    if (left) r.after.push_back(after);
  }
  return r;
}

}  // namespace

std::vector<Response> responses_of(const JointModel& calibrated, const std::vector<GenericTest>& generic_now,
                                   bool found) {
  const std::vector<GenericTest> at_first = found ? generic_tests(calibrated) : generic_now;
  std::vector<Response> responses;
  for (const GenericTest& g : at_first) {
    const auto left = std::find_if(generic_now.begin(), generic_now.end(), [&](const GenericTest& other) {
      return other.variable == g.variable && other.channel == g.channel;
    });
    const GenericTest* now = found && left != generic_now.end() && !left->test.value.empty() ? &*left : nullptr;
    if (!g.at.empty()) responses.push_back(response_of(g, now));
    if (g.test.value.empty()) continue;  // it could not be tested
    // Of waves that were looked for at many lengths only what was found is of interest.
    if (g.tests > static_cast<double>(at_first.size()) && g.p_value > kWorthShowing) continue;
    for (const GenericWave& wave : g.waves) responses.push_back(response_of(g, wave, now));
  }
  return responses;
}

std::vector<Residuals> residuals_of(const JointModel& joint) {
  std::vector<Residuals> all;
  for (std::size_t r = 0; r < joint.runs().size(); ++r) {
    Residuals out;
    out.recording = joint.runs()[r].name;
    for (const FilterStep& s : joint.linearised()[r].steps()) {
      if (s.truth_index < 0 || !s.used) continue;
      const Vec2 body = rotated({s.residual[0], s.residual[1]}, -s.heading_rad);
      out.time_s.push_back(joint.runs()[r].truth[s.truth_index].time_s);
      out.x_m.push_back(s.pose.x_m);
      out.y_m.push_back(s.pose.y_m);
      out.along_m.push_back(body.x_m);
      out.across_m.push_back(body.y_m);
      out.heading_rad.push_back(s.size == 3 ? s.residual[2] : 0.0);
      const Whitened& w = joint.linearised()[r].residual();
      double squared = 0.0;
      for (int k = 0; k < 3; ++k) squared += w[3 * s.truth_index + k] * w[3 * s.truth_index + k];
      out.squared.push_back(squared / s.size);
    }
    all.push_back(std::move(out));
  }
  return all;
}

}  // namespace odolab
