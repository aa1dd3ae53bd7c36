// One wave: what it goes along, what it modulates, and how much of that there is in a step.
#pragma once

#include <array>
#include <vector>

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

// What a wave goes along: what has passed, been driven or turned since the run began, how often a wheel has turned, or
// the floor.
enum class Along { time, way, turning, left_wheel, right_wheel, floor };
inline bool is_of_a_wheel(Along along) { return along == Along::left_wheel || along == Along::right_wheel; }
double coordinate(Along along, const DriveView& view, const EffectStep& step);  // of all but the floor

// The first channels are those of all generic groups but for the turn by itself.
constexpr int kChannelsOfAll = kTurnOfItself;

// What a wave modulates: the generic channels; what carries the vehicle across the floor, for each metre of way or, in
// time, for each second that it moves; in time, the pace of the clock, which all motion has in common, and the turn
// by itself, as a wheelbase does that is wider for a while; and how far a wheel rolls: of its own turns, and of the
// floor each wheel where it stands itself: along one ripple of a floor both do alike, across it the one and then the
// other.
constexpr int kAcross = kChannelsOfAll, kPace = kChannelsOfAll + 1, kTurning = kChannelsOfAll + 2,
              kUnderWheels = kChannelsOfAll + 3, kWaveChannels = kChannelsOfAll + 4;

// What is summed up: the generic channels; what carries it across the floor, along x and along y, for each metre and
// for each second; the pace; the turn; the way of one wheel.
enum Slot { across_m = kAcross, across_s = across_m + 2, of_pace = across_s + 2, of_turning, of_wheel, kSlots };
// A slot that a wave modulates, and the channel that it belongs to.
struct Modulated {
  int slot, channel;
};

constexpr int kWaveBands = 3;  // long, middling and short
// Neighbours stand so close, in turns over the whole, that what lies between two loses an eighth of its power at most.
constexpr double kTurnsApart = 0.4;

// A wave: turns for each unit of its axis, or the wave vector in turns per metre.
struct Wave {
  Along along = Along::floor;
  double per_unit = 0.0, apart = 0.0;  // and to the next one that was looked at
  Vec2 per_m;
  int band = 0;
  bool on_the_floor() const { return along == Along::floor; }
  bool in_time() const { return along == Along::time; }
  double turns(const DriveView& view, const EffectStep& s) const {
    return on_the_floor() ? dot(per_m, s.position) : per_unit * coordinate(along, view, s);
  }
};

// A wave and the square of its score in every channel.
struct Heard {
  Wave wave;
  std::array<double, kWaveChannels> power{};
};

// How much of a channel there is in one step; what carries across the floor has two, along its x and along its y.
struct Unit {
  BodyMotion of[2];
};
Unit unit_of(const EffectStep& step, double wheelbase_m, int channel, Along along);

double product(const BodyMotion& a, const BodyMotion& b);

// What one step adds to each slot.
void add_scores(const DriveView& view, const EffectStep& step, const BodyMotion& score_of_step, Along along,
                double* score);

}  // namespace odolab
