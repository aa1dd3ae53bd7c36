// How large an effect would have had to be to be seen in these recordings: core/diagnosis/README.md, Eq. 13.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/model/joint_model.h"

namespace odolab {

constexpr double kPower = 1.2816;  // normal quantile of 90 %

// An entry of the catalogue at a typical shape, and what would have been seen of it.
struct Visible {
  const Effect* effect = nullptr;
  std::vector<double> shape;
  double needed = 1e9;    // smallest size that would have been seen, in units of the medium one
  double standard = 0.0;  // standard deviations of the weakest amplitude that are needed
  double survives = 0.0;
  double inflation = 1.0;
  int weakest = 0;  // amplitude
  bool excited = false;
  // What calibration would do for a medium one: the column of the model that moves most, in its standard errors, and by
  // how much. Columns 0 to 5 are radii, wheelbase and mounting, then come the clocks.
  int bends = -1;
  double bends_by = 0.0;
};

// The entries of the catalogue that are not in the model, once for each part that may have them, in the form that shows
// clearest. `family_wise_error`: of the test that a size must pass.
std::vector<Visible> visible(const JointModel& joint, double family_wise_error);

// Of each effect the part on which it shows least.
std::vector<Visible> least_visible(const std::vector<Visible>& visible);

// Those of which a medium size would not have been seen.
std::vector<Visible> unseen(const std::vector<Visible>& visible);

// That size. Unset where none of any size that it can have would have been seen.
std::optional<FoundParameter> least_seen(const Visible& visible);

// Why not, in words.
std::string because_of(const Visible& v);

}  // namespace odolab
