#include "core/diagnosis/generic/truth_by_place.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/parallel.h"
#include "core/diagnosis/effects/floor.h"
#include "core/diagnosis/generic/truth_off.h"

namespace odolab {

namespace {

// Hats on a square grid over the floor, those that the vehicle came near to often enough.
class FloorHats {
 public:
  FloorHats(const std::vector<DriveView>& views, int nodes_each_way)
      : floor_(square_around(floor_of(views))), each_way_(nodes_each_way) {
    const std::size_t nodes = static_cast<std::size_t>(each_way_) * static_cast<std::size_t>(each_way_);
    std::vector<double> way_m(nodes, 0.0);
    std::vector<Vec2> heads(nodes);  // its way's headings added up
    double all_m = 0.0;
    for (const DriveView& view : views)
      for (const EffectStep& s : view.steps) {
        all_m += std::abs(s.forward_m());
        for (const auto& [node, share] : near(s.position)) {
          const double of_it_m = share * std::abs(s.forward_m());
          way_m[node] += of_it_m;
          heads[node] = heads[node] + of_it_m * Vec2{s.cos_heading, s.sin_heading};
        }
      }
    constexpr double kOneWay = 0.7;  // of as much as where all headings are one
    for (std::size_t node = 0; node < nodes; ++node)
      if (length(heads[node]) < kOneWay * way_m[node]) met_all_round_ += way_m[node] / all_m;
    constexpr double kLeast = 0.01;  // of the way
    term_.assign(nodes, -1);
    for (std::size_t node = 0; node < nodes; ++node)
      if (way_m[node] > kLeast * all_m) term_[node] = static_cast<int>(count_++);
  }
  std::size_t count() const { return count_; }
  // The share of the way that lies where the vehicle came with other headings too.
  double met_all_round() const { return met_all_round_; }

  // Calls `visit(term, share)` for each hat that stands over a place.
  template <typename Visit>
  void of(const Vec2& place, Visit&& visit) const {
    for (const auto& [node, share] : near(place))
      if (term_[node] >= 0 && share > 0.0) visit(static_cast<std::size_t>(term_[node]), share);
  }

 private:
  std::array<std::pair<std::size_t, double>, 4> near(const Vec2& place) const {
    const Vec2 at = floor_.at(place);
    const double most = each_way_ - 1;
    const double x = std::clamp(0.5 * (at.x_m + 1.0), 0.0, 1.0) * most,
                 y = std::clamp(0.5 * (at.y_m + 1.0), 0.0, 1.0) * most;
    const double left = std::min(std::floor(x), most - 1.0), low = std::min(std::floor(y), most - 1.0);
    const double u = x - left, v = y - low;
    const auto node = [&](double column, double row) {
      return static_cast<std::size_t>(row) * static_cast<std::size_t>(each_way_) + static_cast<std::size_t>(column);
    };
    return {{{node(left, low), (1.0 - u) * (1.0 - v)},
             {node(left + 1.0, low), u * (1.0 - v)},
             {node(left, low + 1.0), (1.0 - u) * v},
             {node(left + 1.0, low + 1.0), u * v}}};
  }

  FloorSquare floor_;
  int each_way_;
  std::vector<int> term_;  // of each node; negative where it is none
  std::size_t count_ = 0;
  double met_all_round_ = 0.0;
};

}  // namespace

std::vector<GenericTest> truth_by_place_tests(const AskedModel& asked, double looked_at) {
  if (square_around(floor_of(asked.joint.views())).half_m < 1e-3) return {};
  constexpr int kFine = 5, kCoarse = 4;
  const FloorHats fine(asked.joint.views(), kFine), coarse(asked.joint.views(), kCoarse);
  // On one track, driven the same way round, all that comes back on it is a matter of places.
  constexpr double kMostOfTheWay = 0.5;
  if (coarse.met_all_round() < kMostOfTheWay) return {};
  struct Asked {
    const char *variable, *channel;
    std::size_t amplitudes;
    TruthOffsets offsets;
  };
  const auto none = [](std::vector<TruthOff>& out) { std::fill(out.begin(), out.end(), TruthOff{}); };
  const Asked all[kTruthByPlaceTests] = {
      {"place on the floor, from one part of it to the next", "truth's heading", fine.count(),
       [fine, none](int, const EffectStep& s, std::vector<TruthOff>& out) {
         none(out);
         fine.of(s.position, [&](std::size_t k, double share) { out[k].turned_rad = share; });
       }},
      {"place on the floor, and heading there", "truth's heading", 2 * coarse.count(),
       [coarse, none](int, const EffectStep& s, std::vector<TruthOff>& out) {
         none(out);
         coarse.of(s.position, [&](std::size_t k, double share) {
           out[2 * k].turned_rad = share * s.cos_heading;
           out[2 * k + 1].turned_rad = share * s.sin_heading;
         });
       }},
  };
  std::vector<GenericTest> tests(kTruthByPlaceTests);
  parallel_for(kTruthByPlaceTests, [&](int i) {
    const Asked& a = all[i];
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    t = asked_of(
        asked, a.variable, a.channel, a.amplitudes,
        [offsets = a.offsets, count = a.amplitudes](const DriveView& view, const std::vector<double>&) {
          return motions_of_truth_off(view, offsets, count);
        },
        looked_at);
    t.component = "truth";
    t.of_when_or_where = true;
  });
  return tests;
}

}  // namespace odolab
