// Which topics and joints of a bag make a recording: by themselves where that is plain, by name where it is not.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/io/bag/bag.h"
#include "core/io/import/import_wishes.h"
#include "core/io/import/transform_chain.h"

namespace odolab {

// Empty names where the bag has none.
struct BagChoice {
  std::string wheels, left_joint, right_joint;
  std::string commands;
  std::string truth;                      // a topic; of transforms TOPIC:PARENT:CHILD
  std::vector<TransformHop> truth_chain;  // of transforms alone
  std::vector<std::string> warnings;
};

// The two joints that are the drive wheels, by their names; empty where that is not plain.
std::pair<std::string, std::string> wheel_joints(const std::vector<std::string>& joints);

// Errors where a wish names what is not there, or where several would do: they list what there is and the option that
// decides.
Result<BagChoice> chosen_of_bag(const std::string& path, const BagContents& contents, const ImportWishes& wishes);

}  // namespace odolab
