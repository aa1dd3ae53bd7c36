#include "physics/experiments/concealed/oracle.h"

#include <cmath>

#include "core/base/parallel.h"

namespace odolab::concealed {

namespace {

constexpr int kShared = column::truth_clock;

// Square, symmetric and positive, row by row.
struct Matrix {
  int n;
  std::vector<double> at;
  explicit Matrix(int size) : n(size), at(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0.0) {}
  double& operator()(int r, int c) {
    return at[static_cast<std::size_t>(r) * static_cast<std::size_t>(n) + static_cast<std::size_t>(c)];
  }
  double operator()(int r, int c) const {
    return at[static_cast<std::size_t>(r) * static_cast<std::size_t>(n) + static_cast<std::size_t>(c)];
  }
};

// By Gauss and Jordan on a matrix scaled to ones on its diagonal.
Matrix inverse(const Matrix& m) {
  const int n = m.n;
  std::vector<double> scale;
  for (int i = 0; i < n; ++i) scale.push_back(1.0 / std::sqrt(std::max(m(i, i), 1e-300)));
  Matrix a(n), b(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) a(i, j) = m(i, j) * scale[i] * scale[j];
    b(i, i) = 1.0;
  }
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(a(i, k)) > std::abs(a(pivot, k))) pivot = i;
    for (int j = 0; j < n; ++j) std::swap(a(k, j), a(pivot, j)), std::swap(b(k, j), b(pivot, j));
    const double by = a(k, k) != 0.0 ? 1.0 / a(k, k) : 0.0;
    for (int j = 0; j < n; ++j) a(k, j) *= by, b(k, j) *= by;
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      const double f = a(i, k);
      for (int j = 0; j < n; ++j) a(i, j) -= f * a(k, j), b(i, j) -= f * b(k, j);
    }
  }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) b(i, j) *= scale[i] * scale[j];
  return b;
}

struct System {
  Matrix information;
  std::vector<double> score;
  double chi2 = 0.0;
};

// Columns: the six shared parameters, a clock for each run, the effects.
System system_of(const std::vector<InnovationRun>& runs, const InnovationModel& model,
                 const std::vector<double>& clock_s) {
  const int n = static_cast<int>(runs.size()), effects = static_cast<int>(runs.front().extra.size());
  std::vector<InnovationSums> sums(runs.size());
  parallel_for(n, [&](int r) {
    InnovationModel m = model;
    m.truth.time_offset_s = clock_s[r];
    sums[r] = filtered(runs[r], summed_up(runs[r], m), m);
  });
  System all{Matrix(kShared + n + effects), std::vector<double>(static_cast<std::size_t>(kShared + n + effects), 0.0)};
  for (int r = 0; r < n; ++r) {
    const int p = column::first_extra + effects;
    const auto place = [&](int c) {
      return c < kShared ? c : c == column::truth_clock ? kShared + r : kShared + n + c - column::first_extra;
    };
    for (int i = 0; i < p; ++i) {
      for (int j = 0; j < p; ++j)
        all.information(place(i), place(j)) += sums[r].information[static_cast<std::size_t>(i * p + j)];
      all.score[static_cast<std::size_t>(place(i))] += sums[r].score[static_cast<std::size_t>(i)];
    }
    all.chi2 += sums[r].chi2;
  }
  // Wide priors: what the runs do not determine stays.
  const double size[kShared] = {0.1 * model.drive.wheel_radius_left_m,
                                0.1 * model.drive.wheel_radius_right_m,
                                0.1 * model.drive.wheelbase_m,
                                0.2,
                                0.2,
                                0.3};
  for (int c = 0; c < kShared; ++c) all.information(c, c) += 1.0 / (size[c] * size[c]);
  for (int r = 0; r < n; ++r) all.information(kShared + r, kShared + r) += 25.0;
  for (int k = 0; k < effects; ++k) all.information(kShared + n + k, kShared + n + k) += 1e-6;
  return all;
}

