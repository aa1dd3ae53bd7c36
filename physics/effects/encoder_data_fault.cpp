// Not physics: counts freeze for a while, or step backward, and then are right again.
#include "physics/effects/effect.h"
#include "physics/effects/stretches.h"

namespace odolab::planar {

namespace {

class EncoderDataFault final : public Effect {
 public:
  explicit EncoderDataFault(const ActiveEffect& a)
      : component_(a.component), faulty_(a, 0.2), backward_rad_(a.parameter("backward_rad")) {}

  void read_encoder(Side side, double time_s, double& reading_rad) override {
    if (!acts_on(component_, side)) return;
    double& good_rad = good_rad_[side == Side::left ? 0 : 1];
    if (faulty_.hold(time_s))
      reading_rad = good_rad - backward_rad_;
    else
      good_rad = reading_rad;
  }

 private:
  std::string component_;
  Stretches faulty_;
  double backward_rad_;
  double good_rad_[2] = {0.0, 0.0};  // last good reading
};

}  // namespace

std::unique_ptr<Effect> encoder_data_fault(const ActiveEffect& active, const Machine&) {
  return std::make_unique<EncoderDataFault>(active);
}

}  // namespace odolab::planar
