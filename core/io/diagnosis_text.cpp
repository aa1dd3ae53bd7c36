#include "core/io/diagnosis_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "core/base/formatted.h"
#include "core/base/two_digits.h"
#include "core/diagnosis/chosen_model.h"
#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/refuted.h"
#include "core/geometry/angles.h"
#include "core/io/number_text.h"
#include "core/io/regime_words.h"
#include "core/io/verdict_sentence.h"
#include "core/io/window_words.h"
#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

std::string more_of(std::size_t count, const char* one, const char* several) {
  return count == 1 ? one : number_text(several, static_cast<double>(count));
}

constexpr const char* kPlusMinus = " \xC2\xB1 ";

std::string decimals_of(double value, int decimals) { return formatted("%.*f", std::clamp(decimals, 0, 9), value); }

int exponent_of(double value) {
  return static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-6));
}  // 0.0999999 is 0.1

// What a unit becomes on the screen, and by what its numbers are multiplied.
struct Shown {
  double factor;
  std::string unit;
};

bool begins_with_unit(const std::string& unit, const std::string& with) {
  return unit == with || unit.rfind(with + "/", 0) == 0 || unit.rfind(with + " ", 0) == 0;
}

Shown shown_as(const std::string& unit) {
  if (unit.empty()) return {1.0, ""};
  if (begins_with_unit(unit, "m")) return {1e3, " mm" + unit.substr(1)};
  if (begins_with_unit(unit, "rad")) return {degrees(1.0), "\xC2\xB0" + unit.substr(3)};
  if (unit == "1") return {100.0, " %"};
  if (unit.rfind("1/", 0) == 0) return {100.0, " % per " + unit.substr(2)};
  return {1.0, " " + unit};
}

// Broken between words; every line but the first is indented by `indent`.
void append_wrapped(std::vector<std::string>& lines, const std::string& text, std::size_t columns,
                    const std::string& indent) {
  std::size_t from = std::min(text.find_first_not_of(' '), text.size());
  std::string line = text.substr(0, from);
  bool empty = true;
  while (from < text.size()) {
    std::size_t to = text.find(' ', from);
    if (to == std::string::npos) to = text.size();
    const std::string word = text.substr(from, to - from);
    if (!empty && line.size() + 1 + word.size() > columns) {
      lines.push_back(line);
      line = indent + word;
    } else {
      line += (empty ? "" : " ") + word;
    }
    empty = false;
    from = to + 1;
  }
  if (!empty) lines.push_back(line);
}

std::string p_value_text(double p) { return p < 1e-15 ? "p < 1e-15" : number_text("p = %.1g", p); }

// Of several that are alike, one for each recording: "rate_3".
bool is_numbered(const std::string& parameter) {
  const std::size_t last = parameter.find_last_not_of("0123456789");
  return last != std::string::npos && last + 1 < parameter.size() && parameter[last] == '_';
}

std::string finding_line(const Finding& f) {
  std::string line = effect_text(f.effect, f.component);
  if (!f.sentence.empty() && f.effect != "unknown") line += ": " + f.sentence;
  std::string parameters;
  std::vector<const FoundParameter*> of_recordings;  // one of each: rate_1, rate_2, ...
  for (const FoundParameter& p : f.parameters) {
    if (p.name == kSessionStart) continue;  // given, not found
    if (p.name == kStatedAt) {
      parameters += " at " + size_text(p.value, p.unit);
      continue;
    }
    if (is_numbered(p.name)) {
      of_recordings.push_back(&p);
      continue;
    }
    parameters += (parameters.empty() ? "; " : ", ") + parameter_words(p.name) + " " +
                  quantity_text(p.value, p.stderr_value, p.unit);
  }
  if (!of_recordings.empty()) {
    const auto [low, high] = std::minmax_element(of_recordings.begin(), of_recordings.end(),
                                                 [](const auto* a, const auto* b) { return a->value < b->value; });
    parameters += ", from recording to recording " + size_text((*low)->value, (*low)->unit) + " to " +
                  size_text((*high)->value, (*high)->unit);
  }
  line += parameters;
  const std::string where = where_text(f.where);
  if (!where.empty()) line += "; " + where;
  if (!f.form_in_words.empty()) line += "; its form: " + f.form_in_words;
  if (f.log_likelihood_gain > 0.0)
    line += number_text("; gain %.1f", f.log_likelihood_gain) + ", " + p_value_text(f.p_value);
  if (f.share_of_mismatch > 0.0 && f.effect != "unknown")  // which no model has: it takes nothing away
    line += number_text(", %.0f %% of the mismatch", 100.0 * f.share_of_mismatch);
  if (f.moves) line += "; where it acts it moves each metre or radian by " + moved_text(*f.moves);
  return line;
}

