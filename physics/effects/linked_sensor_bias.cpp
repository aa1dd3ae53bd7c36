// Encoders of linked and castor vehicles that read more than the truth: on a link's or hitch's angle, a link's length,
// a castor's pivot.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class SensorBias final : public Effect {
 public:
  SensorBias(std::string component, double bias, bool of_length)
      : component_(std::move(component)), bias_(bias), of_length_(of_length) {}

  void build_into_lengths(VehicleKind& lengths) const override {
    if (auto* clapper = std::get_if<Clapper>(&lengths)) add_to(*clapper);
    if (auto* omnimate = std::get_if<OmniMate>(&lengths)) add_to(*omnimate);
    if (auto* train = std::get_if<EncoderTrailer>(&lengths)) train->hitch_angle_offset_rad += bias_;
    if (auto* train = std::get_if<SmartEncoderTrailer>(&lengths)) train->hitch_angle_offset_rad += bias_;
    if (auto* vehicle = std::get_if<MultiCastor>(&lengths))
      for (std::size_t i = 0; i < vehicle->castors.size(); ++i)
        if (component_ == "castor" + std::to_string(i + 1)) vehicle->castors[i].pivot_encoder_offset_rad += bias_;
  }

 private:
  void add_to(LinkedTrucks& trucks) const {
    if (of_length_) trucks.link_length_offset_m += bias_;
    if (component_ == "truck_a") trucks.link_angle_a_offset_rad += bias_;
    if (component_ == "truck_b") trucks.link_angle_b_offset_rad += bias_;
  }

  std::string component_;
  double bias_;
  bool of_length_;
};

std::unique_ptr<Effect> angle_bias(const ActiveEffect& active) {
  return std::make_unique<SensorBias>(active.component, active.parameter("bias_rad"), false);
}

}  // namespace

std::unique_ptr<Effect> link_angle_bias(const ActiveEffect& active, const Machine&) { return angle_bias(active); }
std::unique_ptr<Effect> pivot_angle_bias(const ActiveEffect& active, const Machine&) { return angle_bias(active); }
std::unique_ptr<Effect> link_length_bias(const ActiveEffect& active, const Machine&) {
  return std::make_unique<SensorBias>(active.component, active.parameter("bias_m"), true);
}

}  // namespace odolab::planar
