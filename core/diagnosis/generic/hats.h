// Piecewise linear functions of one variable: each is one at its own place and nothing at its neighbours' and beyond.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace odolab {

// Where hats stand, in order. Together they are one everywhere; beyond either end the last one stays.
class Hats {
 public:
  Hats() = default;
  explicit Hats(std::vector<double> at) : at_(std::move(at)) {}

  const std::vector<double>& at() const { return at_; }
  std::size_t size() const { return at_.size(); }

  // What each comes to: all but two are nothing.
  struct Shares {
    std::size_t first = 0;  // the other is the next one
    double of_first = 1.0, of_next = 0.0;
  };
  Shares of(double x) const {
    if (at_.size() < 2) return {};
    const auto next = std::clamp<std::ptrdiff_t>(std::lower_bound(at_.begin(), at_.end(), x) - at_.begin(), 1,
                                                 static_cast<std::ptrdiff_t>(at_.size()) - 1);
    const auto k = static_cast<std::size_t>(next - 1);
    const double share = std::clamp((x - at_[k]) / (at_[k + 1] - at_[k]), 0.0, 1.0);
    return {k, 1.0 - share, share};
  }
  // One of them.
  double of(std::size_t k, double x) const {
    const Shares s = of(x);
    return k == s.first ? s.of_first : k == s.first + 1 ? s.of_next : 0.0;
  }

 private:
  std::vector<double> at_;
};

}  // namespace odolab