std::vector<double> significance_in_system(const System& system, int runs) {
  const Matrix covariance = inverse(system.information);
  std::vector<double> sigma;
  for (int k = kShared + runs; k < covariance.n; ++k)
    sigma.push_back(1.0 / std::sqrt(std::max(covariance(k, k), 1e-300)));
  return sigma;
}

void set_sizes(std::vector<InnovationRun>& runs, const std::vector<double>& size) {
  for (InnovationRun& run : runs)
    for (std::size_t k = 0; k < run.extra.size(); ++k) run.extra[k].value = size[k];
}

}  // namespace

std::vector<double> significance(const std::vector<InnovationRun>& runs, const InnovationModel& truth) {
  const std::vector<double> clocks(runs.size(), truth.truth.time_offset_s);
  return significance_in_system(system_of(runs, truth, clocks), static_cast<int>(runs.size()));
}

OracleFit oracle_fit(std::vector<InnovationRun> runs, const InnovationModel& start) {
  const int n = static_cast<int>(runs.size());
  OracleFit fit;
  fit.model = start;
  fit.size.assign(runs.front().extra.size(), 1.0);
  std::vector<double> clock_s(runs.size(), start.truth.time_offset_s);
  for (int iteration = 0; iteration < 3; ++iteration) {
    set_sizes(runs, fit.size);
    const System system = system_of(runs, fit.model, clock_s);
    fit.significance = significance_in_system(system, n);
    const Matrix covariance = inverse(system.information);
    std::vector<double> step(system.score.size(), 0.0);
    for (int i = 0; i < covariance.n; ++i)
      for (int j = 0; j < covariance.n; ++j) step[i] += covariance(i, j) * system.score[static_cast<std::size_t>(j)];
    fit.model.drive.wheel_radius_left_m += step[0];
    fit.model.drive.wheel_radius_right_m += step[1];
    fit.model.drive.wheelbase_m += step[2];
    fit.model.truth.axle_T_tracked.x_m += step[3];
    fit.model.truth.axle_T_tracked.y_m += step[4];
    fit.model.truth.axle_T_tracked.heading_rad += step[5];
    for (int r = 0; r < n; ++r) clock_s[r] += step[kShared + r];
    for (std::size_t k = 0; k < fit.size.size(); ++k) fit.size[k] += step[kShared + n + static_cast<int>(k)];
  }
  double mean = 0.0;
  for (double c : clock_s) mean += c / n;
  fit.model.truth.time_offset_s = mean;
  return fit;
}

Track oracle_track(const InnovationRun& run, const InnovationModel& model, const std::vector<double>& size) {
  const DifferentialDrive& d = model.drive;
  Track track;
  Pose pose;
  for (std::size_t i = 0; i < run.wheels.size(); ++i) {
    track.push_back({run.wheels[i].time_s + model.truth.time_offset_s, pose * model.truth.axle_T_tracked});
    if (i + 1 == run.wheels.size()) break;
    const double left = d.wheel_radius_left_m * (run.wheels[i + 1].left_rad - run.wheels[i].left_rad);
    const double right = d.wheel_radius_right_m * (run.wheels[i + 1].right_rad - run.wheels[i].right_rad);
    double forward = 0.5 * (left + right), sideways = 0.0, turn = (right - left) / d.wheelbase_m;
    for (std::size_t k = 0; k < run.extra.size(); ++k) {
      const BodyMotion& m = run.extra[k].per_step[i];
      forward += size[k] * m.forward_m;
      sideways += size[k] * m.sideways_m;
      turn += size[k] * m.turn_rad;
    }
    const double middle = pose.heading_rad + 0.5 * turn, c = std::cos(middle), s = std::sin(middle);
    pose = {pose.x_m + forward * c - sideways * s, pose.y_m + forward * s + sideways * c, pose.heading_rad + turn};
  }
  return track;
}

}  // namespace odolab::concealed
