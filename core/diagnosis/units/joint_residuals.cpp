#include "core/diagnosis/units/joint_residuals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/formatted.h"
#include "core/base/quantile.h"
#include "core/diagnosis/units/joint_errors.h"
#include "core/diagnosis/units/joint_shapes.h"
#include "core/diagnosis/units/laid_stretch.h"
#include "core/odometry/differential_drive.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kReadingStretch_m = 1.0,
                 kReadingStretch_rad = 2.0;           // twice those of the geometry: an encoder errs over longer ways
constexpr double kLeastSteps = 3.0;                   // a reading that is rounded errs by 0.3 of its step
constexpr double kMostOfSquares = 0.9;                // of the squares of each run, by a fit to the others
constexpr double kPrior_rad = 0.05, kPrior_m = 0.02;  // as of the biases
constexpr double kReadingHuber = 3.0;
constexpr int kReadingShapes = 2 * kWavesOfReading + 1;  // the last: which way it went last

VectorXd shapes_at(double reading, double way, const ReadingRange& range) {
  std::vector<double> s = waves_of_reading(reading, range);
  s.push_back(way);
  return Eigen::Map<const VectorXd>(s.data(), kReadingShapes);
}

// One run of one unit.
class Laid {
 public:
  Laid(const JoinedRun& run, double clock_s, const Vehicle& vehicle, std::size_t unit)
      : run_(&run), vehicle_(&vehicle), unit_(unit) {
    const DifferentialDrive drive = units_of(vehicle)[unit].drive;
    const Track track = way_of(run.samples, unit, drive);
    double travel_m = 0.0, turn_rad = 0.0;
    std::size_t i = 0, sample = 0;
    for (const TimedPose& t : run.tracked) {
      const double at_s = t.time_s - vehicle.truth.time_offset_s - clock_s;
      if (at_s < track.front().time_s || at_s > track.back().time_s) continue;
      for (; i + 1 < track.size() && track[i + 1].time_s <= at_s; ++i) {
        const Pose step = between(track[i].pose, track[i + 1].pose);
        travel_m += length(step.position());
        turn_rad += std::abs(step.heading_rad);
      }
      while (sample + 1 < run.samples.size() && run.samples[sample + 1].time_s <= at_s) ++sample;
      if (stretches_.empty() || travel_m > kReadingStretch_m || turn_rad > kReadingStretch_rad) {
        stretches_.emplace_back();
        travel_m = turn_rad = 0.0;
      }
      stretches_.back().push_back({t.pose, *pose_at(track, at_s), joints_at(run.samples, at_s), sample});
    }
  }

  const std::vector<UnitSample>& samples() const { return run_->samples; }

  // Eq. 1 of README.md, with one joint's readings less what the shapes say that it errs by.
  VectorXd residuals(std::size_t joint, const std::vector<double>& error) const {
    std::vector<double> all;
    for (const std::vector<Point>& stretch : stretches_) {
      std::vector<Pose> by_joints, by_wheels;
      for (const Point& p : stretch) {
        std::vector<double> joints = p.joints;
        if (!error.empty()) joints[joint] -= error[p.sample];
        by_joints.push_back(p.tracked * tracked_T_axle(*vehicle_, unit_, joints));
        by_wheels.push_back(p.wheels);
      }
      for (const Eigen::Vector3d& rest : laid_stretch(by_joints, by_wheels).rest)
        all.insert(all.end(), rest.begin(), rest.end());
    }
    return Eigen::Map<VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  }

 private:
  struct Point {
    Pose tracked, wheels;
    std::vector<double> joints;
    std::size_t sample = 0;
  };
  const JoinedRun* run_;
  const Vehicle* vehicle_;
  std::size_t unit_;
  std::vector<std::vector<Point>> stretches_;
};

// The linear problem of one joint in one run: residuals = left + by * (amounts of the shapes), in deviations.
struct Problem {
  VectorXd left;
  MatrixXd by, shapes;  // `shapes`: at each sample
};

double huber(double z) {
  return std::abs(z) <= kReadingHuber ? z * z : kReadingHuber * (2.0 * std::abs(z) - kReadingHuber);
}

