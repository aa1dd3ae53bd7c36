#include "core/diagnosis/units/together/joined_asked.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

Visible visible_of(const ScoredTogether& s, double least) {
  Visible v;
  v.effect = s.candidate.effect;
  v.shape = s.shape;
  v.standard = std::sqrt(least) + kPower;
  v.survives = s.test.survives;
  v.inflation = s.test.inflation;
  v.excited = s.test.freedom > 0;
  if (!v.excited) return v;
  v.needed = 0.0;
  for (Eigen::Index k = 0; k < s.test.value.size(); ++k) {
    const double needed = v.standard * std::sqrt(s.test.inflation * s.test.covariance(k, k)) /
                          v.effect->amplitudes[static_cast<std::size_t>(k)].medium;
    if (needed > v.needed) v.needed = needed, v.weakest = static_cast<int>(k);
  }
  return v;
}

bool is_likelier_together(const ScoredTogether& a, const ScoredTogether& b) {
  return a.p_value != b.p_value ? a.p_value < b.p_value : a.test.judged() > b.test.judged();
}

// Where it says most; null where nobody was asked.
const ScoredTogether* likeliest_together(const std::vector<ScoredTogether>& all, const std::string& effect) {
  const ScoredTogether* best = nullptr;
  for (const ScoredTogether& s : all)
    if (s.candidate.effect->name == effect && (!best || is_likelier_together(s, *best))) best = &s;
  return best;
}

}  // namespace

std::vector<AskedTogether> asked_together(const std::vector<ScoredTogether>& by_itself,
                                          const std::vector<ScoredTogether>& beside,
                                          const std::function<double(const Effect&)>& least) {
  std::vector<AskedTogether> all;
  for (const ScoredTogether& s : by_itself) {
    const Effect& e = *s.candidate.effect;
    const Visible visible = visible_of(s, least(e));
    const auto same = std::find_if(all.begin(), all.end(), [&](const auto& a) { return a.asked.effect == e.name; });
    if (same != all.end()) {
      if (visible.needed > same->visible.needed) same->visible = visible;
      continue;
    }
    const ScoredTogether& best = *likeliest_together(by_itself, e.name);
    AskedTogether one;
    one.visible = visible;
    one.asked.effect = e.name;
    one.asked.component = best.candidate.component;
    one.asked.log_likelihood_gain = 0.5 * best.test.judged();
    one.asked.p_value = best.p_value;
    if (const ScoredTogether* then = likeliest_together(beside, e.name))
      one.asked.gain_beside_findings = 0.5 * then->test.judged();
    all.push_back(std::move(one));
  }
  for (AskedTogether& one : all) {
    if (one.visible.excited) one.asked.survives = one.visible.survives;
    one.asked.least_seen = least_seen(one.visible);
  }
  return all;
}

void put_asked_into(const std::vector<AskedTogether>& all, Diagnosis& d) {
  for (const AskedTogether& one : all) {
    for (AskedEffect& a : d.asked)
      if (a.effect == one.asked.effect) a = one.asked;
    const bool could_show = one.visible.needed <= 1.0;
    std::erase_if(d.not_testable, [&](const NotTestable& n) { return could_show && n.effect == one.asked.effect; });
    for (NotTestable& n : d.not_testable)
      if (n.effect == one.asked.effect) n.because = because_of(one.visible);
  }
}

}  // namespace odolab
