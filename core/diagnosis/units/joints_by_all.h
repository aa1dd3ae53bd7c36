// What joints read, as all units of a vehicle tell it together beside an outside truth that is fine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/units/geometry_fit.h"

namespace odolab {

struct ToldByAll {
  std::optional<Finding> erring;  // without a name: an encoder that errs otherwise than by a bias
  // How many times as much as was found there is of something that lasts on a unit.
  struct Size {
    std::size_t unit;
    ActiveEffect found;
    double times, stderr_of_times;
  };
  std::vector<Size> sizes;
};

// Biased encoders of `geometry` anew, where that makes them known better: one filter holds the poses of all units
// (together/), so that the way from one stretch to the next says what it knows, too. `of_units`: beside what was found
// on each and lasts, as much of it as fits best; where something happened, at a place or a moment, what wheels turned
// is a guess. Beside what was found on trucks and trailers the other lengths are told, too. `names`: of the recordings.
ToldByAll tell_joints_by_all(const std::vector<JoinedRun>& runs, const std::vector<Recording>& recordings,
                             const std::vector<std::string>& names, const std::vector<Diagnosis>& of_units,
                             const Vehicle& nominal, double family_wise_error, GeometryFit& geometry);

// Whether anything was found that lasts and moves a unit.
bool act_on_motion(const std::vector<Diagnosis>& of_units);

// What was found on a unit, as large as all units together tell it, where they know that better than its own truth
// does: what joints read is rounded, and that is no white noise.
void put_sizes(const std::vector<ToldByAll::Size>& sizes, std::size_t unit, std::vector<Finding>& findings);

}  // namespace odolab
