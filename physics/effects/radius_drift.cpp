// Wheels grow or shrink evenly with time: warming, wear, loss of pressure.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class RadiusDrift final : public Effect {
 public:
  explicit RadiusDrift(const ActiveEffect& a) : component_(a.component), per_s_(a.parameter("per_s")) {}

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    if (acts_on(component_, wheel.side)) wheel.radius_m *= 1.0 + per_s_ * motion.since_start_s;
  }

 private:
  std::string component_;
  double per_s_;
};

}  // namespace

std::unique_ptr<Effect> radius_drift(const ActiveEffect& active, const Machine&) {
  return std::make_unique<RadiusDrift>(active);
}

}  // namespace odolab::planar
