// What the joint model leaves over a metre or a radian of dead reckoning, and from one innovation to the next.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/diagnosis/model/joint_model.h"
#include "core/geometry/small_turn.h"

namespace odolab {

namespace {

constexpr double kNoHeading = std::numeric_limits<double>::quiet_NaN();

// Over one window, for a second by which changes of a command are acted on sooner or later: squared, of the position at
// its end and of its heading.
struct TimingError {
  double position_m2 = 0.0, heading_rad2 = 0.0;
};

TimingError timing_error(Track::const_iterator from, Track::const_iterator to) {
  constexpr double kApart_s = 0.05;
  TimingError sum;
  BodyMotion before;
  bool any = false;
  for (auto begin = from; begin < to;) {
    auto end = begin;
    while (end < to && end->time_s - begin->time_s < kApart_s) ++end;
    const double took_s = end->time_s - begin->time_s;
    if (took_s < kApart_s) break;
    const Vec2 way = end->pose.position() - begin->pose.position();
    const double h = begin->pose.heading_rad;
    const BodyMotion now{(way.x_m * std::cos(h) + way.y_m * std::sin(h)) / took_s, 0.0,
                         (end->pose.heading_rad - h) / took_s};
    if (any) {
      const Vec2 to_go = to->pose.position() - begin->pose.position();
      const double by_mps = now.forward_m - before.forward_m, by_radps = now.turn_rad - before.turn_rad;
      sum.position_m2 += by_mps * by_mps + by_radps * by_radps * dot(to_go, to_go);
      sum.heading_rad2 += by_radps * by_radps;
    }
    before = now;
    any = true;
    begin = end;
  }
  return sum;
}

// Over one window: the truth's error at both ends, that of its heading at the start swinging the way about, the wheels'
// errors, which turn the rest of the way, and what is hidden behind a count of each wheel at both ends.
void add_noise(JointModel::GatheredError& sum, const FittedNoise& noise, double wheelbase_m, double count_m,
               const Track& guess, double from_s, double to_s) {
  const auto from =
      std::lower_bound(guess.begin(), guess.end(), from_s, [](const TimedPose& p, double t) { return p.time_s < t; });
  const auto to = std::lower_bound(from, guess.end(), to_s, [](const TimedPose& p, double t) { return p.time_s < t; });
  if (from == guess.end() || from == to) return;
  // Between two readings both count, each by its share.
  const auto counted_m2 = [&](Track::const_iterator behind, double at_s) {
    if (behind == guess.begin() || behind == guess.end()) return count_m * count_m / 12.0;
    const double s = (at_s - (behind - 1)->time_s) / (behind->time_s - (behind - 1)->time_s);
    return (s * s + (1.0 - s) * (1.0 - s)) * count_m * count_m / 12.0;
  };
  const double at_start_m2 = counted_m2(from, from_s), at_both_m2 = at_start_m2 + counted_m2(to, to_s);
  const Vec2 end = std::min(to, guess.end() - 1)->pose.position();
  double left_and_right_m = 0.0, swung_m3 = 0.0;  // swung: by how much a turn on the way moves the end, squared
  for (auto i = from; i + 1 < guess.end() && i < to; ++i) {
    const double way = length((i + 1)->pose.position() - i->pose.position());
    const double turned = 0.5 * wheelbase_m * std::abs((i + 1)->pose.heading_rad - i->pose.heading_rad);
    const double of_both_m = 2.0 * std::max(way, turned);
    const Vec2 to_go = end - i->pose.position();
    left_and_right_m += of_both_m;
    swung_m3 += of_both_m * dot(to_go, to_go);
  }
  const Vec2 along = end - from->pose.position();
  const double q2 = noise.wheel_m_per_sqrt_m * noise.wheel_m_per_sqrt_m,
               p2 = noise.truth_position_m * noise.truth_position_m,
               h2 = noise.truth_heading_rad * noise.truth_heading_rad,
               along2 = noise.along_m_per_sqrt_m * noise.along_m_per_sqrt_m,
               turning2 = noise.turning_m_per_sqrt_m * noise.turning_m_per_sqrt_m,
               side2 = noise.sideways_m_per_sqrt_m * noise.sideways_m_per_sqrt_m;
  const double lasts_s = noise.wander_lasts_s;
  const double wandering_s = lasts_s > 0.0 ? lasts_s * -std::expm1(-(to_s - from_s) / lasts_s) : to_s - from_s;
  const double wander2 = noise.wander_m_per_sqrt_s * noise.wander_m_per_sqrt_s,
               heading_wander2 = noise.heading_wander_rad_per_sqrt_s * noise.heading_wander_rad_per_sqrt_s;
  const double wandered2 = 2.0 * wander2 * wandering_s, turned2 = heading_wander2 * wandering_s;
  const double off_at_start2 = 0.5 * heading_wander2 * lasts_s;  // a frame that is turned swings the way about
  const double per_base2 = 2.0 / (wheelbase_m * wheelbase_m);
  const double turn2_per_m = (q2 + 2.0 * turning2) / (wheelbase_m * wheelbase_m);
  sum.noise_position_m2 += 4.0 * p2 + 0.5 * at_both_m2 +
                           (h2 + off_at_start2 + per_base2 * at_start_m2) * dot(along, along) +
                           (0.25 * q2 + 0.5 * (along2 + side2)) * left_and_right_m + wandered2 + turn2_per_m * swung_m3;
  sum.noise_heading_rad2 += 2.0 * h2 + per_base2 * at_both_m2 + turned2 + turn2_per_m * left_and_right_m;
  if (noise.command_timing_s > 0.0) {
    const TimingError timing = timing_error(from, std::min(to, guess.end() - 1));
    const double timing2 = noise.command_timing_s * noise.command_timing_s;
    sum.noise_position_m2 += timing2 * timing.position_m2;
    sum.noise_heading_rad2 += timing2 * timing.heading_rad2;
  }
}

// By how much a truth's headings scatter from sample to sample: third differences, robust, in which little of the
// motion is left where samples come quickly. None of others.
double scatter_of_headings(const Track& truth) {
  constexpr double kApart_s = 0.05, kOfNoise = 20.0;  // 1 + 9 + 9 + 1 times its variance
  std::vector<double> third_rad;
  for (std::size_t i = 3; i < truth.size(); ++i) {
    if (truth[i].time_s - truth[i - 3].time_s > 3.0 * kApart_s) continue;
    const auto heading = [&](std::size_t back) { return truth[i - back].pose.heading_rad; };
    third_rad.push_back(wrapped(heading(0) - 3.0 * heading(1) + 3.0 * heading(2) - heading(3)));
  }
  return scatter_about_zero(std::move(third_rad)) / std::sqrt(kOfNoise);
}

// A likelihood that takes headings and places for independent, or the rounding of coarse counts at samples within one
// reading, makes less of a truth's noise than it is.
FittedNoise no_less_than_seen(FittedNoise noise, const Track& truth) {
  if (noise.truth_heading_rad > 0.0)
    noise.truth_heading_rad = std::max(noise.truth_heading_rad, scatter_of_headings(truth));
  return noise;
}

// Where it stands at an end it stood there longer than it was read: a pose that is taken there belongs to it, however
// the clock is put.
void stand_longer(Track& track) {
  constexpr double kLonger_s = 0.2;
  const auto stands = [](const TimedPose& a, const TimedPose& b) {
    return length(a.pose.position() - b.pose.position()) < 1e-4 &&
           std::abs(a.pose.heading_rad - b.pose.heading_rad) < 1e-3;
  };
  if (track.size() < 3) return;
  if (stands(track[0], track[1])) track.insert(track.begin(), {track[0].time_s - kLonger_s, track[0].pose});
  const TimedPose last = track.back();
  if (stands(track[track.size() - 2], last)) track.push_back({last.time_s + kLonger_s, last.pose});
}

}  // namespace

Track JointModel::dead_reckoned(const InnovationRun& run, double truth_late_s) const {
  Track track;
  Pose pose;
  for (std::size_t i = 0; i < run.wheels.size(); ++i) {
    track.push_back({run.wheels[i].time_s + truth_late_s, pose * model.truth.axle_T_tracked});
    if (i + 1 == run.wheels.size()) break;
    const double left = model.drive.wheel_radius_left_m * (run.wheels[i + 1].left_rad - run.wheels[i].left_rad);
    const double right = model.drive.wheel_radius_right_m * (run.wheels[i + 1].right_rad - run.wheels[i].right_rad);
    double f = 0.5 * (left + right), l = 0.0, w = (right - left) / model.drive.wheelbase_m;
    for (const ExtraColumn& e : run.extra) {
      f += e.per_step[i].forward_m;
      l += e.per_step[i].sideways_m;
      w += e.per_step[i].turn_rad;
    }
    const double h = pose.heading_rad + 0.5 * w, chord = chord_share(w), c = chord * std::cos(h),
                 s = chord * std::sin(h);
    pose = {pose.x_m + f * c - l * s, pose.y_m + f * s + l * c, pose.heading_rad + w};
  }
  return track;
}

Track JointModel::dead_reckoned(int run) const {
  return dead_reckoned(recorded(run), clock_s[static_cast<std::size_t>(run)]);
}

JointModel::GatheredError JointModel::gathered(
    int first_run, const std::function<std::vector<double>(int, const InnovationRun&)>& headings_of) const {
  std::vector<GatheredError> of(runs_.size());
  const FittedNoise noise = noise_as_recorded();
  parallel_for(static_cast<int>(runs_.size()), [&](int r) {
    if (r < first_run) return;
    const InnovationRun run = recorded(r);
    const std::vector<double> headings = headings_of(r, run);
    Track guess = dead_reckoned(run, clock_s[r]), truth;
    std::vector<char> anew;
    constexpr std::size_t kFew = 5;
    if (run.truth.size() < kFew) stand_longer(guess);
    bool cut = false;
    for (std::size_t i = 0; i < run.truth.size(); ++i) {
      cut = cut || is_cut(run, i);
      if (run.set_aside[i] || std::isnan(headings[i])) continue;
      truth.push_back({run.truth[i].time_s, {run.truth[i].position.x_m, run.truth[i].position.y_m, headings[i]}});
      anew.push_back(cut);
      cut = false;
    }
    if (const std::optional<TrackError> e = track_error(guess, truth, anew); e && e->windows > 0) {
      of[r].position_m2 = e->position_rms_m * e->position_rms_m;
      of[r].heading_rad2 = e->heading_rms_rad * e->heading_rms_rad;
      of[r].windows = e->windows;
      of[r].of_window = e->window_error;
      const double count_m =
          0.5 * (model.drive.wheel_radius_left_m + model.drive.wheel_radius_right_m) * count_rad(run, model.drive);
      const FittedNoise seen = no_less_than_seen(noise, truth);
      for (const auto& [from_s, to_s] : e->window_s) {
        of[r].window_at_s.push_back(from_s);
        add_noise(of[r], seen, model.drive.wheelbase_m, count_m, guess, from_s, to_s);
      }
      of[r].noise_position_m2 /= e->windows;
      of[r].noise_heading_rad2 /= e->windows;
    }
  });
  GatheredError sum;
  for (const GatheredError& e : of) sum.add(e);
  return sum;
}

JointModel::GatheredError JointModel::gathered_error(int first_run) const {
  return gathered(first_run, [](int, const InnovationRun& run) {
    std::vector<double> headings(run.truth.size(), kNoHeading);
    for (std::size_t i = 0; run.truth_has_heading && i < headings.size(); ++i)
      headings[i] = run.truth[i].heading_rad.value_or(kNoHeading);
    return headings;
  });
}

JointModel::GatheredError JointModel::path_error() const {
  constexpr double kFirst_m = 1.0;
  GatheredError sum = gathered(0, [&](int r, const InnovationRun& run) {
    std::vector<double> headings(run.truth.size(), kNoHeading);
    if (run.truth_has_heading) return headings;
    const InnovationModel m = model_of(r);
    FilterOptions options;
    options.derivatives = false;
    double driven_m = 0.0;
    options.on_step = [&](const FilterStep& s) {
      driven_m = s.starts ? 0.0 : driven_m + length(s.moved);
      if (driven_m > kFirst_m)
        headings[static_cast<std::size_t>(s.truth_index)] = s.pose.heading_rad + m.truth.axle_T_tracked.heading_rad;
    };
    filtered(run, summed_up(run, m), m, options);
    return headings;
  });
  sum.heading_rad2 = sum.noise_heading_rad2 = kNoHeading;
  return sum;
}

void JointModel::GatheredError::add(const GatheredError& other) {
  const int all = windows + other.windows;
  if (all == 0) return;
  const double mine = static_cast<double>(windows) / all, others = static_cast<double>(other.windows) / all;
  for (auto mean : {&GatheredError::position_m2, &GatheredError::heading_rad2, &GatheredError::noise_position_m2,
                    &GatheredError::noise_heading_rad2})
    this->*mean = mine * this->*mean + others * other.*mean;
  windows = all;
  of_window.insert(of_window.end(), other.of_window.begin(), other.of_window.end());
  window_at_s.insert(window_at_s.end(), other.window_at_s.begin(), other.window_at_s.end());
}

}  // namespace odolab
