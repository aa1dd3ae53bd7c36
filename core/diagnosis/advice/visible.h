// How large an effect would have had to be to be seen in these recordings: README.md, Eq. 13.
#pragma once

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
};

// The entries of the catalogue of which a medium size would not have been seen, each effect once. `family_wise_error`:
// of the test that a size must pass.
std::vector<Visible> unseen(const JointModel& joint, double family_wise_error);

// Why not, in words.
std::string because_of(const Visible& v);

}  // namespace odolab
