#include "core/recording/truth_left_out.h"

#include <limits>

namespace odolab {

bool is_of_truth(const std::string& channel) { return channel.rfind("truth_", 0) == 0; }

void leave_truth_out(Recording& recording, const std::vector<char>& rows) {
  for (Channel& channel : recording.channels)
    if (is_of_truth(channel.name))
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i]) channel.values[i] = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace odolab
