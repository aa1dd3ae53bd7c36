// Whether a run is as a scenario or a lesson expects.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/scenario/scenario.h"

namespace odolab {

struct Judgement {
  bool all_hold = true;
  std::string lines;  // how each expectation fared
};

// An Error that begins with `where` where an expectation asks for a figure that this run does not have.
Result<Judgement> judge(const std::vector<Expectation>& expectations,
                        const std::vector<std::pair<std::string, double>>& figures, const std::string& where);

}  // namespace odolab
