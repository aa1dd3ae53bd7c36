#include "core/diagnosis/unheard_commands.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/geometry/angles.h"

namespace odolab {

namespace {

struct Moved {
  double way_m = 0.0, turn_rad = 0.0;
};

// What the commands between two times add up to, without turns of the way.
class CommandedWay {
 public:
  explicit CommandedWay(const std::vector<HeldCommand>& commands) : commands_(commands), until_(commands.size()) {
    for (std::size_t i = 0; i + 1 < commands.size(); ++i) {
      const double lasts_s = commands[i + 1].time_s - commands[i].time_s;
      until_[i + 1] = {until_[i].way_m + commands[i].speed_mps * lasts_s,
                       until_[i].turn_rad + commands[i].yaw_rate_radps * lasts_s};
    }
  }
  Moved between(double from_s, double to_s) const {
    const Moved a = at(from_s), b = at(to_s);
    return {std::abs(b.way_m - a.way_m), std::abs(b.turn_rad - a.turn_rad)};
  }

 private:
  Moved at(double time_s) const {
    const auto behind = std::upper_bound(commands_.begin(), commands_.end(), time_s,
                                         [](double t, const HeldCommand& c) { return t < c.time_s; });
    if (behind == commands_.begin()) return {};
    const auto i = static_cast<std::size_t>(behind - commands_.begin()) - 1;
    const double since_s = time_s - commands_[i].time_s;
    return {until_[i].way_m + commands_[i].speed_mps * since_s,
            until_[i].turn_rad + commands_[i].yaw_rate_radps * since_s};
  }
  const std::vector<HeldCommand>& commands_;
  std::vector<Moved> until_;
};

}  // namespace

std::vector<HeldCommand> held_commands(const Recording& recording) {
  const Channel *v = recording.channel("command_speed_mps"), *w = recording.channel("command_yaw_rate_radps");
  std::vector<HeldCommand> commands;
  for (std::size_t i = 0; v && w && i < recording.time_s.size(); ++i)
    if (std::isfinite(v->values[i]) && std::isfinite(w->values[i]) &&
        (commands.empty() || recording.time_s[i] > commands.back().time_s))
      commands.push_back({recording.time_s[i], v->values[i], w->values[i]});
  return commands;
}

TimeStretches holes_in_commands(const std::vector<HeldCommand>& commands) {
  constexpr double kLeast_s = 0.2, kTimesUsual = 5.0, kEven = 6.0, kNearlyAll = 0.9;
  constexpr std::size_t kFewest = 20;
  TimeStretches holes;
  if (commands.size() < kFewest) return holes;
  std::vector<double> lasts_s;
  for (std::size_t i = 0; i + 1 < commands.size(); ++i) lasts_s.push_back(commands[i + 1].time_s - commands[i].time_s);
  const double usual_s = quantile(lasts_s, 0.5);
  if (quantile(lasts_s, kNearlyAll) > kEven * usual_s) return holes;
  for (std::size_t i = 0; i + 1 < commands.size(); ++i) {
    const HeldCommand &a = commands[i], &b = commands[i + 1];
    const bool stays_at_rest =
        a.speed_mps == 0.0 && a.yaw_rate_radps == 0.0 && b.speed_mps == 0.0 && b.yaw_rate_radps == 0.0;
    if (!stays_at_rest && lasts_s[i] > std::max(kLeast_s, kTimesUsual * usual_s)) holes.emplace_back(a.time_s, b.time_s);
  }
  return holes;
}

TimeStretches unmoved_base(const std::vector<HeldCommand>& commands, const std::vector<TruthSample>& truth) {
  constexpr double kLasts_s = 2.0, kStride_s = 0.25, kSooner_s = 0.5, kMean_s = 0.1;
  constexpr double kLeast_m = 0.1, kLeast_rad = 0.5, kHardly = 0.15, kHardly_m = 0.015, kHardly_rad = 0.03;
  TimeStretches unmoved;
  if (commands.size() < 2 || truth.size() < 2) return unmoved;
  const CommandedWay commanded(commands);
  // Where the truth is about a time, of the samples of a tenth of a second to either side; none where it has a gap.
  const auto pose_about = [&](double time_s) -> std::optional<Pose> {
    const auto from = std::lower_bound(truth.begin(), truth.end(), time_s - kMean_s,
                                       [](const TruthSample& t, double s) { return t.time_s < s; });
    Vec2 sum;
    double turned = 0.0;
    int n = 0;
    std::optional<double> first;
    for (auto i = from; i != truth.end() && i->time_s <= time_s + kMean_s; ++i) {
      sum = sum + i->position;
      if (i->heading_rad) turned += wrapped(*i->heading_rad - first.value_or(*i->heading_rad));
      if (i->heading_rad && !first) first = *i->heading_rad;
      ++n;
    }
    if (n == 0) return {};
    return Pose{sum.x_m / n, sum.y_m / n, first.value_or(0.0) + turned / n};
  };
  int unbidden = 0, deaf = 0;
  for (double from_s = commands.front().time_s + kSooner_s; from_s + kLasts_s < commands.back().time_s;
       from_s += kStride_s) {
    const double to_s = from_s + kLasts_s;
    const auto a = pose_about(from_s), b = pose_about(to_s);
    if (!a || !b) continue;
    const double moved_m = length(b->position() - a->position());
    const double moved_rad = std::abs(wrapped(b->heading_rad - a->heading_rad));
    const Moved now = commanded.between(from_s, to_s), before = commanded.between(from_s - kSooner_s, to_s - kSooner_s);
    const double way_m = std::min(now.way_m, before.way_m), turn_rad = std::min(now.turn_rad, before.turn_rad);
    if ((way_m > kLeast_m || turn_rad > kLeast_rad) && moved_m < std::max(kHardly_m, kHardly * way_m) &&
        moved_rad < std::max(kHardly_rad, kHardly * turn_rad)) {
      unmoved.emplace_back(from_s - kSooner_s, to_s);
      ++deaf;
    }
    const double most_m = std::max(now.way_m, before.way_m), most_rad = std::max(now.turn_rad, before.turn_rad);
    if ((moved_m > kLeast_m || moved_rad > kLeast_rad) && most_m < std::max(kHardly_m, kHardly * moved_m) &&
        most_rad < std::max(kHardly_rad, kHardly * moved_rad))
      ++unbidden;
  }
  if (2 * unbidden > deaf) return {};
  return joined(std::move(unmoved));
}

}  // namespace odolab
