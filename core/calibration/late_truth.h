// A truth whose clock is seconds off the wheels', for those who have to say why the two contradict each other.
#pragma once

#include <optional>
#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

// By how much later than the wheels' stamps the truth's are, to a tenth of a second: the lag within a minute at which
// wheels and truth turn (or, without headings, go) together, where they plainly do at one and not as they are stamped.
// None where that is not so in all runs, or not by about the same lag.
std::optional<double> late_truth_s(const std::vector<InnovationRun>& runs);

}  // namespace odolab
