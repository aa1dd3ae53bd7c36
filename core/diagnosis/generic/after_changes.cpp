#include "core/diagnosis/generic/after_changes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/parallel.h"
#include "core/diagnosis/generic/counted.h"

namespace odolab {

namespace {

// Where the hats stand, in seconds since the change, and begin and end. What follows at once is the clock's.
constexpr double kSinceChange_s[] = {0.0, 0.12, 0.24, 0.36, 0.5, 0.65, 0.8, 1.0, 1.25, 1.6};
constexpr std::size_t kHatsAfterChange = std::size(kSinceChange_s) - 2;

// A way that the wheels went since the start, at any time: it stands before and goes on behind.
class WayAt {
 public:
  WayAt(const std::vector<EffectStep>& steps, double (*way)(const EffectStep&)) {
    at_s_.push_back(steps.empty() ? 0.0 : steps.front().time_s - 0.5 * steps.front().duration_s);
    way_.push_back(0.0);
    for (const EffectStep& s : steps) {
      at_s_.push_back(s.time_s + 0.5 * s.duration_s);
      way_.push_back(way_.back() + way(s));
    }
  }
  // Of times that come in order.
  double at(double time_s, std::size_t& from) const {
    while (from + 1 < at_s_.size() && at_s_[from + 1] <= time_s) ++from;
    if (from + 1 >= at_s_.size() || time_s <= at_s_[from]) return way_[from];
    const double share = (time_s - at_s_[from]) / (at_s_[from + 1] - at_s_[from]);
    return way_[from] + share * (way_[from + 1] - way_[from]);
  }

 private:
  std::vector<double> at_s_, way_;
};

double forward_of(const EffectStep& s) { return s.forward_m(); }
double turn_of(const EffectStep& s) { return s.turn_rad; }

// A hat's integral over all changes is the mean speed on its one side less that on its other: no derivative is taken,
// and a count is felt as little as over a tenth of a second.
template <double (*way_of)(const EffectStep&), double BodyMotion::*moves>
std::vector<Motions> responses(const DriveView& view, const std::vector<double>&) {
  const std::vector<EffectStep>& steps = view.steps;
  const WayAt way(steps, way_of);
  std::vector<Motions> out(kHatsAfterChange, Motions(steps.size()));
  std::size_t from[kHatsAfterChange + 2] = {};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    double at[kHatsAfterChange + 2];
    for (std::size_t k = 0; k < kHatsAfterChange + 2; ++k) at[k] = way.at(steps[i].time_s - kSinceChange_s[k], from[k]);
    for (std::size_t k = 0; k < kHatsAfterChange; ++k) {
      const double sooner = (at[k] - at[k + 1]) / (kSinceChange_s[k + 1] - kSinceChange_s[k]),
                   later = (at[k + 1] - at[k + 2]) / (kSinceChange_s[k + 2] - kSinceChange_s[k + 1]);
      out[k][i].*moves = steps[i].duration_s * (sooner - later);
    }
  }
  return out;
}

struct AfterChange {
  const char *variable, *channel;
  std::vector<Motions> (*motions)(const DriveView&, const std::vector<double>&);
};

constexpr AfterChange kAfterChange[kAfterChangeTests] = {
    {"time since its speed changed [s]", "pace, as a share of the change [1]",
     responses<forward_of, &BodyMotion::forward_m>},
    {"time since its yaw rate changed [s]", "yaw rate, as a share of the change [1]",
     responses<turn_of, &BodyMotion::turn_rad>},
};

}  // namespace

std::vector<GenericTest> after_change_tests(const AskedModel& asked, double looked_at) {
  const std::vector<DriveView>& views = asked.joint.views();
  if (std::any_of(views.begin(), views.end(), [](const DriveView& v) { return v.from_commands; })) return {};
  std::vector<GenericTest> tests(kAfterChangeTests);
  parallel_for(kAfterChangeTests, [&](int i) {
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    t = asked_of(asked, kAfterChange[i].variable, kAfterChange[i].channel, kHatsAfterChange, kAfterChange[i].motions,
                 looked_at);
    leave_displaced_to_counting(t, asked.joint);
    t.at.assign(std::begin(kSinceChange_s) + 1, std::end(kSinceChange_s) - 1);
  });
  return tests;
}

}  // namespace odolab