double squares(const VectorXd& v) {
  double sum = 0.0;
  for (double z : v) sum += huber(z);
  return sum;
}

Problem problem_of(const Laid& run, std::size_t joint, double step, const ReadingRange& range,
                   const Eigen::Vector3d& deviations) {
  Problem p;
  const std::vector<double> ways = ways_of_reading(run.samples(), joint, step),
                            readings = mean_readings(run.samples(), joint);
  p.shapes.resize(static_cast<Eigen::Index>(ways.size()), kReadingShapes);
  for (std::size_t i = 0; i < ways.size(); ++i)
    p.shapes.row(static_cast<Eigen::Index>(i)) = shapes_at(readings[i], ways[i], range);
  p.left = run.residuals(joint, {});
  p.by.resize(p.left.size(), kReadingShapes);
  constexpr double kStep = 1e-4;
  for (int k = 0; k < kReadingShapes; ++k) {
    std::vector<double> error(ways.size());
    for (std::size_t i = 0; i < ways.size(); ++i) error[i] = kStep * p.shapes(static_cast<Eigen::Index>(i), k);
    p.by.col(k) = (run.residuals(joint, error) - p.left) / kStep;
  }
  for (Eigen::Index i = 0; i < p.left.size(); ++i) {
    p.left[i] /= deviations[i % 3];
    p.by.row(i) /= deviations[i % 3];
  }
  return p;
}

VectorXd fitted_shapes(const std::vector<Problem>& problems, std::size_t without, double prior) {
  VectorXd x = VectorXd::Zero(kReadingShapes);
  for (int iteration = 0; iteration < 4; ++iteration) {
    MatrixXd information = MatrixXd::Identity(kReadingShapes, kReadingShapes) / (prior * prior);
    VectorXd gradient = -x / (prior * prior);
    for (std::size_t r = 0; r < problems.size(); ++r) {
      if (r == without) continue;
      const Problem& p = problems[r];
      const VectorXd rest = p.left + p.by * x;
      for (Eigen::Index i = 0; i < rest.size(); ++i) {
        const double w = std::min(1.0, kReadingHuber / std::max(1e-9, std::abs(rest[i])));
        information += w * p.by.row(i).transpose() * p.by.row(i);
        gradient -= w * rest[i] * p.by.row(i).transpose();
      }
    }
    x += information.ldlt().solve(gradient);
  }
  return x;
}

Eigen::Vector3d deviations_of(const VectorXd& residuals) {
  Eigen::Vector3d result;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> of_one;
    for (Eigen::Index i = k; i < residuals.size(); i += 3) of_one.push_back(residuals[i]);
    result[k] = std::max(scatter_about_zero(std::move(of_one)), 1e-6);
  }
  return result;
}

// Of the error, root mean square about its mean: that would be a bias.
double size_of_error(const std::vector<Problem>& problems, const VectorXd& x) {
  double size = 0.0, n = 0.0, mean = 0.0;
  for (const Problem& p : problems) {
    const VectorXd error = p.shapes * x;
    mean += error.sum();
    size += error.squaredNorm();
    n += static_cast<double>(error.size());
  }
  mean /= n;
  return std::sqrt(std::max(0.0, size / n - mean * mean));
}

// Over the reading, without the way it went; the band by leaving out each run in turn.
Response response_over_reading(const VectorXd& x, const std::vector<VectorXd>& others, const ReadingRange& range) {
  constexpr int kPoints = 41;
  const double low = range.first(), high = range.last();
  const double n = static_cast<double>(others.size());
  Response r;
  for (int i = 0; i < kPoints; ++i) {
    const double at = low + (high - low) * i / (kPoints - 1.0);
    const VectorXd shapes = shapes_at(at, 0.0, range);
    double mean = 0.0, squared = 0.0;
    for (const VectorXd& o : others) mean += shapes.dot(o) / n;
    for (const VectorXd& o : others) squared += (shapes.dot(o) - mean) * (shapes.dot(o) - mean);
    const double value = shapes.dot(x), error = std::sqrt((n - 1.0) / n * squared);
    r.at.push_back(at);
    r.value.push_back(value);
    r.low.push_back(value - 1.96 * error);
    r.high.push_back(value + 1.96 * error);
  }
  return r;
}

}  // namespace

