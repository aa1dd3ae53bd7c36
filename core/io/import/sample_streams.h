// What the sources of one run brought: streams of samples on one clock, made into one recording.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/io/import/sample_spool.h"
#include "core/recording/recording.h"

namespace odolab {

struct SampleStreams {
  std::deque<SampleSpool> streams;
  std::vector<std::string> sources;   // the name of the one that each stream comes from
  std::string source;                 // that of streams that are added now
  std::vector<std::string> warnings;  // what a person should know, a sentence each
  std::string name, provenance;       // as in Recording
  bool several_sources = false;       // then each may bring some of what was asked for
  std::string spill_folder;           // where samples may lie while they are sorted; empty: in memory
  Progress progress;                  // of reading and writing; where it says to stop, what was read so far is no use

  SampleSpool& add_stream(std::vector<std::string> channels);
};

// What a function returns whose progress said to stop.
Error stopped(const std::string& path);

// Rows in order of time, the first one at 0; samples with the same stamp share a row. The streams are used up. An error
// where there is no sample, or where two streams bring the same channel.
Result<Recording> recording_of(SampleStreams& streams);

struct WrittenRecording {
  std::uint64_t rows = 0;
  double duration_s = 0.0;
  std::vector<std::string> channels;
};

// The same rows straight into a recording's CSV file, in memory that does not grow with them. The file is the one that
// write_recording_csv writes of recording_of, to the byte; nothing half-written is left.
Result<WrittenRecording> write_streams_csv(const std::string& path, SampleStreams& streams);

}  // namespace odolab
