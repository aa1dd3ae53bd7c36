#include "core/diagnosis/generic/responses.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

constexpr double kWorthShowing = 0.01;  // p value of a wave in what is left

const std::vector<double>& drawn(const CandidateTest& t) { return t.drawn_value.empty() ? t.value : t.drawn_value; }
double drawn_stderr(const CandidateTest& t, std::size_t k) {
  return (t.drawn_stderr.empty() ? t.stderr_value : t.drawn_stderr)[k] * std::sqrt(t.inflation);
}

// What calibration leaves; beside it, where something was `found`, what that leaves.
Response response_of(const GenericTest& g, bool found) {
  Response r;
  r.variable = g.variable;
  r.channel = g.channel;
  const CandidateTest& before = g.instead;
  const std::vector<double>&value = drawn(before), &after = drawn(g.test);
  for (std::size_t k = 0; k < g.at.size() && k < value.size(); ++k) {
    const double se = drawn_stderr(before, k);
    if (se > 1e3) continue;
    r.at.push_back(g.at[k]);
    r.value.push_back(value[k]);
    r.low.push_back(value[k] - 2.0 * se);
    r.high.push_back(value[k] + 2.0 * se);
    if (found && k < after.size()) r.after.push_back(after[k]);
  }
  return r;
}

// Around the angle. The values are held for independent of each other, as they are where all angles are driven alike.
Response response_of(const GenericTest& g, const GenericWave& wave, bool found) {
  constexpr int kPoints = 25;
  Response r;
  r.variable = wave.variable;
  r.channel = g.channel;
  const CandidateTest& before = g.instead;
  const std::vector<double>&of_before = drawn(before), &of_after = drawn(g.test);
  const bool has_after = found && !of_after.empty();
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * kPi * i / (kPoints - 1);
    double value = 0.0, variance = 0.0, after = 0.0;
    const auto add = [&](std::size_t k, double basis) {
      value += basis * of_before[k];
      variance += basis * basis * drawn_stderr(before, k) * drawn_stderr(before, k);
      if (has_after) after += basis * of_after[k];
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
    if (has_after) r.after.push_back(after);
  }
  return r;
}

}  // namespace

std::vector<Response> responses_of(std::vector<GenericTest> tests, bool found) {
  const auto p_of = [](const GenericTest& g) { return g.p_value_of(g.instead); };
  std::stable_sort(tests.begin(), tests.end(), [&](const GenericTest& a, const GenericTest& b) {
    const double pa = p_of(a), pb = p_of(b);
    return pa != pb ? pa < pb : a.instead.judged() > b.instead.judged();
  });
  std::vector<Response> responses;
  for (const GenericTest& g : tests) {
    if (!g.at.empty()) responses.push_back(response_of(g, found));
    if (g.instead.value.empty()) continue;  // it could not be tested
    // Of waves that were looked for at many lengths only what was found is of interest.
    if (g.tests > static_cast<double>(tests.size()) && p_of(g) > kWorthShowing) continue;
    for (const GenericWave& wave : g.waves) responses.push_back(response_of(g, wave, found));
  }
  return responses;
}

std::vector<Residuals> residuals_of(const JointModel& model) {
  const JointModel joint = model.as_recorded();
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
