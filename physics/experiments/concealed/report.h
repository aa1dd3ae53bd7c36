// All judged cases as one report: tables by level of strength, and the bars as claims.
#pragma once

#include <vector>

#include "physics/experiments/concealed/judged.h"
#include "physics/experiments/experiment.h"

namespace odolab::concealed {

ExperimentReport report_of(const std::vector<Judged>& cases);

}  // namespace odolab::concealed
