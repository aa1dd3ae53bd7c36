#include "core/diagnosis/generic/on_a_patch.h"

#include <algorithm>

namespace odolab {

namespace {

constexpr int kChannels = 3;

// What is met in few places scatters like the names of such places: too few batches of it are there to tell otherwise.
constexpr AskedHow kAskedOfPatch = [] {
  AskedHow how = kAskedOfGeneric;
  how.scatters_as_its_like = true;
  return how;
}();

bool is_patch(const AcceptedEffect& a) { return a.effect->name == "slip_zone"; }

// One way ahead is slip itself, in one form of it.
std::vector<Motions> motions_on_patch(const DriveView& view, const WhereFound::Zone& patch, int channel) {
  const std::size_t even = channel == 0 ? 0 : 1;
  std::vector<Motions> out(even + 2, Motions(view.steps.size()));
  view.steps_near({patch.x_m, patch.y_m}, patch.radius_m, [&](std::size_t i) {
    const EffectStep& s = view.steps[i];
    const BodyMotion m = unit_of_channel(s, view.drive.wheelbase_m, channel);
    const auto times = [&](double by) { return BodyMotion{by * m.forward_m, by * m.sideways_m, by * m.turn_rad}; };
    if (even == 1) out[0][i] = m;
    out[even][i] = times(s.cos_heading);
    out[even + 1][i] = times(s.sin_heading);
  });
  return out;
}

}  // namespace

int count_of_patch_tests(const JointModel& joint) {
  return kChannels * static_cast<int>(std::count_if(joint.accepted.begin(), joint.accepted.end(), is_patch));
}

std::vector<GenericTest> on_a_patch_tests(const AskedModel& asked, double looked_at) {
  std::vector<GenericTest> tests;
  for (const AcceptedEffect& a : asked.joint.accepted) {
    if (!is_patch(a)) continue;
    const WhereFound::Zone patch{a.shape[0], a.shape[1], a.shape[2]};
    for (int channel = 0; channel < kChannels; ++channel) {
      tests.push_back(asked_of(
          asked, "heading on the slip zone [rad]", name_of_channel(channel), channel == 0 ? 2 : 3,
          [=](const DriveView& view, const std::vector<double>&) { return motions_on_patch(view, patch, channel); },
          looked_at, kAskedOfPatch));
      tests.back().component = "floor";
      tests.back().zone = patch;
      tests.back().of_when_or_where = true;
    }
  }
  return tests;
}

}  // namespace odolab
