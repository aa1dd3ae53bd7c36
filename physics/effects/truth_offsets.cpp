// Where the truth really sits on the vehicle, and how late its stamps are; nobody has told the vehicle file.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class TruthOffset final : public Effect {
 public:
  TruthOffset(Pose place, double late_s) : place_(place), late_s_(late_s) {}

  void mount(TruthMounting& truth) const override {
    truth.axle_T_tracked.x_m += place_.x_m;
    truth.axle_T_tracked.y_m += place_.y_m;
    truth.axle_T_tracked.heading_rad += place_.heading_rad;
    truth.time_offset_s += late_s_;
  }

 private:
  Pose place_;
  double late_s_;
};

}  // namespace

std::unique_ptr<Effect> truth_time_offset(const ActiveEffect& active, const Machine&) {
  return std::make_unique<TruthOffset>(Pose{}, active.parameter("offset_s"));
}

std::unique_ptr<Effect> truth_mounting_offset(const ActiveEffect& active, const Machine&) {
  const Pose place{active.parameter("x_m"), active.parameter("y_m"), active.parameter("heading_rad")};
  return std::make_unique<TruthOffset>(place, 0.0);
}

}  // namespace odolab::planar
