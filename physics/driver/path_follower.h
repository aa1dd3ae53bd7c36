// Drives a route by the robot's own dead reckoning, as the robots of the UMBmark report did.
#pragma once

#include <vector>

#include "physics/driver/base_command.h"
#include "physics/driver/route.h"

namespace odolab {

// Knows only where the robot believes it is. Speeds up and slows down evenly, stops at the end of each leg that says
// so, and steers the believed pose back onto the leg.
class PathFollower {
 public:
  PathFollower(std::vector<Leg> route, const Driving& driving, double period_s);

  // The command for the next period from the believed pose now.
  BaseCommand update(const Pose& believed);
  bool finished() const { return leg_ >= route_.size(); }

 private:
  BaseCommand along_line(const Leg& leg, const Pose& believed);
  BaseCommand around_arc(const Leg& leg, const Pose& believed);
  BaseCommand shifting(const Leg& leg, const Pose& believed);
  BaseCommand turning(const Leg& leg, const Pose& believed);
  double way_beyond_m() const;
  double steered(double yaw_rate_radps) const;
  bool arrived(bool within_reach);
  void next_leg();

  std::vector<Leg> route_;
  Driving driving_;
  double period_s_;
  std::size_t leg_ = 0;
  BaseCommand last_;
  double resting_s_ = 0.0;   // time at rest so far at the end of a leg
  double turned_rad_ = 0.0;  // on this arc, believed
  bool flowing_ = false;     // the leg before this one had no stop
};

}  // namespace odolab
