#include "physics/experiments/concealed/report.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/base/quantile.h"
#include "core/io/number_text.h"
#include "physics/experiments/concealed/tally.h"

namespace odolab::concealed {

namespace {

using Cases = std::vector<const Judged*>;
using Is = std::function<bool(const Judged&)>;

constexpr double kOracleRemoves = 0.02;  // of the squared error, at least: else there is no share to speak of
// Of what an event does in half a second, from where on the most likely time is within half a second in 90 %: where a
// random walk with a drift of half its variance to either side is largest (Yao 1987, Annals of Statistics 15, 1321).
constexpr double kTellsTime_sigma = 2.8;

Cases those(const std::vector<Judged>& all, const Is& is) {
  Cases some;
  for (const Judged& j : all)
    if (is(j)) some.push_back(&j);
  return some;
}

Tally tally(const Cases& cases, const Is& is) {
  Tally t;
  for (const Judged* j : cases) t.add(is(*j));
  return t;
}

bool alarm(const Judged& j) { return j.verdict != Verdict::nothing_missing && j.verdict != Verdict::cannot_say; }
bool right_first(const Judged& j) { return j.named_first; }
bool right_alone(const Judged& j) { return j.named_first && j.listed.empty(); }
bool wrong_alone(const Judged& j) { return j.wrong_alone; }
Is says(Verdict verdict) {
  return [verdict](const Judged& j) { return j.verdict == verdict; };
}

// Effects that are concealed, on drives that could tell them apart.
Is of_level(Level level) {
  return [level](const Judged& j) { return j.kind == Kind::one && j.level == level && j.concealed.any() && !j.poor; };
}
Is concealed_of(Kind kind) {
  return [kind](const Judged& j) { return j.kind == kind && j.concealed.any() && !j.poor; };
}

struct Group {
  std::string name;
  Cases cases;
};

std::vector<Group> groups_of(const std::vector<Judged>& all) {
  std::vector<Group> groups;
  for (Level level : {Level::strong, Level::medium, Level::weak})
    groups.push_back({std::string("one effect, ") + name_of(level), those(all, of_level(level))});
  groups.push_back({"two at once", those(all, concealed_of(Kind::two))});
  groups.push_back({"outside the catalogue", those(all, concealed_of(Kind::outside))});
  groups.push_back({"not concealed", those(all, [](const Judged& j) {
                      return j.kind != Kind::nothing && !j.concealed.any() && !j.poor;
                    })});
  groups.push_back({"squares alone", those(all, [](const Judged& j) { return j.kind != Kind::nothing && j.poor; })});
  groups.push_back({"nothing missing", those(all, [](const Judged& j) { return j.kind == Kind::nothing; })});
  return groups;
}

ResultTable by_level(const std::vector<Group>& groups) {
  ResultTable table{"What was said, by level of strength (shares of the cases)",
                    {"missing", "cases", "named first", "and alone", "listed as alternative", "a name alone and wrong",
                     "ambiguous", "unknown", "nothing missing", "cannot say"},
                    {}};
  for (const Group& g : groups) {
    if (g.cases.empty()) continue;
    table.rows.push_back({g.name, std::to_string(g.cases.size()), percent_of(tally(g.cases, right_first)),
                          percent_of(tally(g.cases, right_alone)),
                          percent_of(tally(g.cases, [](const Judged& j) { return !j.named_first && j.truth_listed; })),
                          percent_of(tally(g.cases, wrong_alone)), percent_of(tally(g.cases, says(Verdict::ambiguous))),
                          percent_of(tally(g.cases, says(Verdict::unknown_effect))),
                          percent_of(tally(g.cases, says(Verdict::nothing_missing))),
                          percent_of(tally(g.cases, says(Verdict::cannot_say)))});
  }
  return table;
}

std::string joined(const std::vector<std::string>& list, const char* with, const char* none) {
  std::string text;
  for (const std::string& one : list) text += (text.empty() ? "" : with) + one;
  return text.empty() ? none : text;
}

// Only what was not as it should be.
ResultTable confusion(const std::vector<Judged>& all) {
  std::map<std::pair<std::string, std::string>, std::vector<int>> errors;
  std::map<std::string, int> cases;
  for (const Judged& j : all) {
    const std::string truth = j.kind == Kind::nothing ? "nothing" : joined(j.truth, " + ", "nothing");
    ++cases[truth];
    const bool right = j.kind == Kind::nothing   ? !alarm(j)
                       : j.kind == Kind::outside ? j.verdict == Verdict::unknown_effect
                       : j.kind == Kind::two     ? j.only_those
                                                 : j.named_first;
    if (right) continue;
    std::string said = joined(j.found, " + ", j.verdict == Verdict::cannot_say ? "cannot say" : "nothing missing");
    if (!j.failed.empty()) said = "an error";
    if (j.kind == Kind::one && j.verdict != Verdict::unknown_effect && !j.found.empty()) said = j.first();
    errors[{truth, said}].push_back(j.number);
  }
  ResultTable table{
      "Confusion: what was missing, and what was said instead", {"missing", "said", "times", "of", "cases"}, {}};
  for (const auto& [pair, numbers] : errors) {
    std::vector<std::string> list;
    for (std::size_t k = 0; k < std::min<std::size_t>(numbers.size(), 6); ++k)
      list.push_back(std::to_string(numbers[k]));
    table.rows.push_back({pair.first, pair.second, std::to_string(numbers.size()), std::to_string(cases[pair.first]),
                          joined(list, " ", "")});
  }
  return table;
}

ResultTable concealment_table(const std::vector<Judged>& all) {
  ResultTable table{"How they are concealed, measured (a case may be in more than one way)",
                    {"missing", "cases", "absorbed by calibration", "under the noise by eye",
                     "in under a tenth of the time", "cancel at the return pose", "not concealed"},
                    {}};
  const auto row = [&](const std::string& name, const Is& is) {
    const Cases c = those(all, is);
    if (c.empty()) return;
    table.rows.push_back({name, std::to_string(c.size()),
                          percent_of(tally(c, [](const Judged& j) { return j.concealed.absorbed; })),
                          percent_of(tally(c, [](const Judged& j) { return j.concealed.under_noise; })),
                          percent_of(tally(c, [](const Judged& j) { return j.concealed.seldom; })),
                          percent_of(tally(c, [](const Judged& j) { return j.concealed.cancels; })),
                          percent_of(tally(c, [](const Judged& j) { return !j.concealed.any(); }))});
  };
  for (Level level : {Level::strong, Level::medium, Level::weak})
    row(std::string("one effect, ") + name_of(level),
        [level](const Judged& j) { return j.kind == Kind::one && j.level == level; });
  row("two at once", [](const Judged& j) { return j.kind == Kind::two; });
  row("outside the catalogue", [](const Judged& j) { return j.kind == Kind::outside; });
  return table;
}

ResultTable alarms_by_resolution(const std::vector<Judged>& all) {
  std::map<int, Tally> by_counts;
  for (const Judged& j : all)
    if (j.kind == Kind::nothing) by_counts[static_cast<int>(j.counts_per_turn)].add(alarm(j));
  ResultTable table{
      "Alarms where nothing is missing, by the encoders' resolution", {"counts per turn", "cases", "alarms"}, {}};
  for (const auto& [counts, t] : by_counts)
    table.rows.push_back({std::to_string(counts), std::to_string(t.of), percent_of(t)});
  return table;
}

ResultTable parameters_table(const std::vector<Judged>& all, Tally& held) {
  struct Of {
    std::vector<double> error;
    Tally held;
  };
  std::map<std::string, Of> by_name;
  for (const Judged& j : all) {
    if (j.poor || j.verdict == Verdict::unknown_effect) continue;
    for (const JudgedParameter& p : j.parameters) {
      Of& of = by_name[p.name];
      of.error.push_back(std::abs(p.found - p.truth) / std::max(std::abs(p.truth), 1e-12));
      of.held.add(p.held());
      held.add(p.held());
    }
  }
  ResultTable table{"Parameters of what was named rightly",
                    {"parameter", "times", "median error", "95 % interval holds the truth"},
                    {}};
  for (const auto& [name, of] : by_name)
    table.rows.push_back(
        {name, std::to_string(of.held.of), number_text("%.1f %%", 100.0 * median(of.error)), percent_of(of.held)});
  return table;
}

struct HeldOut {
  std::vector<double> share;  // of what the oracle removes
  std::vector<double> worse;  // with nothing missing, ratio of root mean squares less one
};

HeldOut held_out(const std::vector<Judged>& all) {
  HeldOut h;
  for (const Judged& j : all) {
    if (j.calibrated_m2 <= 0.0) continue;
    if (j.kind == Kind::nothing) h.worse.push_back(std::sqrt(j.with_findings_m2 / j.calibrated_m2) - 1.0);
    const double oracle = j.calibrated_m2 - j.oracle_m2;
    if (j.kind == Kind::one && !j.poor && oracle > kOracleRemoves * j.calibrated_m2)
      h.share.push_back((j.calibrated_m2 - j.with_findings_m2) / oracle);
  }
  return h;
}

void claim(ExperimentReport& report, const std::string& sentence, const Tally& t, bool holds) {
  if (t.of > 0) report.claims.push_back({.sentence = sentence, .holds = holds, .because = text_with_interval(t)});
}

void add_claims(ExperimentReport& report, const std::vector<Judged>& all, const Tally& held) {
  const Cases nulls = those(all, [](const Judged& j) { return j.kind == Kind::nothing; });
  const Tally alarms = tally(nulls, alarm);
  claim(report, "with nothing missing, a name or \"unknown\" in at most 3 %", alarms, alarms.share() <= 0.03);
  const double least[3] = {0.99, 0.98, 0.90};
  for (Level level : {Level::strong, Level::medium, Level::weak}) {
    const Tally first = tally(those(all, of_level(level)), right_first);
    const double bar = least[static_cast<int>(level)];
    claim(report,
          std::string("one ") + name_of(level) + " effect: named first in at least " +
              number_text("%.0f %%", 100.0 * bar),
          first, first.share() >= bar);
  }
  for (Level level : {Level::strong, Level::medium, Level::weak}) {
    const Tally wrong =
        tally(those(all, [level](const Judged& j) { return j.kind == Kind::one && j.level == level; }), wrong_alone);
    claim(report, std::string("one ") + name_of(level) + " effect, any drives: a name alone and wrong in at most 2 %",
          wrong, wrong.share() <= 0.02);
  }
  const Tally both = tally(those(all, concealed_of(Kind::two)), [](const Judged& j) { return j.only_those; });
  claim(report, "two at once: both, and only both, in at least 90 %", both, both.share() >= 0.9);
  const Cases outside = those(all, concealed_of(Kind::outside));
  const Tally unknown = tally(outside, says(Verdict::unknown_effect));
  const Tally misnamed =
      tally(outside, [](const Judged& j) { return j.verdict == Verdict::found || j.verdict == Verdict::ambiguous; });
  claim(report, "outside the catalogue: called unknown in at least 90 %", unknown, unknown.share() >= 0.9);
  claim(report, "outside the catalogue: given a name in at most 5 %", misnamed, misnamed.share() <= 0.05);
  Tally place, time, time_that_tells;
  for (const Judged& j : all) {
    if (j.place_error_m) place.add(*j.place_error_m <= 0.2);
    if (j.time_error_s) time.add(*j.time_error_s <= 0.5);
    if (j.time_error_s && j.first_half_second_sigma.value_or(kTellsTime_sigma) >= kTellsTime_sigma)
      time_that_tells.add(*j.time_error_s <= 0.5);
  }
  claim(report, "zones and bumps: place within 0.2 m in at least 90 % of those named first", place,
        place.share() >= 0.9);
  claim(report, "events: time within 0.5 s in at least 90 % of those named first", time, time.share() >= 0.9);
  claim(report,
        "the same of those whose first half second is 2.8 sigma, from where on nine of ten times can be known so well",
        time_that_tells, time_that_tells.share() >= 0.9);
  claim(report, "parameters: 95 % intervals hold the truth in 90 to 98 %", held,
        held.share() >= 0.9 && held.share() <= 0.98);
  const HeldOut h = held_out(all);
  if (!h.share.empty())
    report.claims.push_back(
        {.sentence = "one effect, held-out error removed, as a share of what the oracle removes: median at least 0.9",
         .holds = median(h.share) >= 0.9,
         .because = "median " + number_text("%.2f", median(h.share)) + " of " + std::to_string(h.share.size()) +
                    " cases in which the oracle removes more than " + number_text("%.0f %%", 100.0 * kOracleRemoves) +
                    " of the squared error"});
  if (!h.worse.empty()) {
    const double most = *std::max_element(h.worse.begin(), h.worse.end());
    report.claims.push_back(
        {.sentence = "with nothing missing, held-out error never worse than calibrated-only by more than 1 %",
         .holds = most <= 0.01,
         .because = "worst " + number_text("%+.2f %%", 100.0 * most) + " of " + std::to_string(h.worse.size())});
  }
}

}  // namespace

ExperimentReport report_of(const std::vector<Judged>& all) {
  ExperimentReport report;
  if (all.empty()) return report;
  report.tables.push_back(by_level(groups_of(all)));
  if (ResultTable table = confusion(all); !table.rows.empty()) report.tables.push_back(table);
  report.tables.push_back(concealment_table(all));
  if (ResultTable table = alarms_by_resolution(all); !table.rows.empty()) report.tables.push_back(table);
  Tally held;
  if (ResultTable table = parameters_table(all, held); !table.rows.empty()) report.tables.push_back(table);
  add_claims(report, all, held);

  double off = 0.0;
  int sizes = 0;
  for (const Judged& j : all)
    for (double sigma : j.oracle_sigma) off += sigma * sigma, ++sizes;
  if (sizes > 0)
    report.notes.push_back("the oracle's own sizes are off by " + number_text("%.2f", std::sqrt(off / sizes)) +
                           " of its standard errors, root mean square of " + std::to_string(sizes) + "; 1 is right");
  double seconds = 0.0, longest = 0.0;
  int thrown = 0, drawn = 0, failed = 0;
  for (const Judged& j : all) {
    seconds += j.seconds / static_cast<double>(all.size());
    longest = std::max(longest, j.seconds);
    if (j.kind != Kind::nothing) thrown += j.thrown_away, ++drawn;
    failed += j.failed.empty() ? 0 : 1;
  }
  report.assumptions = {
      "strong, medium, weak: 40, 15 and 6 sigma for a fit that knows the form, beside calibration; two at once and "
      "what is outside the catalogue: strong or medium",
      "bars count cases that are measured to be concealed, on rich drives; squares alone (a seventh of the cases) "
      "count only where a name is alone and wrong",
      "not drawn: the truth's mounting and clock, and a steady toe, which are calibration; faults of the data; lags of "
      "commands"};
  if (failed > 0) report.notes.push_back(std::to_string(failed) + " cases ended with an error");
  report.notes.push_back(
      "diagnosis took " + number_text("%.1f s", seconds) + " a case, at most " + number_text("%.1f s", longest) +
      ", with as many cases at once as there are cores (the one figure here that differs from run to run)");
  if (drawn > 0)
    report.notes.push_back(std::to_string(thrown) + " draws beside the " + std::to_string(drawn) +
                           " cases were thrown away: those drives could not show that effect at that strength");
  return report;
}

}  // namespace odolab::concealed
