#include "core/calibration/cannot_be_told.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/formatted.h"
#include "core/calibration/likelihood_fit.h"

namespace odolab {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// What the robot did, for the sentences on what it did not do.
struct Driven {
  double travel_m = 0.0;  // of the centre, forwards and backwards alike
  double turn_rad = 0.0;  // left and right alike
  double left_m = 0.0, right_m = 0.0;

  bool by_one_wheel() const { return std::min(left_m, right_m) < 0.01 * std::max(left_m, right_m); }
};

Driven driven_in(const std::vector<InnovationRun>& runs, const DifferentialDrive& drive) {
  constexpr double kTrembles_rad = 0.02;  // as headings do by whole counts
  Driven driven;
  for (const InnovationRun& run : runs) {
    double since_rad = 0.0;
    for (const DriveStep& step : drive_steps(run, drive)) {
      driven.left_m += std::abs(step.left_m);
      driven.right_m += std::abs(step.right_m);
      driven.travel_m += 0.5 * std::abs(step.left_m + step.right_m);
      since_rad += step.turn_rad;
      if (std::abs(since_rad) > kTrembles_rad) driven.turn_rad += std::abs(std::exchange(since_rad, 0.0));
    }
  }
  return driven;
}

bool knows_ends_alone(const std::vector<InnovationRun>& runs) {
  return std::all_of(runs.begin(), runs.end(), [](const InnovationRun& run) { return run.truth.size() <= 2; });
}

}  // namespace

std::vector<std::string> what_cannot_be_told(const std::vector<char>& determined, bool scale_is_open,
                                             const std::vector<int>& active, const std::vector<InnovationRun>& runs,
                                             const DifferentialDrive& drive, bool any_heading) {
  const Driven driven = driven_in(runs, drive);
  std::vector<std::string> sentences;
  const auto open = [&](int c) { return std::find(active.begin(), active.end(), c) != active.end() && !determined[c]; };
  bool some_clock_is_open = false;
  for (int c : active) some_clock_is_open = some_clock_is_open || (c >= column::shared && !determined[c]);
  const bool left = open(column::wheel_radius_left), right = open(column::wheel_radius_right),
             base = open(column::wheelbase);
  const bool ends_alone = knows_ends_alone(runs);
  const std::string straight =
      ends_alone ? "measure the poses at both ends of a straight of a few metres" : "drive a straight of a few metres";
  const std::string so_far =
      formatted(" (here: %.1f m of travel, %.1f rad of turning)", driven.travel_m, driven.turn_rad);
  if (scale_is_open)
    sentences.push_back("wheel radii and wheelbase: only their ratios show here, not the scale" + so_far +
                        ": the mean radius is as it was given; " + straight);
  if (left || right)
    sentences.push_back(std::string(left && right ? "wheel_radius_left_m and wheel_radius_right_m"
                                    : left        ? "wheel_radius_left_m"
                                                  : "wheel_radius_right_m") +
                        (ends_alone ? ": the poses at the ends lie too close together against the truth's noise"
                                    : ": too little travel against the truth's noise") +
                        so_far + "; " + straight);
  constexpr double kTurned_rad = 1.0;
  if (base)
    sentences.push_back(std::string("wheelbase_m: ") +
                        (driven.turn_rad < kTurned_rad ? "the robot hardly turned"
                         : driven.by_one_wheel()       ? "one wheel alone rolled: its radius shows by the wheelbase"
                                                       : "what it does to these turns the wheel radii do as well") +
                        so_far +
                        (ends_alone ? "; measure the poses at both ends of full turns on the spot each way, or of arcs"
                                    : "; drive a full turn on the spot each way, or arcs"));
  if (open(column::mounting_x) || open(column::mounting_y))
    sentences.push_back(std::string("truth_mounting.") +
                        (open(column::mounting_x) && open(column::mounting_y) ? "x_m and y_m"
                         : open(column::mounting_x)                           ? "x_m"
                                                                              : "y_m") +
                        ": the tracked point's place on the vehicle shows in turns only, and its side only beside "
                        "straights or arcs both ways" +
                        so_far + "; drive turns on the spot and arcs with the truth sampled on the way");
  if (open(column::mounting_heading))
    sentences.push_back((ends_alone
                             ? "truth_mounting.heading_rad: the poses at the ends do not show the direction of travel"
                             : "truth_mounting.heading_rad: no straight long enough to see the direction of "
                               "travel") +
                        so_far + "; " + straight);
  else if (!any_heading)
    sentences.push_back("truth_mounting.heading_rad: the truth has no heading, so there is none to align");
  if (some_clock_is_open)
    sentences.push_back(
        "truth_mounting.time_offset_s: nothing happened at a time that the truth would show; drive with "
        "starts, stops and turns and sample the truth on the way");
  return sentences;
}
}  // namespace odolab