std::string fit_line(const char* name, const FitTable& table, bool any_findings) {
  std::string line;
  const auto add = [&](const char* what, const std::optional<FitFigures>& f) {
    if (f) line += (line.empty() ? "" : "  ->  ") + std::string(what) + " " + figures_text(*f);
  };
  if (table.with_findings && !table.with_findings->gathered())
    return std::string(name) + "not to be had: it takes a metre of truth";
  add("nominal", table.nominal);
  add("calibrated", table.calibrated);
  if (any_findings) add("with findings", table.with_findings);
  if (table.noise_floor) line += "   (noise " + figures_text(*table.noise_floor) + ")";
  return line.empty() ? "" : name + line;
}

}  // namespace

std::string list_of(const std::vector<std::string>& words, const char* last_word) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? std::string(" ") + last_word + " " : ", ") + words[i];
  return text;
}

bool is_fault(const Finding& finding) {
  return is_data_fault(finding.effect) ||
         (finding.effect == "truth_mounting_offset" && !finding.where.recording.empty());
}

bool is_of_the_measurement(const Finding& finding) {
  return is_of_the_truth(finding.effect) || finding.effect == "clock_rate";
}

bool is_switched_on(const FitTable& simulation) {
  const std::optional<FitFigures>&before = simulation.calibrated, &after = simulation.with_findings;
  if (!before || !after) return after.has_value();
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  return !same(before->position_rms_m, after->position_rms_m) ||
         !same(before->heading_rms_rad, after->heading_rms_rad) ||
         !same(before->normalised_chi2, after->normalised_chi2);
}

std::string figures_text(const FitFigures& f) {
  return number_text("%.2f mm", 1e3 * f.position_rms_m) +
         (f.has_heading() ? number_text(", %.3f\xC2\xB0", degrees(f.heading_rms_rad)) : "");
}

std::string effect_text(const std::string& effect, const std::string& component) {
  if (effect == "unknown")
    return component.empty() ? "an effect in no list" : "an effect in no list, of " + component_words(component);
  std::string text = effect_words(effect);
  // "truth frozen of the truth" says it twice
  if (!component.empty() && effect.rfind(component, 0) != 0) text += " of " + component_words(component);
  return text;
}

std::string quantity_text(double value, double stderr_value, const std::string& unit) {
  const Shown shown = shown_as(unit);
  value *= shown.factor;
  const double error = std::abs(stderr_value * shown.factor);
  const bool has_error = std::isfinite(error) && error > 0.0;
  const int value_exponent = value != 0.0 ? exponent_of(value) : has_error ? exponent_of(error) : 0;
  // two digits of the error, or four of a value that has none
  const int decimals = has_error ? 1 - exponent_of(error) : 3 - value_exponent;
  if (std::max(value_exponent, has_error ? exponent_of(error) : value_exponent) < -4) {
    std::string text = number_text("%.3g", value);
    if (has_error) text += kPlusMinus + number_text("%.1e", error);
    return text + shown.unit;
  }
  std::string text = decimals_of(value, decimals);
  if (has_error) text += kPlusMinus + decimals_of(error, decimals);
  return text + shown.unit;
}

std::string size_text(double value, const std::string& unit) {
  const Shown shown = shown_as(unit);
  return two_digits(value * shown.factor) + shown.unit;
}

std::string moved_text(const MovedTrack& moved) {
  return size_text(moved.position_rms_m, "m") + ", " + size_text(moved.heading_rms_rad, "rad");
}

std::string where_text(const WhereFound& where) {
  std::vector<std::string> parts;
  std::string when = where.recording.empty() ? "" : "in " + where.recording;
  const std::size_t shown = std::min<std::size_t>(where.time_s.size(), 3);
  for (std::size_t i = 0; i < shown; ++i) {
    const auto [from_s, to_s] = where.time_s[i];
    when += (when.empty() ? ""
             : i == 0     ? " at "
                          : ", ") +
            (to_s > from_s ? number_text("%.2f to ", from_s) : std::string()) + number_text("%.2f s", to_s);
  }
  if (where.time_s.size() > shown)
    when += more_of(where.time_s.size() - shown, " and once more", " and %.0f times more");
  constexpr std::size_t kMostNames = 2;
  if (where.other_recordings.size() > kMostNames)
    when += number_text(", and in %.0f others", static_cast<double>(where.other_recordings.size()));
  else if (!where.other_recordings.empty())
    when += ", and in " + list_of(where.other_recordings, "and");
  if (!when.empty()) parts.push_back(when);
  if (where.zone)
    parts.push_back(number_text("within %.2f m", where.zone->radius_m) + number_text(" of x %.2f", where.zone->x_m) +
                    number_text(", y %.2f m", where.zone->y_m));
  if (!where.regime.empty()) parts.push_back(regime_in_words(where.regime));
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : "; ") + part;
  return text;
}

