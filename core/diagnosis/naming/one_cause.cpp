#include "core/diagnosis/naming/one_cause.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect_motions.h"

namespace odolab {

namespace {

constexpr double kWidestBump_m = 0.2;

// Of a bump that is met each time.
bool is_lying(const Effect& e) { return e.name == "bump" && !e.of_one_recording; }

// How far from its middle it is met.
double half_length_m(const Effect& e, const std::vector<double>& shape) {
  for (std::size_t k = 0; k < e.shapes.size(); ++k)
    if (e.shapes[k].name == "length_m") return 0.5 * shape[k];
  return 0.0;
}

// Whether the vehicle is on a patch about a moment.
bool happens_on(const JointModel& joint, const std::vector<double>& moment, const std::vector<double>& patch) {
  constexpr double kAbout_s = 0.5;
  const DriveView& view = joint.views()[static_cast<std::size_t>(moment[0])];
  return std::any_of(view.steps.begin(), view.steps.end(), [&](const EffectStep& s) {
    return std::abs(s.time_s - moment[1]) < kAbout_s &&
           length(s.position - Vec2{patch[0], patch[1]}) < patch[2] + view.drive.wheelbase_m;
  });
}

}  // namespace

bool looks_like(const Effect& a, const Effect& b) {
  const auto names = [](const Effect& one, const Effect& other) {
    return std::find(one.looks_like.begin(), one.looks_like.end(), other.name) != one.looks_like.end();
  };
  return a.name != b.name && (names(a, b) || names(b, a));
}

bool is_within(const Effect& one_wheel, const Effect& both_wheels) {
  return one_wheel.name == both_wheels.name && one_wheel.shape_follows_amplitude &&
         both_wheels.component == component_of(Wheel::both) && one_wheel.component != both_wheels.component;
}

bool of_one_moment(const ScoredCandidate& a, const ScoredCandidate& b) {
  return a.effect->of_one_recording && b.effect->of_one_recording && a.test.shape[0] == b.test.shape[0] &&
         std::abs(a.test.shape[1] - b.test.shape[1]) < 0.5;
}

bool of_one_small_place(const ScoredCandidate& bump, const ScoredCandidate& patch) {
  if (!is_lying(*bump.effect) || patch.effect->name != "slip_zone") return false;
  const Vec2 apart{bump.test.shape[0] - patch.test.shape[0], bump.test.shape[1] - patch.test.shape[1]};
  return patch.test.shape[2] < kWidestBump_m && length(apart) < kWidestBump_m;
}

bool of_the_same(const JointModel& joint, const ScoredCandidate& c) {
  for (const AcceptedEffect& a : joint.accepted)
    if (!is_finer(*c.effect, *a.effect) && !a.effect->local && a.effect->name == c.effect->name &&
        a.effect->component == c.effect->component)
      return true;
  // What is left beside the play of one wheel is the other's.
  if (std::any_of(joint.accepted.begin(), joint.accepted.end(),
                  [&](const AcceptedEffect& a) { return is_within(*a.effect, *c.effect); }))
    return true;
  if (!c.effect->local) return false;
  for (const AcceptedEffect& a : joint.accepted) {
    if (a.effect->name == "slip_zone") {
      if (!c.effect->of_one_recording) return true;  // one patch at a time: a disc is only nearly its shape
      if (happens_on(joint, c.test.shape, a.shape)) return true;
    }
    if (c.effect->name == "slip_zone" && a.effect->local && a.effect->of_one_recording &&
        happens_on(joint, a.shape, c.test.shape))
      return true;
    // What lies on the floor is met by one wheel or the other, more in its middle than at its edge.
    if (is_lying(*c.effect) && is_lying(*a.effect) &&
        length(Vec2{c.test.shape[0] - a.shape[0], c.test.shape[1] - a.shape[1]}) <
            std::max({kWidestBump_m, half_length_m(*c.effect, c.test.shape), half_length_m(*a.effect, a.shape)}))
      return true;
    // A bump that is met now and then by its edge is met less, or more, at some moment.
    if (c.effect->of_one_recording && is_lying(*a.effect) &&
        happens_on(joint, c.test.shape,
                   {a.shape[0], a.shape[1], std::max(kWidestBump_m, half_length_m(*a.effect, a.shape))}))
      return true;
    if (c.effect->of_one_recording && a.effect->local && a.effect->of_one_recording && a.shape[0] == c.test.shape[0] &&
        std::abs(a.shape[1] - c.test.shape[1]) < 1.0)
      return true;
  }
  return false;
}

bool happens_within_another(const JointModel& joint, const Effect& event, const CandidateTest& test) {
  constexpr double kSeldom = 0.4, kAsStrongly = 0.5;
  const auto size_m = [](const BodyMotion& m, double base_m) {
    return std::abs(m.forward_m) + std::abs(m.sideways_m) + 0.5 * base_m * std::abs(m.turn_rad);
  };
  std::vector<Motions> by_event;
  if (joint.accepted.empty()) return false;
  for (const DriveView& view : joint.views()) by_event.push_back(motion_of(event, view, test.shape, test.value));
  return std::any_of(joint.accepted.begin(), joint.accepted.end(), [&](const AcceptedEffect& a) {
    if (a.effect == &event || !a.acts_on_motion()) return false;
    double own_m = 0.0, other_m = 0.0, acts = 0.0, steps = 0.0;
    for (std::size_t r = 0; r < by_event.size(); ++r) {
      const DriveView& view = joint.views()[r];
      const Motions& own = by_event[r];
      const Motions other = motion_of(*a.effect, view, a.shape, a.value);
      for (std::size_t i = 0; i < view.steps.size(); ++i) {
        const double of_own = size_m(own.at(i), view.drive.wheelbase_m),
                     of_other = size_m(other.at(i), view.drive.wheelbase_m);
        own_m += of_own, other_m += of_own > 0.0 ? of_other : 0.0;
        acts += of_other > 0.0 ? 1.0 : 0.0, steps += 1.0;
      }
    }
    return acts < kSeldom * steps && other_m > kAsStrongly * own_m;
  });
}

int happened_once(const JointModel& joint) {
  return static_cast<int>(std::count_if(joint.accepted.begin(), joint.accepted.end(), [](const AcceptedEffect& a) {
    return a.effect->local && a.effect->of_one_recording;
  }));
}

}  // namespace odolab
