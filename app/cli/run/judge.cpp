#include "app/cli/run/judge.h"

#include "app/cli/terminal.h"

namespace odolab {

Result<Judgement> judge(const std::vector<Expectation>& expectations,
                        const std::vector<std::pair<std::string, double>>& figures, const std::string& where) {
  Judgement judgement;
  for (const Expectation& e : expectations) {
    const double* value = nullptr;
    std::string known;
    for (const auto& [name, figure] : figures) {
      if (name == e.figure) value = &figure;
      known += (known.empty() ? "" : ", ") + name;
    }
    if (!value) return Error{where, "the figure '" + e.figure + "'", "one of " + known};
    const bool holds = (!e.at_least || *value >= *e.at_least) && (!e.at_most || *value <= *e.at_most);
    judgement.all_hold = judgement.all_hold && holds;
    std::string range;
    if (e.at_least) range += text_of(" at least %g", *e.at_least);
    if (e.at_most) range += text_of("%s at most %g", e.at_least ? " and" : "", *e.at_most);
    judgement.lines +=
        text_of("%s: %s is %g, expected%s\n", holds ? "ok" : "FAILED", e.figure.c_str(), *value, range.c_str());
  }
  return judgement;
}

}  // namespace odolab
