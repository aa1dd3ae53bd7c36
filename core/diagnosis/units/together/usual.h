#pragma once

#include "core/diagnosis/units/together/joined_candidates.h"

namespace odolab {

// Whether it is no more than any vehicle does: tyres creep, and no wheel is quite round. Units that tell each other by
// tenths of a millimetre show it, and it is no finding: nothing to be mended, and nothing of it is seen in the room.
// Limits are those of rubber tyres, stiff to slip angles by 6.4 per radian (0.016 rad per m/s2) and to slip by 10, in
// units of what they carry (H. B. Pacejka, Tyre and Vehicle Dynamics, ch. 1), and of 35 um on a radius of 70 mm, which
// no wheel of rubber falls short of.
bool is_usual(const ScoredTogether& s, const JoinedModel& model);

}  // namespace odolab
