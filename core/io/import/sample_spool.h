// Samples of channels that share a clock, taken in as a file gives them and given back in order of time.
#pragma once

#include <cstdint>
#include <cstdio>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace odolab {

// Beyond a first megabyte the samples lie in a nameless file in `spill_folder`, so that memory does not grow with their
// number; without a folder all stay in memory.
class SampleSpool {
 public:
  explicit SampleSpool(std::vector<std::string> channels, std::string spill_folder = "");

  // NaN where a channel was not sampled. Samples that come late are sorted in as long as fewer than 1024 later ones
  // came before them; one that comes later still
  // is left out and counted, as is one more than 146 years from 1970.
  void add(std::int64_t time_ns, const double* values);
  // After the last sample. An error where the folder could not hold them.
  Result<Done> finish();

  const std::vector<std::string>& channels() const { return channels_; }
  std::uint64_t size() const { return samples_; }
  std::uint64_t late() const { return late_; }
  std::uint64_t beyond() const { return beyond_; }
  std::int64_t first_ns() const { return first_ns_ + shift_ns_; }  // of no use where there are none
  std::int64_t last_ns() const { return last_ns_ + shift_ns_; }    // after finish()

  // A channel that only ever stays within a turn and jumps by one is made continuous when it is read back: an angle
  // that was written wrapped.
  void unwrap(std::size_t channel) { angles_[channel].asked = true; }
  bool wraps(std::size_t channel) const;  // after finish()

  // All stamps come back later by this much.
  void shift(std::int64_t by_ns) { shift_ns_ = by_ns; }

  // After finish(), from the first sample on. `values` has as many as there are channels.
  bool next(std::int64_t& time_ns, double* values);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct Angle {
    bool asked = false;
    double previous = 0.0, lowest = 0.0, highest = 0.0;
    bool any = false, jumps = false;
    double turns = 0.0;
  };

  void keep(std::int64_t time_ns, const double* values);
  void spill();
  bool refill();
  std::size_t width() const { return channels_.size() + 1; }

  std::vector<std::string> channels_;
  std::string spill_folder_;
  std::unique_ptr<std::FILE, Close> file_;
  std::string failure_;
  std::vector<double> kept_;  // row by row, the time's 64 bits first
  std::size_t reading_ = 0;
  // the latest samples in order of time: where each row lies in `pending_`
  std::deque<std::size_t> order_;
  std::vector<double> pending_;
  std::vector<std::int64_t> pending_ns_;
  std::uint64_t samples_ = 0, late_ = 0, beyond_ = 0;
  std::int64_t first_ns_ = 0, last_ns_ = 0;
  std::int64_t shift_ns_ = 0;
  std::vector<Angle> angles_;
};

}  // namespace odolab