std::optional<ErringJoint> erring_joint(const std::vector<JoinedRun>& runs, const std::vector<double>& clock_s,
                                        const Vehicle& vehicle, std::size_t unit) {
  const std::vector<double> steps = joint_steps(vehicle);
  if (runs.size() < 2) return std::nullopt;
  std::vector<Laid> laid;
  std::vector<Eigen::Vector3d> deviations;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    laid.emplace_back(runs[r], clock_s[r], vehicle, unit);
    const VectorXd residuals = laid.back().residuals(0, {});
    if (residuals.size() == 0) return std::nullopt;
    deviations.push_back(deviations_of(residuals));
  }
  std::optional<ErringJoint> most;
  for (std::size_t j = 0; j < steps.size(); ++j) {
    if (std::holds_alternative<MultiCastor>(vehicle.kind) && j != unit) continue;
    ReadingRange range;
    range.is_length = name_of_joint(vehicle, j).unit == "m";
    for (const JoinedRun& run : runs) range.take_in(run.samples, j);
    if (range.high - range.low < 4.0 * steps[j]) continue;
    std::vector<Problem> problems;
    for (std::size_t r = 0; r < runs.size(); ++r)
      problems.push_back(problem_of(laid[r], j, steps[j], range, deviations[r]));
    const double prior = range.is_length ? kPrior_m : kPrior_rad;
    double with = 0.0, without = 0.0;
    bool in_each = true;
    std::vector<VectorXd> others;  // fits without one run each
    for (std::size_t r = 0; r < problems.size(); ++r) {
      others.push_back(fitted_shapes(problems, r, prior));
      const double before = squares(problems[r].left), after = squares(problems[r].left + problems[r].by * others[r]);
      in_each = in_each && after < kMostOfSquares * before;
      without += before;
      with += after;
    }
    if (!in_each) continue;
    const VectorXd x = fitted_shapes(problems, problems.size(), prior);
    ErringJoint erring;
    erring.joint = j;
    erring.size = size_of_error(problems, x);
    erring.step = steps[j];
    erring.play = std::abs(x[kReadingShapes - 1]);
    erring.left_out_ratio = with / without;
    erring.gain = 0.5 * (without - with);
    if (erring.size < kLeastSteps * steps[j] || (most && most->gain > erring.gain)) continue;
    erring.by_reading = response_over_reading(x, others, range);
    most = std::move(erring);
  }
  return most;
}

void add_erring_joint(const ErringJoint& erring, const Vehicle& vehicle, Diagnosis& d) {
  const JointName own = name_of_joint(vehicle, erring.joint);
  const std::string& name = own.words;
  const double thousands = 1e3;
  const bool by_way = erring.play > erring.size;
  const std::string text = formatted(
      "something that no entry of the catalogue describes: the encoder of %s errs %s against wheels and "
      "truth, by %.3g m%s where its steps are %.2g; what they contradict in runs left out falls to %.0f %%",
      name.c_str(), by_way ? "by which way it went last, as play does," : "by what it reads",
      thousands * (by_way ? erring.play : erring.size), own.unit.c_str(), thousands * erring.step,
      100.0 * erring.left_out_ratio);
  Finding f;
  f.effect = "unknown";
  f.component = own.component;
  f.log_likelihood_gain = erring.gain;
  f.p_value = chi_square_tail(2.0 * erring.gain, kReadingShapes);
  f.where.regime = by_way ? "by which way " + name + " went last" : "by what " + name + " reads";
  f.sentence = text;
  d.findings.insert(d.findings.begin(), f);
  Response shape = erring.by_reading;
  shape.variable = name + " [" + own.unit + "]";
  shape.channel = "error of " + name + " [" + own.unit + "]";
  d.responses.insert(d.responses.begin(), std::move(shape));
}

}  // namespace odolab
