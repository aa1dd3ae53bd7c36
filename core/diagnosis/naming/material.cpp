#include "core/diagnosis/naming/material.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

constexpr double kMostLeftWhereSmoothed = 0.9;
constexpr double kNothing = 4e-10;  // square metres or radians: what no floor or camera resolves
constexpr double kByChance = 2.5;   // standard deviations
constexpr double kOfOneWindow =
    3.0;  // what stays in it is of no chance beyond so many of all windows' standard deviations

// Share of the squared error by which dead reckoning becomes worse, and by how much it may where the term is right:
// what is taken away is independent of what stays, so the sum of squares should fall by its own, but for chance: twice
// the sum of their products, each as it is expected or, where few windows make it up, as it is.
struct Change {
  double worse = 0.0, may_be_worse = 0.0;
};

Change change_of(const JointModel::GatheredError& before, const JointModel::GatheredError& after) {
  const double n = static_cast<double>(before.of_window.size());
  Change sum;
  const auto add = [&](const auto& product) {
    double was = n * kNothing, is = n * kNothing, by = 0.0;
    for (const Pose& e : before.of_window) was += product(e, e);
    double crossed = 0.0;
    for (std::size_t i = 0; i < before.of_window.size(); ++i) {
      const Pose &e = before.of_window[i], &f = after.of_window[i];
      const Pose d{f.x_m - e.x_m, f.y_m - e.y_m, f.heading_rad - e.heading_rad};
      is += product(f, f);
      by += product(d, d);
      const double p = product(f, d), most = kOfOneWindow * kOfOneWindow * was / n;
      crossed += p * p * std::min(1.0, most / std::max(product(f, f), kNothing));
    }
    sum.worse += 0.5 * (is - was) / was;
    sum.may_be_worse += 0.5 * (kByChance * 2.0 * std::sqrt(std::max(by * was / n, crossed)) - by) / was;
  };
  add([](const Pose& a, const Pose& b) { return dot(a.position(), b.position()); });
  add([](const Pose& a, const Pose& b) { return a.heading_rad * b.heading_rad; });
  return sum;
}

// A clock that moves may begin a run with another sample of the truth: then all its windows are others, with a noise of
// their own.
bool have_the_same_windows(const JointModel::GatheredError& a, const JointModel::GatheredError& b) {
  return a.windows == b.windows && a.window_at_s == b.window_at_s;
}

// Whether a term moves dead reckoning nowhere by more than any floor or camera resolves.
bool moves_nothing(const JointModel::GatheredError& before, const JointModel::GatheredError& after) {
  for (std::size_t i = 0; i < before.of_window.size(); ++i) {
    const Pose &e = before.of_window[i], &f = after.of_window[i];
    const Vec2 moved = f.position() - e.position();
    if (dot(moved, moved) >= kNothing || std::pow(f.heading_rad - e.heading_rad, 2) >= kNothing) return false;
  }
  return true;
}

// So much larger a mean square of so many windows may be by chance than that of so many others: each is the square of
// two numbers, and as uncertain as it is large.
double larger_by_chance(int windows) { return 1.0 + kByChance * std::sqrt(2.0 / std::max(1, windows)); }

}  // namespace

bool is_nothing(const JointModel::GatheredError& error) {
  return error.windows > 0 && error.position_m2 < kNothing && error.heading_rad2 < kNothing;
}

bool lowers(const JointModel::GatheredError& before, const JointModel::GatheredError& after, double most_left) {
  if (is_nothing(before)) return false;
  if (before.windows == 0 || after.windows == 0) return true;
  const double left = 0.5 * ((after.position_m2 + kNothing) / (before.position_m2 + kNothing) +
                             (after.heading_rad2 + kNothing) / (before.heading_rad2 + kNothing));
  return left < most_left;
}

double worse_than_chance(const JointModel::GatheredError& before, const JointModel::GatheredError& after) {
  if (before.windows == 0 || !have_the_same_windows(before, after) || is_nothing(after)) return 0.0;
  const Change change = change_of(before, after);
  return change.worse - std::max(change.may_be_worse, 0.0);
}

bool is_material(double distrust, bool truth_noise_lasts, const JointModel::GatheredError& before,
                 const JointModel::GatheredError& after, std::size_t numbers) {
  const double of_numbers = std::min(0.5, (1.0 - kMaterial) * static_cast<double>(numbers));
  const double lower = truth_noise_lasts ? std::max(of_numbers, 1.0 - kMostLeftWhereSmoothed) : of_numbers;
  if (before.windows == 0 || !have_the_same_windows(before, after))
    return lowers(before, after, std::lerp(larger_by_chance(before.windows), 1.0 - lower, distrust));
  if (moves_nothing(before, after)) return false;
  const Change change = change_of(before, after);
  return !is_nothing(before) && change.worse < std::lerp(std::max(change.may_be_worse, 0.0), -lower, distrust);
}

bool is_material(const JointModel& joint, const JointModel::GatheredError& before,
                 const JointModel::GatheredError& after) {
  return is_material(joint.distrust(), joint.truth_noise_lasts, before, after);
}

}  // namespace odolab
