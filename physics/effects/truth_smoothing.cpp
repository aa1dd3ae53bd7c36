// Not physics: the truth comes through a filter of first order, as trackers have that smooth what they see. It is late
// by the filter's time constant and cuts corners.
#include <cmath>

#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class TruthSmoothing final : public Effect {
 public:
  explicit TruthSmoothing(const ActiveEffect& a) : time_constant_s_(a.parameter("width_s")) {}

  // Between two samples the pose is taken to go evenly.
  void measure_truth(double time_s, Pose& pose) override {
    if (!seen_ || time_constant_s_ <= 0.0) smoothed_ = pose;
    const double dt_s = seen_ ? time_s - last_s_ : 0.0;
    const double keep = time_constant_s_ > 0.0 ? std::exp(-dt_s / time_constant_s_) : 0.0;
    const auto follow = [&](double& smoothed, double was, double is) {
      const double behind = dt_s > 0.0 ? (is - was) / dt_s * time_constant_s_ : 0.0;
      smoothed = is - behind + (smoothed - was + behind) * keep;
    };
    const Pose now = pose;
    if (seen_ && time_constant_s_ > 0.0) {
      follow(smoothed_.x_m, last_.x_m, now.x_m);
      follow(smoothed_.y_m, last_.y_m, now.y_m);
      follow(smoothed_.heading_rad, last_.heading_rad, now.heading_rad);
    }
    pose = smoothed_;
    last_ = now;
    last_s_ = time_s;
    seen_ = true;
  }

 private:
  double time_constant_s_;
  Pose smoothed_, last_;
  double last_s_ = 0.0;
  bool seen_ = false;
};

}  // namespace

std::unique_ptr<Effect> truth_smoothing(const ActiveEffect& active, const Machine&) {
  return std::make_unique<TruthSmoothing>(active);
}

}  // namespace odolab::planar
