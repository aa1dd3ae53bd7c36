// A disc on the floor in which wheels lose a share of what they roll.
#include "physics/effects/effect.h"

namespace odolab::planar {

namespace {

class SlipZoneOnTheFloor final : public Effect {
 public:
  explicit SlipZoneOnTheFloor(const ActiveEffect& a) {
    zone_.shape = Disc{{a.parameter("x_m"), a.parameter("y_m")}, a.parameter("radius_m")};
    zone_.slip = a.parameter("slip");
  }

  void lay_on(Floor& floor) const override { floor.slip_zones.push_back(zone_); }

 private:
  SlipZone zone_;
};

}  // namespace

std::unique_ptr<Effect> slip_zone(const ActiveEffect& active, const Machine&) {
  return std::make_unique<SlipZoneOnTheFloor>(active);
}

}  // namespace odolab::planar