std::vector<Finding> faults_together(const std::vector<Finding>& findings) {
  constexpr std::size_t kMostSaid = 4;
  std::vector<Finding> together;
  for (const Finding& first : findings) {
    if (!is_data_fault(first.effect)) {
      together.push_back(first);
      continue;
    }
    if (std::any_of(together.begin(), together.end(), [&](const Finding& f) { return f.effect == first.effect; }))
      continue;
    std::vector<const Finding*> alike;
    for (const Finding& f : findings)
      if (f.effect == first.effect) alike.push_back(&f);
    if (alike.size() == 1) {
      together.push_back(first);
      continue;
    }
    const bool of_one_part =
        std::all_of(alike.begin(), alike.end(), [&](const Finding* f) { return f->component == first.component; });
    Finding all;
    all.effect = first.effect;
    all.component = of_one_part ? first.component : "";
    for (std::size_t i = 0; i < std::min(alike.size(), kMostSaid); ++i)
      all.where.regime += (i == 0 ? "" : "; ") + where_text(alike[i]->where) +
                          (of_one_part ? "" : " (" + component_words(alike[i]->component) + ")");
    if (alike.size() > kMostSaid)
      all.where.regime += more_of(alike.size() - kMostSaid, "; and in one recording or part more",
                                  "; and in %.0f recordings or parts more");
    std::size_t times = 0;
    for (const Finding* f : alike) times += f->where.time_s.size();
    all.sentence = std::to_string(times) + " times in all, left out";
    together.push_back(all);
  }
  return together;
}

std::vector<std::string> merged_warnings(const std::vector<std::string>& warnings) {
  struct Said {
    std::string name, text, kind;  // `kind`: the text but for its figures
    int times = 1;
  };
  std::vector<Said> all;
  for (const std::string& warning : warnings) {
    Said one;
    const std::size_t colon = warning.find(": ");
    if (colon != std::string::npos && warning.rfind(".csv", colon) != std::string::npos)
      one.name = warning.substr(0, colon), one.text = warning.substr(colon);
    else
      one.text = warning;
    for (const char c : one.text)
      if ((c < '0' || c > '9') && c != '.' && c != '-') one.kind += c;
    const auto same = std::find_if(all.begin(), all.end(), [&](const Said& s) {
      return s.kind == one.kind && !s.name.empty() && !one.name.empty();
    });
    if (same != all.end())
      ++same->times;
    else
      all.push_back(one);
  }
  std::vector<std::string> merged;
  for (const Said& s : all)
    merged.push_back(s.name +
                     (s.times > 1 ? more_of(static_cast<std::size_t>(s.times - 1), " and another like it",
                                            " and %.0f others like it")
                                  : "") +
                     s.text);
  return merged;
}

