// The motion that something adds to each wheel interval of a run.
#pragma once

#include <cstddef>
#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

// Nothing happens outside steps [first(), end()); what lasts a moment costs no more than that.
class Motions {
 public:
  Motions() = default;
  explicit Motions(std::size_t steps) : of_(steps) {}
  Motions(std::size_t first, std::size_t end) : first_(first), of_(end - first) {}

  std::size_t first() const { return first_; }
  std::size_t end() const { return first_ + of_.size(); }
  bool empty() const { return of_.empty(); }
  void reserve(std::size_t steps) { of_.reserve(steps); }
  void push_back(const BodyMotion& m) { of_.push_back(m); }
  // `step` is within [first(), end()).
  BodyMotion& operator[](std::size_t step) { return of_[step - first_]; }
  const BodyMotion& operator[](std::size_t step) const { return of_[step - first_]; }
  // Of any step of the run.
  BodyMotion at(std::size_t step) const { return step < first_ || step >= end() ? BodyMotion{} : of_[step - first_]; }
  // Adds so much of it to a run's steps.
  void add_to(std::vector<BodyMotion>& sum, double value) const {
    for (std::size_t i = 0; i < of_.size(); ++i) {
      BodyMotion& s = sum[first_ + i];
      s.forward_m += value * of_[i].forward_m;
      s.sideways_m += value * of_[i].sideways_m;
      s.turn_rad += value * of_[i].turn_rad;
    }
  }

 private:
  std::size_t first_ = 0;
  std::vector<BodyMotion> of_;
};

}  // namespace odolab
