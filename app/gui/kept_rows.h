// Which rows of a long run, pictures or samples, are kept for looking back: all of the last half minute, and of what
// lies before ever fewer, so that memory grows with the logarithm of the time, or with a part of it and up to a bound.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace odolab {

class KeptRows {
 public:
  static constexpr std::int64_t kAllOf = 1500;  // rows: half a minute of them, 20 ms apart

  // However old, every `widest`th row stays, a power of two; where these are more than `most`, it becomes twice as
  // wide.
  explicit KeptRows(std::int64_t widest = std::int64_t(1) << 40, std::size_t most = std::size_t(-1))
      : widest_(widest), most_(most) {}

  // One more row, behind the others.
  void add() { numbers_.push_back(next_++); }
  // How many are kept.
  std::size_t size() const { return numbers_.size(); }
  // Their numbers, counted from the start of the run.
  const std::vector<std::int64_t>& numbers() const { return numbers_; }
  // Now and then: which of the kept ones stay, an entry each, true for the first and for all that are not yet half
  // a minute old. Of rows of twice the age, half as many stay. Empty where nothing is to be dropped. What is dropped is
  // gone from numbers(); whoever keeps the rows calls keep_only with the answer.
  std::vector<bool> thin();

 private:
  std::int64_t widest_;
  std::size_t most_;
  std::vector<std::int64_t> numbers_;
  std::int64_t next_ = 0, thinned_at_ = 0;
};

template <typename Row>
void keep_only(const std::vector<bool>& stays, std::vector<Row>& rows) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (stays[i]) {
      if (kept != i) rows[kept] = std::move(rows[i]);
      ++kept;
    }
  rows.erase(rows.begin() + std::ptrdiff_t(kept), rows.end());
}

}  // namespace odolab
