// In a turn the load moves to the outer wheel and squeezes its tyre.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class TyreCompression final : public Effect {
 public:
  explicit TyreCompression(const ActiveEffect& a)
      : component_(a.component),
        change_m_per_mps2_(a.parameter("radius_change_m_per_mps2")),
        inner_relieved_(form_of(a) == 1) {}

  void roll(const VehicleMotion& motion, RollingWheel& wheel) override {
    const double lateral_mps2 =
        motion.speed_mps * motion.yaw_rate_radps;  // to the left: then the right wheel is outside
    const bool outside = lateral_mps2 > 0.0 ? wheel.side == Side::right : wheel.side == Side::left;
    if (!acts_on(component_, wheel.side)) return;
    if (outside)
      wheel.radius_m -= change_m_per_mps2_ * std::abs(lateral_mps2);
    else if (inner_relieved_)
      wheel.radius_m += change_m_per_mps2_ * std::abs(lateral_mps2);
  }

 private:
  std::string component_;
  double change_m_per_mps2_;
  bool inner_relieved_;
};

}  // namespace

std::unique_ptr<Effect> tyre_compression(const ActiveEffect& active, const Machine&) {
  return std::make_unique<TyreCompression>(active);
}

}  // namespace odolab::planar