namespace {

std::vector<std::string> finding_lines(std::size_t number, const Finding& f, std::size_t columns) {
  std::vector<std::string> lines;
  append_wrapped(lines, std::to_string(number) + ". " + finding_line(f), columns, "   ");
  if (f.alternatives.empty()) return lines;
  const Alternative& a = f.alternatives.front();
  std::string other =
      (f.effect == "unknown" ? std::string("   resembles, without sufficing: ") : std::string("   not beaten: ")) +
      effect_text(a.effect, a.component) + number_text(" (gain %.1f)", a.log_likelihood_gain);
  if (f.alternatives.size() > 1) other += number_text(" and %.0f more", static_cast<double>(f.alternatives.size() - 1));
  if (!a.told_apart_by.empty()) other += "; told apart by " + regime_in_words(a.told_apart_by);
  append_wrapped(lines, other, columns, "   ");
  return lines;
}

std::vector<std::string> calibration_and_proof(const Diagnosis& diagnosis, std::size_t columns) {
  std::vector<std::string> end;
  std::vector<const ParameterEstimate*> lengths;
  for (const ParameterEstimate& p : diagnosis.calibration.parameters)
    if (p.determined && p.name.rfind("truth_mounting.", 0) != 0 &&
        (p.unit == "m" || p.name.find('.') == std::string::npos))
      lengths.push_back(&p);
  constexpr std::size_t kMostLengths = 8;
  std::string calibration;
  if (lengths.size() > kMostLengths)
    calibration = std::to_string(lengths.size()) + " parameters of its parts, which --json and --html list";
  else
    for (const ParameterEstimate* p : lengths)
      calibration += (calibration.empty() ? "" : ", ") + parameter_words(p->name) + " " +
                     quantity_text(p->value, p->stderr_value, p->unit);
  if (!calibration.empty() && diagnosis.calibration.scale_is_open)
    calibration +=
        "; only their ratios show here: the mean radius is the vehicle file's, and nothing says how true it is";
  if (!calibration.empty()) append_wrapped(end, "calibrated: " + calibration, columns, "   ");
  if (diagnosis.train.calibrated || diagnosis.held_out.calibrated)
    end.push_back("off " + over_which_way(diagnosis.train_over.value_or(WindowSize{})) + ":");
  const bool any_findings = any_is_put_in(diagnosis);
  for (const std::string& line :
       {fit_line("   fitted on: ", diagnosis.train, any_findings),
        fit_line(diagnosis.left_out_in_turn ? "   each run by the others: " : "   held out:  ", diagnosis.held_out,
                 any_findings) +
            (is_refuted_by_unseen(diagnosis) ? ": it does not bear this out" : "")})
    if (!line.empty()) end.push_back(line);
  if (diagnosis.unseen_gain)
    end.push_back("   unseen, the recordings are " +
                  number_text(*diagnosis.unseen_gain < 0.0 ? "less likely by %.1f" : "likelier by %.1f",
                              std::abs(*diagnosis.unseen_gain)) +
                  " with the findings (log-likelihood)");
  if (diagnosis.simulation.calibrated && diagnosis.simulation.with_findings) {
    const FitFigures &before = *diagnosis.simulation.calibrated, &after = *diagnosis.simulation.with_findings;
    std::vector<std::string> beyond;
    for (const Finding& f : beyond_the_simulator(diagnosis)) beyond.push_back(effect_text(f.effect, f.component));
    const std::string with_findings =
        any_findings && is_switched_on(diagnosis.simulation) ? "  ->  with findings " + figures_text(after) : "";
    end.push_back("   simulator: calibrated " + figures_text(before) + with_findings +
                  (is_refuted_by_simulator(diagnosis) ? ": it does not confirm this" : ""));
    if (!beyond.empty())
      append_wrapped(end, "   it neither confirms nor refutes: it cannot play " + list_of(beyond, "and"), columns,
                     "      ");
  }
  if (!diagnosis.not_testable.empty()) {
    std::vector<std::string> names;
    for (const NotTestable& n : diagnosis.not_testable) names.push_back(effect_words(n.effect));
    append_wrapped(end, "could not show here: " + list_of(names, "and"), columns, "   ");
  }
  if (!diagnosis.next_drive.empty()) {
    const bool is_a_drive = diagnosis.next_drive.rfind("a look ", 0) != 0;
    append_wrapped(end, (is_a_drive ? "drive next: " : "next: ") + diagnosis.next_drive, columns, "   ");
  }
  return end;
}

}  // namespace

std::vector<std::string> summary_lines(const Diagnosis& diagnosis, std::size_t most_lines, std::size_t columns) {
  std::vector<std::string> lines;
  append_wrapped(lines, verdict_sentence(diagnosis), columns, "");
  const std::vector<std::string> end = calibration_and_proof(diagnosis, columns);

  constexpr std::size_t kMostFindings = 4;
  // In the order of the sentence above, so that what it names is what is listed: a marker that is off shows a hundred
  // times as strongly as what is looked for. The rest stays the strongest first.
  std::vector<Finding> physics_first = faults_together(diagnosis.findings);
  const auto rank = [&](const Finding& f) {
    const bool is_open = diagnosis.verdict == Verdict::ambiguous && f.effect != "unknown" && !f.alternatives.empty();
    return is_fault(f) ? 3 : is_of_the_measurement(f) ? 2 : is_open ? 1 : 0;
  };
  std::stable_sort(physics_first.begin(), physics_first.end(),
                   [&](const Finding& a, const Finding& b) { return rank(a) < rank(b); });
  // Each as a whole or not at all; the last line is kept for how many more there are.
  std::size_t said = 0;
  for (; said < std::min(physics_first.size(), kMostFindings); ++said) {
    const std::vector<std::string> one = finding_lines(said + 1, physics_first[said], columns);
    if (said > 0 && lines.size() + one.size() + 1 + end.size() > most_lines) break;
    lines.insert(lines.end(), one.begin(), one.end());
  }
  if (said < physics_first.size())
    lines.push_back(more_of(physics_first.size() - said, "   and one finding more", "   and %.0f findings more") +
                    ": --json and --html have all");
  if (lines.size() + end.size() > most_lines) lines.resize(most_lines > end.size() ? most_lines - end.size() : 1);
  lines.insert(lines.end(), end.begin(), end.end());
  if (lines.size() > most_lines) lines.resize(most_lines);
  return lines;
}

}  // namespace odolab
