#include "physics/experiments/real/looked_for.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/quantile.h"
#include "core/diagnosis/diagnosis.h"
#include "core/geometry/track.h"

namespace odolab {

namespace {

constexpr double kHeadingLever_m = 0.2;  // what an error of heading weighs against one of position: half a robot
constexpr int kCalibration = 6, kOfEachRun = 4, kIterations = 3;
constexpr int kOverlap = 4;            // windows begin every quarter of one
constexpr int kFewestWindows = 4 * 4;  // in each half: four that do not overlap

struct Window {
  double from_s, to_s;
  Pose moved;  // by the truth
  bool judged;
};

// One run, its truth cut into windows, and what of the model acts in it.
struct WindowedRun {
  const Recording* recording;
  Vehicle vehicle;
  std::vector<ActiveEffect> others;
  std::vector<Window> windows;
};

std::vector<Window> windows_of(const Track& truth, double metres, double radians, double middle_s) {
  std::vector<Window> windows;
  for (int late = 0; late < kOverlap; ++late) {
    const double first = static_cast<double>(late) / kOverlap;  // of a window, to where the first begins
    bool begun = late == 0;
    std::size_t start = 0;
    Pose counted = truth[0].pose;
    double travel_m = 0.0, turn_rad = 0.0;
    for (std::size_t i = 1; i < truth.size(); ++i) {
      const double stride_m = length(truth[i].pose.position() - counted.position());
      const double stride_rad = std::abs(wrapped(truth[i].pose.heading_rad - counted.heading_rad));
      if (stride_m <= 0.01 && stride_rad <= 0.03) continue;  // a noisy truth at rest does not travel
      travel_m += stride_m;
      turn_rad += stride_rad;
      counted = truth[i].pose;
      if (std::max(travel_m / metres, turn_rad / radians) < (begun ? 1.0 : first)) continue;
      const bool judged = truth[start].time_s >= middle_s;
      if (begun && (judged || truth[i].time_s < middle_s))
        windows.push_back({truth[start].time_s, truth[i].time_s, between(truth[start].pose, truth[i].pose), judged});
      begun = true;
      start = i;
      travel_m = turn_rad = 0.0;
    }
  }
  return windows;
}

bool has_wheels(const Recording& r) { return r.channel("left_wheel_rad") || r.channel("left_ticks"); }

ActiveEffect eccentricity(const char* wheel, double sine, double cosine) {
  return {
      "wheel_eccentricity", wheel, {{"amplitude", std::hypot(sine, cosine)}, {"phase_rad", std::atan2(cosine, sine)}}};
}

class Question {
 public:
  Question(const std::string& effect, const FittedModel& model, const std::vector<Recording>& runs) : effect_(effect) {
    const auto& drive = std::get<DifferentialDrive>(model.vehicle.kind);
    const bool by_turn = effect == "wheel_eccentricity";
    const double half_turn_m = kPi * 0.5 * (drive.wheel_radius_left_m + drive.wheel_radius_right_m);
    for (const Recording& r : runs) {
      if (by_turn && !has_wheels(r)) continue;
      const Track truth = truth_track(r);
      if (truth.size() < 10) continue;
      WindowedRun run{&r, model.vehicle_in(r.name), model.effects_in(r.name), {}};
      run.others.erase(std::remove_if(run.others.begin(), run.others.end(),
                                      [&](const ActiveEffect& e) {
                                        // the clock of each run is in vehicle_in
                                        return e.effect == effect || e.effect == "truth_time_offset";
                                      }),
                       run.others.end());
      run.windows =
          windows_of(truth, by_turn ? half_turn_m : 1.0, by_turn ? 2.0 * half_turn_m / drive.wheelbase_m : 1.0,
                     0.5 * (truth.front().time_s + truth.back().time_s));
      // only where the prediction says something
      const Result<Track> track = predicted_track(r, run.vehicle, run.others);
      if (!track) continue;
      run.windows.erase(std::remove_if(run.windows.begin(), run.windows.end(),
                                       [&](const Window& w) {
                                         const std::optional<Pose> a = pose_at(*track, w.from_s),
                                                                   b = pose_at(*track, w.to_s);
                                         return !a || !b || !std::isfinite(a->x_m) || !std::isfinite(b->x_m);
                                       }),
                        run.windows.end());
      const auto judged =
          std::count_if(run.windows.begin(), run.windows.end(), [](const Window& w) { return w.judged; });
      if (judged >= kFewestWindows && static_cast<int>(run.windows.size() - judged) >= kFewestWindows)
        runs_.push_back(std::move(run));
    }
  }

