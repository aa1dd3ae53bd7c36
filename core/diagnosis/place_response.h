// What the mismatch depends on by place: drawn as the responses to the variables of the motion are.
#pragma once

#include <vector>

#include "core/diagnosis/diagnosis.h"

namespace odolab {

// Turn, way forward and sideways that calibration leaves in strips of equal width over the room's x, and over its y,
// wherever the recordings went: the sum of a strip's innovations in times what noise would sum up to, so that 2 to
// either side is a 95 % band. They are not given per metre: a filter corrects a part of a mismatch at each sample, and
// its innovations say that it is there, not how large. A strip with few samples has no point. `found`: there are
// findings, whose residuals go beside. Empty where the recordings stayed at one place.
std::vector<Response> place_responses(const std::vector<Residuals>& before, const std::vector<Residuals>& after,
                                      bool found);

// The mismatch in rings about a patch of floor or a bump, by its `name` in words, as far as three of its radii and 0.6
// m: its mean, in times the noise, as it is coloured along the tracks. No ring with few samples; empty where fewer than
// two are left.
inline constexpr const char* kMismatchAboutPlace = "mismatch [times the noise]";
Response zone_response(const WhereFound::Zone& zone, const std::string& name, const std::vector<Residuals>& before,
                       const std::vector<Residuals>& after);

}  // namespace odolab
