#include "app/gui/kept_rows.h"

namespace odolab {

namespace {

constexpr std::int64_t kEvery = 500;  // rows between two thinnings, which walk through all that are kept

// Every how manieth row of an age stays: each, from half a minute on every second, from a minute on every fourth.
std::int64_t spacing(std::int64_t age, std::int64_t widest) {
  std::int64_t every = 1;
  for (; age >= KeptRows::kAllOf && every < widest; age /= 2) every *= 2;
  return every;
}

}  // namespace

std::vector<bool> KeptRows::thin() {
  if (next_ - thinned_at_ < kEvery) return {};
  thinned_at_ = next_;
  if (numbers_.size() > most_) widest_ *= 2;
  std::vector<bool> stays(numbers_.size());
  bool all = true;
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    stays[i] = numbers_[i] % spacing(next_ - 1 - numbers_[i], widest_) == 0;
    all = all && stays[i];
  }
  if (all) return {};
  keep_only(stays, numbers_);
  return stays;
}

}  // namespace odolab
