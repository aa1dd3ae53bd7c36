#include "app/gui/kept_pictures.h"

namespace odolab {

namespace {

constexpr std::int64_t kEvery = 500;  // pictures between two thinnings, which walk through all that are kept

// Every how manieth picture of an age stays: one, two from a minute on, four from two minutes on.
std::int64_t spacing(std::int64_t age) {
  std::int64_t every = 1;
  for (; age >= KeptPictures::kAllOf; age /= 2) every *= 2;
  return every;
}

}  // namespace

std::vector<bool> KeptPictures::thin() {
  if (next_ - thinned_at_ < kEvery) return {};
  thinned_at_ = next_;
  std::vector<bool> stays(numbers_.size());
  bool all = true;
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    stays[i] = numbers_[i] % spacing(next_ - 1 - numbers_[i]) == 0;
    all = all && stays[i];
  }
  if (all) return {};
  keep_only(stays, numbers_);
  return stays;
}

}  // namespace odolab
