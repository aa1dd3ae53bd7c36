// The motion that something adds to each wheel interval of a run.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/calibration/innovations.h"

namespace odolab {

// Nothing happens outside steps [first(), end()), nor between its stretches: what lasts a moment, or comes back now and
// then, costs no more than that.
class Motions {
 public:
  struct Stretch {
    std::size_t first, end;  // steps
  };

  Motions() = default;
  explicit Motions(std::size_t steps) : Motions(0, steps) {}
  Motions(std::size_t first, std::size_t end) : of_(end - first), stretches_{{first, end}} {}
  // In order and apart.
  explicit Motions(std::vector<Stretch> stretches) : stretches_(std::move(stretches)) {
    std::size_t steps = 0;
    for (const Stretch& s : stretches_) steps += s.end - s.first;
    of_.resize(steps);
  }

  std::size_t first() const { return stretches_.empty() ? 0 : stretches_.front().first; }
  std::size_t end() const { return stretches_.empty() ? 0 : stretches_.back().end; }
  const std::vector<Stretch>& stretches() const { return stretches_; }
  bool empty() const { return of_.empty(); }
  void reserve(std::size_t steps) { of_.reserve(steps); }
  // Of the step behind the last, or of the run's first.
  void push_back(const BodyMotion& m) {
    if (stretches_.empty()) stretches_.push_back({0, 0});
    ++stretches_.back().end;
    of_.push_back(m);
  }
  // `step` is within one of its stretches.
  BodyMotion& operator[](std::size_t step) { return of_[place_of(step)]; }
  const BodyMotion& operator[](std::size_t step) const { return of_[place_of(step)]; }
  // The motion in a step that is within one of its stretches; behind it in memory those of the stretch's steps after
  // it.
  BodyMotion* from(std::size_t step) { return &of_[place_of(step)]; }
  const BodyMotion* from(std::size_t step) const { return &of_[place_of(step)]; }
  // Of any step of the run.
  BodyMotion at(std::size_t step) const {
    const std::size_t place = place_of(step);
    return place == kNowhere ? BodyMotion{} : of_[place];
  }
  // Adds so much of it to a run's steps, or to motions that have them all.
  template <typename Sum>
  void add_to(Sum& sum, double value) const {
    std::size_t place = 0;
    for (const Stretch& stretch : stretches_)
      for (std::size_t i = stretch.first; i < stretch.end; ++i, ++place) {
        BodyMotion& s = sum[i];
        s.forward_m += value * of_[place].forward_m;
        s.sideways_m += value * of_[place].sideways_m;
        s.turn_rad += value * of_[place].turn_rad;
      }
  }

 private:
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  std::size_t place_of(std::size_t step) const {
    std::size_t before = 0;
    for (const Stretch& s : stretches_) {
      if (step < s.first) return kNowhere;
      if (step < s.end) return before + step - s.first;
      before += s.end - s.first;
    }
    return kNowhere;
  }

  std::vector<BodyMotion> of_;  // of all stretches, one behind the other
  std::vector<Stretch> stretches_;
};

// What an effect's numbers do, in their order, none copied that is moved here.
template <typename... Each>
std::vector<Motions> motions_by_number(Each... each) {
  std::vector<Motions> columns;
  columns.reserve(sizeof...(each));
  (columns.push_back(std::move(each)), ...);
  return columns;
}

}  // namespace odolab
