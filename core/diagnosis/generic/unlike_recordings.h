// Which recordings differ from the others, where something depends on the recording.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace odolab {

// The fewer of those on either side of the widest gap between what is found in each, or the later where both are as
// many; and by how much these are more than the others, in the mean.
struct UnlikeRecordings {
  std::vector<std::size_t> which;
  double more = 0.0;
};
std::optional<UnlikeRecordings> unlike_recordings(const std::vector<double>& of_each);

// As "run_3 and run_4, 3.1 % more than the others"; `per_metre`: radians for each metre; else shares.
std::string in_words(const UnlikeRecordings& unlike, const std::vector<std::string>& names, bool per_metre);

}  // namespace odolab
