// Above a speed the encoder, or what reads it, does not keep up: a share of the counts is lost.
#include "core/diagnosis/effects/forms.h"
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class EncoderMissedCounts final : public Effect {
 public:
  explicit EncoderMissedCounts(const ActiveEffect& a)
      : component_(a.component),
        form_(effects::kMissedForms[form_of(a).value_or(0)]),
        more_(a.parameter("fraction") / (1.0 - a.parameter("fraction"))),
        limit_radps_(a.parameter("above_radps") / (1.0 + more_)) {}

  void count(Side side, double speed_radps, double& turn_rad) override {
    if (acts_on(component_, side) && speed_radps != 0.0)
      turn_rad *= read_radps(std::abs(speed_radps)) / std::abs(speed_radps);
  }
  void uncount(Side side, double& speed_radps) const override {
    if (acts_on(component_, side)) speed_radps *= 1.0 + more_ * form_.share(std::abs(speed_radps), limit_radps_);
  }

 private:
  // At which a wheel is read that turns at such a speed: the other way round it is known.
  double read_radps(double speed_radps) const {
    double low = speed_radps / (1.0 + more_), high = speed_radps;
    if (form_.within == 0.0) return low > limit_radps_ ? low : high;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (low + high);
      (middle * (1.0 + more_ * form_.share(middle, limit_radps_)) < speed_radps ? low : high) = middle;
    }
    return low;
  }

  std::string component_;
  effects::MissedForm form_;
  double more_;         // than is read, of a wheel's way where all of it is lost that may be
  double limit_radps_;  // as it is read
};

}  // namespace

std::unique_ptr<Effect> encoder_missed_counts(const ActiveEffect& active, const Machine&) {
  return std::make_unique<EncoderMissedCounts>(active);
}

}  // namespace odolab::planar