  int runs() const { return static_cast<int>(runs_.size()); }

  int columns(bool with) const {
    if (!with) return kCalibration;
    return kCalibration + (effect_ == "wheel_eccentricity"  ? kOfEachRun * runs()
                           : effect_ == "floor_slope_creep" ? 2
                                                            : 1);
  }

  // Errors of one half's windows: three numbers each, in metres.
  Eigen::VectorXd errors(std::size_t k, const Eigen::VectorXd& p, bool judged) const {
    const WindowedRun& run = runs_[k];
    Vehicle vehicle = run.vehicle;
    auto& drive = std::get<DifferentialDrive>(vehicle.kind);
    drive.wheel_radius_left_m *= 1.0 + p[0] - p[1];
    drive.wheel_radius_right_m *= 1.0 + p[0] + p[1];
    drive.wheelbase_m *= 1.0 + p[2];
    vehicle.truth.axle_T_tracked.x_m += p[3];
    vehicle.truth.axle_T_tracked.y_m += p[4];
    vehicle.truth.axle_T_tracked.heading_rad += p[5];
    std::vector<ActiveEffect> effects = run.others;
    if (p.size() > kCalibration) {
      if (effect_ == "wheel_eccentricity") {
        const Eigen::Index at = kCalibration + kOfEachRun * static_cast<Eigen::Index>(k);
        effects.push_back(eccentricity("left_wheel", p[at], p[at + 1]));
        effects.push_back(eccentricity("right_wheel", p[at + 2], p[at + 3]));
      } else if (effect_ == "floor_slope_creep") {
        effects.push_back(
            {effect_, "floor", {{"direction_rad", std::atan2(p[7], p[6])}, {"creep_mps", std::hypot(p[6], p[7])}}});
      } else {
        effects.push_back({effect_, "both_wheels", {{"per_mps", p[6]}}});
      }
    }
    std::vector<double> e;
    const double lost = std::numeric_limits<double>::quiet_NaN();
    const Result<Track> track = predicted_track(*run.recording, vehicle, effects);
    for (const Window& w : run.windows) {
      if (w.judged != judged) continue;
      const std::optional<Pose> a = track ? pose_at(*track, w.from_s) : std::nullopt;
      const std::optional<Pose> b = track ? pose_at(*track, w.to_s) : std::nullopt;
      const Pose off = a && b ? between(w.moved, between(*a, *b)) : Pose{lost, lost, lost};
      e.insert(e.end(), {off.x_m, off.y_m, kHeadingLever_m * wrapped(off.heading_rad)});
    }
    return Eigen::Map<Eigen::VectorXd>(e.data(), static_cast<Eigen::Index>(e.size()));
  }

  // Five per cent, five centimetres, 0.05 rad; far more than any effect here is.
  double usual_size(int column) const {
    if (column < kCalibration || effect_ == "wheel_eccentricity") return 0.05;
    return effect_ == "floor_slope_creep" ? 0.01 : 1.0;
  }

