// The truth of a source as a stream, and what is odd about it.
#pragma once

#include "core/io/import/planar_pose.h"
#include "core/io/import/sample_streams.h"

namespace odolab {

class TruthStream {
 public:
  TruthStream(SampleStreams& streams, SpaceAxes axes)
      : spool_(streams.add_stream({"truth_x_m", "truth_y_m", "truth_heading_rad"})), axes_(axes) {}

  // False, and nothing kept, where the position is not finite. A rotation that is none leaves the heading empty.
  bool add(std::int64_t time_ns, const SpacePose& pose);
  // Sentences about `source`.
  void warn(const std::string& source, std::vector<std::string>& warnings) const;

 private:
  SampleSpool& spool_;
  SpaceAxes axes_;
  std::uint64_t poses_ = 0, without_heading_ = 0, tilted_ = 0;
};

}  // namespace odolab
