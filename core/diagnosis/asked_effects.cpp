#include "core/diagnosis/asked_effects.h"

#include <algorithm>

#include "core/calibration/column_names.h"

namespace odolab {

namespace {

bool is_likelier_candidate(const ScoredCandidate& a, const ScoredCandidate& b) {
  return a.p_value != b.p_value ? a.p_value < b.p_value : a.test.judged() > b.test.judged();
}

// Of an effect its likeliest part.
const ScoredCandidate* likeliest_candidate(const std::vector<ScoredCandidate>& scored, const std::string& effect) {
  const ScoredCandidate* best = nullptr;
  for (const ScoredCandidate& c : scored)
    if (c.effect->name == effect && (!best || is_likelier_candidate(c, *best))) best = &c;
  return best;
}

FoundParameter bent(int column, double by) {
  const column::Name& name = column::names[static_cast<std::size_t>(column)];
  return {name.key, by, 0.0, name.unit};
}

void add_visible(AskedEffect& asked, const JointModel& joint, const Visible& v) {
  if (!v.excited) return;
  asked.survives = v.survives;
  const auto clocks = static_cast<int>(joint.runs().size());
  if (v.bends >= 0 && v.bends < column::truth_clock + clocks)
    asked.bends = bent(std::min(v.bends, column::truth_clock), v.bends_by);
  asked.least_seen = least_seen(v);
}

}  // namespace

std::vector<AskedEffect> asked_effects(const JointModel& joint, const Selected& selected,
                                       const std::vector<Visible>& visible) {
  const std::vector<Visible> least = least_visible(visible);
  const bool from_commands = joint.views().front().from_commands;
  std::vector<AskedEffect> all;
  for (const ScoredCandidate& c : selected.first_look) {
    const std::string& name = c.effect->name;
    if (c.effect->only_commands && !from_commands) continue;
    if (std::any_of(all.begin(), all.end(), [&](const AskedEffect& a) { return a.effect == name; })) continue;
    const ScoredCandidate* best = likeliest_candidate(selected.first_look, name);
    AskedEffect asked;
    asked.effect = name;
    asked.component = best->effect->component;
    asked.log_likelihood_gain = 0.5 * best->test.judged();
    asked.p_value = best->p_value;
    for (std::size_t k = joint.accepted.size(); k-- > 0;) {
      if (joint.accepted[k].effect->name != name) continue;
      asked.named = true, asked.component = joint.accepted[k].effect->component;
      asked.log_likelihood_gain = 0.5 * selected.evidence[k].test.statistic;
      asked.p_value = selected.evidence[k].p_value;
    }
    if (const ScoredCandidate* beside = likeliest_candidate(selected.beside_all, name); beside && !asked.named)
      asked.gain_beside_findings = 0.5 * beside->test.judged();
    for (const Visible& v : least)
      if (v.effect->name == name) add_visible(asked, joint, v);
    if (name == "wheel_toe" && !asked.named) {  // to the last digit a mounting turned the other way
      asked.survives = 0.0;
      asked.bends = bent(column::mounting_heading, -best->effect->amplitudes[0].medium);
    }
    all.push_back(std::move(asked));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const AskedEffect& a, const AskedEffect& b) { return is_likelier(a, b); });
  return all;
}

bool is_likelier(const AskedEffect& a, const AskedEffect& b) {
  return a.p_value != b.p_value ? a.p_value < b.p_value : a.log_likelihood_gain > b.log_likelihood_gain;
}

}  // namespace odolab
