// Between the command and the motors: the base follows late, or with a first-order lag.
#include <deque>

#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class ActuatorLag final : public Effect {
 public:
  ActuatorLag(double time_constant_s, double step_s)
      : share_(time_constant_s > 0.0 ? 1.0 - std::exp(-step_s / time_constant_s) : 1.0) {}

  void command(WheelPair& set) override {
    followed_.left += share_ * (set.left - followed_.left);
    followed_.right += share_ * (set.right - followed_.right);
    set = followed_;
  }

 private:
  double share_;
  WheelPair followed_;
};

// A delay that is no whole number of steps lies between two commands.
class ActuatorDelay final : public Effect {
 public:
  ActuatorDelay(double delay_s, double step_s)
      : steps_(static_cast<std::size_t>(delay_s / step_s)),
        part_(delay_s / step_s - static_cast<double>(steps_)),
        past_(steps_ + 2) {}

  void command(WheelPair& set) override {
    past_.push_front(set);
    past_.pop_back();
    const WheelPair &late = past_[steps_], &later = past_[steps_ + 1];
    set = {late.left + part_ * (later.left - late.left), late.right + part_ * (later.right - late.right)};
  }

 private:
  std::size_t steps_;
  double part_;
  std::deque<WheelPair> past_;  // newest first
};

}  // namespace

std::unique_ptr<Effect> actuator_lag(const ActiveEffect& active, const Machine& machine) {
  return std::make_unique<ActuatorLag>(active.parameter("time_constant_s"), machine.step_s);
}

std::unique_ptr<Effect> actuator_delay(const ActiveEffect& active, const Machine& machine) {
  return std::make_unique<ActuatorDelay>(active.parameter("delay_s"), machine.step_s);
}

}  // namespace odolab::planar
