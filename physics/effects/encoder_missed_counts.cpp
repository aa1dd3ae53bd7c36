// Above a speed the encoder, or what reads it, does not keep up: a share of the counts is lost.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class EncoderMissedCounts final : public Effect {
 public:
  explicit EncoderMissedCounts(const ActiveEffect& a)
      : component_(a.component), kept_(1.0 - a.parameter("fraction")), above_radps_(a.parameter("above_radps")) {}

  void count(Side side, double speed_radps, double& turn_rad) override {
    if (acts_on(component_, side) && std::abs(speed_radps) > above_radps_) turn_rad *= kept_;
  }
  void uncount(Side side, double& speed_radps) const override {
    if (acts_on(component_, side) && std::abs(speed_radps) > above_radps_ * kept_) speed_radps /= kept_;
  }

 private:
  std::string component_;
  double kept_, above_radps_;
};

}  // namespace

std::unique_ptr<Effect> encoder_missed_counts(const ActiveEffect& active, const Machine&) {
  return std::make_unique<EncoderMissedCounts>(active);
}

}  // namespace odolab::planar