  // Gauss-Newton with weights that let go of windows far off.
  Eigen::VectorXd fitted(bool with) const {
    const int n = columns(with);
    Eigen::VectorXd p = Eigen::VectorXd::Zero(n);
    for (int iteration = 0; iteration < kIterations; ++iteration) {
      Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
      Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
      double usual_m2 = 0.0;
      for (std::size_t k = 0; k < runs_.size(); ++k) {
        const Eigen::VectorXd e = errors(k, p, false);
        std::vector<double> size;
        for (Eigen::Index i = 0; i < e.size(); i += 3) size.push_back(e.segment(i, 3).norm());
        const double usual = std::max(3.0 * median(size), 1e-9);
        Eigen::VectorXd weight(e.size());
        for (Eigen::Index i = 0; i < e.size(); ++i)
          weight[i] = 1.0 / (1.0 + std::pow(size[static_cast<std::size_t>(i / 3)] / usual, 2));
        Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(e.size(), n);
        for (int c = 0; c < n; ++c) {
          const bool own = with && effect_ == "wheel_eccentricity" && c >= kCalibration;
          if (own && (c - kCalibration) / kOfEachRun != static_cast<int>(k)) continue;
          const double step = c >= kCalibration && effect_ == "floor_slope_creep" ? 1e-4 : 1e-3;
          Eigen::VectorXd moved = p;
          moved[c] += step;
          slope.col(c) = (errors(k, moved, false) - e) / step;
        }
        usual_m2 += std::pow(usual / 3.0, 2) / runs();
        normal += slope.transpose() * weight.asDiagonal() * slope;
        right += slope.transpose() * weight.asDiagonal() * e;
      }
      // what the windows cannot tell stays near where it was
      for (int c = 0; c < n; ++c) {
        const double weight = usual_m2 / std::pow(usual_size(c), 2);
        normal(c, c) += weight;
        right[c] += weight * p[c];
      }
      p -= normal.ldlt().solve(right);
    }
    return p;
  }

  // The squared errors of the windows to be judged: position, heading.
  struct Squares {
    std::vector<double> position_m2, heading_rad2;
  };
  Squares judged(const Eigen::VectorXd& p) const {
    Squares squares;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      const Eigen::VectorXd e = errors(k, p, true);
      for (Eigen::Index i = 0; i < e.size(); i += 3) {
        squares.position_m2.push_back(e[i] * e[i] + e[i + 1] * e[i + 1]);
        squares.heading_rad2.push_back(std::pow(e[i + 2] / kHeadingLever_m, 2));
      }
    }
    return squares;
  }

  double size_in(const Eigen::VectorXd& p) const {
    const Eigen::VectorXd own = p.tail(p.size() - kCalibration);
    if (effect_ == "wheel_eccentricity") return std::sqrt(2.0 * own.squaredNorm() / static_cast<double>(own.size()));
    return effect_ == "floor_slope_creep" ? own.norm() : own[0];
  }

 private:
  std::string effect_;
  std::vector<WindowedRun> runs_;
};

double trimmed_mean(std::vector<double> squares) {
  std::sort(squares.begin(), squares.end());
  squares.resize(squares.size() - squares.size() / 10);
  double sum = 0.0;
  for (double s : squares) sum += s;
  return sum / static_cast<double>(squares.size());
}

}  // namespace

std::optional<LookedFor> looked_for(const std::string& effect, const FittedModel& model,
                                    const std::vector<Recording>& runs) {
  const Question question(effect, model, runs);
  if (question.runs() == 0) return std::nullopt;
  const Eigen::VectorXd without = question.fitted(false), with = question.fitted(true);
  if (!without.allFinite() || !with.allFinite()) return std::nullopt;
  const auto before = question.judged(without), after = question.judged(with);
  const double position_m2 = trimmed_mean(before.position_m2), heading_rad2 = trimmed_mean(before.heading_rad2);
  LookedFor found{question.size_in(with),
                  question.runs(),
                  {std::sqrt(position_m2), std::sqrt(heading_rad2)},
                  {std::sqrt(trimmed_mean(after.position_m2)), std::sqrt(trimmed_mean(after.heading_rad2))},
                  0.0};
  // window by window; what a push did to one is as large either way
  double sum = 0.0, sum_of_squares = 0.0, n = 0.0;
  for (std::size_t i = 0; i < before.position_m2.size(); ++i) {
    const double smaller = std::clamp((before.position_m2[i] - after.position_m2[i]) / position_m2, -3.0, 3.0) +
                           std::clamp((before.heading_rad2[i] - after.heading_rad2[i]) / heading_rad2, -3.0, 3.0);
    sum += smaller;
    sum_of_squares += smaller * smaller;
    n += 1.0;
  }
  const double mean = sum / n, variance = sum_of_squares / n - mean * mean;
  if (variance > 0.0) found.better_by = mean / std::sqrt(variance * kOverlap / n);
  return found;
}

}  // namespace odolab
