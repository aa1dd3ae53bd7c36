// Numbers that only become more, kept outside of memory in a nameless temporary file: a kill leaves nothing behind.
#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <vector>

#include "core/base/result.h"

namespace odolab {

class TemporaryNumbers {
 public:
  // Where no file can be made or the disk is full they stay in memory; nothing is lost.
  void append(const std::vector<double>& numbers);
  std::size_t size() const { return written_ + in_memory_.size(); }
  // All of them in order, to the bit; an error where the file can no longer be read.
  Result<std::vector<double>> all() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  bool has_failed_ = false;
  std::size_t written_ = 0;
  std::vector<double> in_memory_;
};

}  // namespace odolab
