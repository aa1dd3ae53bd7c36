// Which runs do not fit the others of their direction: a warning, never a reason to drop them unseen.
#pragma once

#include <vector>

#include "core/guide/guide_session.h"

namespace odolab {

// The rule, in words for the screen.
const char* misfit_rule();

// True for each run of the round that lies further from the median point of its direction than five times the spread.
// The spread is that of a round normal cloud whose median distance is the one found: the median of all distances, both
// directions together, over 1.1774 (Rayleigh), and never below 0.5 mm, the rounding of a tape. Judged from four counted
// runs in the direction on. Of normal runs, five each way, 3.8 % of experiments warn of one wrongly, four each way 6 %.
// Runs left out are judged, too, but not counted for the medians.
std::vector<bool> misfits(const GuideRound& round);

}  // namespace odolab
