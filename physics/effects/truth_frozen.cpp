// Not physics: the truth loses sight of the robot and repeats its last pose with new stamps.
#include "physics/effects/effect.h"
#include "physics/effects/stretches.h"

namespace odolab::planar {

namespace {

class TruthFrozen final : public Effect {
 public:
  explicit TruthFrozen(const ActiveEffect& a) : frozen_(a, 0.5) {}

  void measure_truth(double time_s, Pose& pose) override {
    if (seen_ && frozen_.hold(time_s))
      pose = last_;
    else
      last_ = pose;
    seen_ = true;
  }

 private:
  Stretches frozen_;
  Pose last_;
  bool seen_ = false;
};

}  // namespace

std::unique_ptr<Effect> truth_frozen(const ActiveEffect& active, const Machine&) {
  return std::make_unique<TruthFrozen>(active);
}

}  // namespace odolab::planar
