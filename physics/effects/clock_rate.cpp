// The robot's clock, which stamps encoders and commands, runs fast or slow against the truth's.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class ClockRate final : public Effect {
 public:
  explicit ClockRate(const ActiveEffect& a) : rate_(a.parameter("rate")) {}

  void stamp_robot(double since_start_s, double& stamp_s) const override { stamp_s += rate_ * since_start_s; }

 private:
  double rate_;
};

}  // namespace

std::unique_ptr<Effect> clock_rate(const ActiveEffect& active, const Machine&) {
  return std::make_unique<ClockRate>(active);
}

}  // namespace odolab::planar
