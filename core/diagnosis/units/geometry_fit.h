// What joins the units of a vehicle, by how they move: where the truth sits and how late it is, and the offsets of the
// encoders on links, hitches and pivots. README.md, Eqs. 1 to 4.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/calibration/left_out.h"
#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

struct JointEstimate {
  JointParameter parameter;
  double nominal = 0.0, value = 0.0, stderr_value = 0.0;
  bool determined = false;      // else the value is the nominal one
  bool is_from_inside = false;  // for the most part known by what the units contradict each other
  double feigned = 0.0;         // how far from the file what these recordings cannot tell may put it
  // Else it is a length, or where the truth sits.
  bool is_of_an_encoder() const { return !parameter.effect.empty() && parameter.component != "truth"; }
  // A bias that is smaller is none: what matters in practice, and less of what the units contradict each other in.
  double least_bias() const { return is_from_inside ? 0.25 * parameter.least : parameter.least; }
};

// One recording's samples, and the outside truth or what stands in its place, on the truth's clock.
struct JoinedRun {
  std::vector<UnitSample> samples;
  Track tracked;
  bool has_headings = true;                 // else those of `tracked` are zero
  std::vector<TimeStretches> guessed = {};  // of each unit: where what a wheel turned is a guess; empty: nowhere
  std::vector<std::size_t> believed = {};   // samples of `tracked` that are no outliers, however far off they are
};

struct GeometryFit {
  Vehicle vehicle;                        // with what is determined of the joints put in; wheels as they were
  std::vector<DifferentialDrive> drives;  // of each unit, as fitted beside the joints
  std::vector<JointEstimate> joints;
  std::vector<double> clock_s;  // the truth's offset in each run, on top of the vehicle's
  std::vector<double> clock_stderr_s;
  Eigen::MatrixXd covariance;          // of the joints, in their order, from these runs and truth; may be empty
  std::vector<double> aside_stderr_m;  // of where each castor's axle lies beside its pivot's line
};

inline constexpr const char* kWheelsHeld = "wheels";  // in the list of what is held: all of them

// Runs with a truth. Least squares over stretches of half a metre or a radian, all units together with wheels of their
// own, robust against what slips here and there. `held`: joints that keep their nominal value.
GeometryFit fitted_geometry(const std::vector<JoinedRun>& runs, const Vehicle& nominal,
                            const std::vector<std::string>& held = {});

// By how much the places of all pivots move together, along x and y, in turn and apart, where each of these lengths
// grows by one: 4 rows, a column for each of the vehicle file's keys. The body of a platform is where its pivots are.
Eigen::MatrixXd moved_bodies(const MultiCastor& platform, const std::vector<std::string>& lengths);

// A turn of all pivots' readings, and of the pivots' places the other way, is a turn of the body's own x axis, which
// nothing tells: most readings are taken to be right. Three castors or more.
void set_most_pivots_right(GeometryFit& fit);
// The body's own x axis turned back: the places of all pivots, and where the truth sits, turn by this.
void turn_about_body(GeometryFit& fit, double turn_rad);

// How much a joint's offset takes off what the units contradict each other in runs that it was not fitted on: the sum
// of squares with it over that without, each run by a fit to the others. Below 1: the offset is there in all of them. 1
// where there is one run alone. `held`: joints that keep their nominal value in both.
double left_out_ratio(const std::vector<JoinedRun>& runs, const Vehicle& nominal, const std::string& joint,
                      const std::vector<std::string>& held = {});

}  // namespace odolab
