#include "physics/coulomb_solve.h"

#include <cmath>
#include <cstddef>

namespace odolab {

namespace {

// A solve that does not settle at once comes down to the softness asked for through softer laws, each from the last's
// answer.
constexpr double kSofter_mps[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
constexpr int kNewtonSteps = 40;
constexpr int kHalvings = 30;
constexpr double kFullPull = 0.999999;

// The velocity of a point of the body whose three numbers begin at v.
Vec2 point_mps(const double* v, Vec2 arm) { return {v[0] - v[2] * arm.y_m, v[1] + v[2] * arm.x_m}; }

double speed_along(const CoulombLink& link, const std::vector<double>& v) {
  double speed = dot(link.direction, point_mps(&v[3 * static_cast<std::size_t>(link.body_b)], link.arm_b));
  if (link.body_a >= 0)
    speed -= dot(link.direction, point_mps(&v[3 * static_cast<std::size_t>(link.body_a)], link.arm_a));
  return speed;
}

// Solves the symmetric positive definite system a x = b of n numbers, x in b's place, by elimination.
void solve_in_place(std::vector<double>& a, std::vector<double>& b, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    const double pivot = a[k * n + k];
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[k * n + i] / pivot;
      if (factor == 0.0) continue;
      for (std::size_t j = i; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k * n + j] * b[j];
    b[k] /= a[k * n + k];
  }
}

}  // namespace

// After the bodies' numbers come those of the drives.
Vec2 CoulombSolve::slip_mps(const std::vector<double>& v, const CoulombContact& c) const {
  const Vec2 slip = point_mps(&v[3 * static_cast<std::size_t>(c.body)], c.arm) - c.surface_mps;
  return c.drive < 0 ? slip : slip - v[3 * bodies.size() + static_cast<std::size_t>(c.drive)] * c.direction;
}

double CoulombSolve::cost(const std::vector<double>& v, double soft_mps) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double dx = v[3 * i] - before_[3 * i], dy = v[3 * i + 1] - before_[3 * i + 1];
    const double dr = v[3 * i + 2] - before_[3 * i + 2];
    sum += 0.5 * (bodies[i].mass_kg * (dx * dx + dy * dy) + bodies[i].inertia_kgm2 * dr * dr);
  }
  for (const CoulombContact& c : contacts) {
    const Vec2 slip = slip_mps(v, c);
    sum += c.grip_ns * std::sqrt(dot(slip, slip) + soft_mps * soft_mps);
  }
  for (std::size_t d = 0; d < drives.size(); ++d) {
    const double yielded = v[3 * bodies.size() + d] - drives[d].free_mps;
    sum += 0.5 * drives[d].inertia_kg * yielded * yielded;
  }
  for (const CoulombLink& link : links) {
    const double u = speed_along(link, v);
    sum += 0.5 * link.resistance_kg * u * u + link.bias_ns * u;
  }
  return sum;
}

// Into step_, from v: against the gradient, by the curvature (its upper half is filled) as it is with the contacts'
// pulls for unknowns of their own (T. F. Chan, G. H. Golub, P. Mulet, "A nonlinear primal-dual method for total
// variation-based image restoration", 1999, Eq. 4.7, made symmetric): a tenth of the steps that plain Newton takes.
void CoulombSolve::newton_step(const std::vector<double>& v, double soft_mps) {
  const std::size_t n = 3 * bodies.size();
  std::vector<double>& h = hessian_;
  std::vector<double>& g = step_;
  h.assign(n * n, 0.0);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double weight[] = {bodies[i].mass_kg, bodies[i].mass_kg, bodies[i].inertia_kgm2};
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      h[k * n + k] = weight[k - 3 * i];
      g[k] = weight[k - 3 * i] * (v[k] - before_[k]);
    }
  }
  for (std::size_t d = 0; d < drives.size(); ++d)
    drive_rows_[d] = {drives[d].inertia_kg * (v[n + d] - drives[d].free_mps), drives[d].inertia_kg, {}};
  for (std::size_t m = 0; m < contacts.size(); ++m) {
    const CoulombContact& c = contacts[m];
    const Vec2 pull = pulls_[m];
    const std::size_t at = 3 * static_cast<std::size_t>(c.body);
    const Vec2 slip = slip_mps(v, c);
    const double size = std::sqrt(dot(slip, slip) + soft_mps * soft_mps);
    const double k = c.grip_ns / size;
    const double ux = slip.x_m / size, uy = slip.y_m / size;
    const Vec2 impulse = k * slip;
    const double axx = k * (1.0 - pull.x_m * ux), ayy = k * (1.0 - pull.y_m * uy);
    const double axy = -0.5 * k * (pull.x_m * uy + pull.y_m * ux);
    const double px = -c.arm.y_m, py = c.arm.x_m;  // the point's velocity for a turn rate of one
    g[at] += impulse.x_m;
    g[at + 1] += impulse.y_m;
    g[at + 2] += px * impulse.x_m + py * impulse.y_m;
    const double axr = axx * px + axy * py, ayr = axy * px + ayy * py;
    h[at * n + at] += axx;
    h[at * n + at + 1] += axy;
    h[at * n + at + 2] += axr;
    h[(at + 1) * n + at + 1] += ayy;
    h[(at + 1) * n + at + 2] += ayr;
    h[(at + 2) * n + at + 2] += px * axr + py * ayr;
    if (c.drive < 0) continue;
    const Vec2 stiff{axx * c.direction.x_m + axy * c.direction.y_m, axy * c.direction.x_m + ayy * c.direction.y_m};
    DriveRow& row = drive_rows_[static_cast<std::size_t>(c.drive)];
    row.gradient -= dot(c.direction, impulse);
    row.curvature += dot(c.direction, stiff);
    row.with_body[0] -= stiff.x_m;
    row.with_body[1] -= stiff.y_m;
    row.with_body[2] -= px * stiff.x_m + py * stiff.y_m;
  }
  for (std::size_t d = 0; d < drives.size(); ++d) {  // eliminated
    const DriveRow& row = drive_rows_[d];
    const std::size_t at = 3 * static_cast<std::size_t>(drives[d].body);
    for (std::size_t i = 0; i < 3; ++i) {
      const double factor = row.with_body[i] / row.curvature;
      g[at + i] -= factor * row.gradient;
      for (std::size_t j = i; j < 3; ++j) h[(at + i) * n + at + j] -= factor * row.with_body[j];
    }
  }
  for (const CoulombLink& link : links) {
    const double impulse = link.resistance_kg * speed_along(link, v) + link.bias_ns;
    const double row_b[] = {link.direction.x_m, link.direction.y_m, cross(link.arm_b, link.direction)};
    const std::size_t b = 3 * static_cast<std::size_t>(link.body_b);
    for (std::size_t i = 0; i < 3; ++i) {
      g[b + i] += impulse * row_b[i];
      for (std::size_t j = i; j < 3; ++j) h[(b + i) * n + b + j] += link.resistance_kg * row_b[i] * row_b[j];
    }
    if (link.body_a < 0) continue;
    const double row_a[] = {-link.direction.x_m, -link.direction.y_m, -cross(link.arm_a, link.direction)};
    const std::size_t a = 3 * static_cast<std::size_t>(link.body_a);
    for (std::size_t i = 0; i < 3; ++i) {
      g[a + i] += impulse * row_a[i];
      for (std::size_t j = i; j < 3; ++j) h[(a + i) * n + a + j] += link.resistance_kg * row_a[i] * row_a[j];
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t first = a < b ? a + i : b + j, second = a < b ? b + j : a + i;
        h[first * n + second] += link.resistance_kg * row_a[i] * row_b[j];
      }
    }
  }
  solve_in_place(h, g, n);
  for (std::size_t k = 0; k < n; ++k) g[k] = -g[k];
  for (std::size_t d = 0; d < drives.size(); ++d) {
    const DriveRow& row = drive_rows_[d];
    double sum = row.gradient;
    for (std::size_t i = 0; i < 3; ++i) sum += row.with_body[i] * g[3 * static_cast<std::size_t>(drives[d].body) + i];
    g[n + d] = -sum / row.curvature;
  }
}

// The share of its grip that each contact uses, after the step from now_ to next_.
void CoulombSolve::take_pulls(double share, double soft_mps) {
  for (std::size_t m = 0; m < contacts.size(); ++m) {
    const CoulombContact& c = contacts[m];
    const std::size_t at = 3 * static_cast<std::size_t>(c.body);
    const Vec2 slip = slip_mps(now_, c);
    Vec2 change = point_mps(&step_[at], c.arm);
    if (c.drive >= 0) change = change - step_[3 * bodies.size() + static_cast<std::size_t>(c.drive)] * c.direction;
    change = share * change;
    const double size = std::sqrt(dot(slip, slip) + soft_mps * soft_mps);
    const Vec2 pull = (1.0 / size) * (slip + change - (dot(slip, change) / size) * pulls_[m]);
    const double much2 = dot(pull, pull);
    pulls_[m] = much2 > kFullPull * kFullPull ? (kFullPull / std::sqrt(much2)) * pull : pull;
  }
}

// Newton's method from now_; whether it came to rest.
bool CoulombSolve::settle(double soft_mps) {
  const std::size_t n = now_.size();
  pulls_.assign(contacts.size(), {});
  double least = cost(now_, soft_mps);
  for (int i = 0; i < kNewtonSteps; ++i) {
    newton_step(now_, soft_mps);
    double share = 1.0, then = least;
    for (int halvings = 0; halvings < kHalvings; ++halvings) {
      for (std::size_t k = 0; k < n; ++k) next_[k] = now_[k] + share * step_[k];
      then = cost(next_, soft_mps);
      if (then <= least) break;
      share *= 0.5;
    }
    if (then > least) return true;  // rounding: it stands at the minimum
    const bool settled = least - then <= 1e-15 * std::abs(least);
    take_pulls(share, soft_mps);
    now_.swap(next_);
    least = then;
    if (settled) return true;
  }
  return false;
}

void CoulombSolve::solve() {
  const std::size_t n = 3 * bodies.size();
  before_.resize(n);
  now_.resize(n + drives.size());
  next_.resize(n + drives.size());
  step_.assign(n + drives.size(), 0.0);
  drive_rows_.resize(drives.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    before_[3 * i] = bodies[i].velocity_mps.x_m;
    before_[3 * i + 1] = bodies[i].velocity_mps.y_m;
    before_[3 * i + 2] = bodies[i].yaw_rate_radps;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    now_[3 * i] = bodies[i].guess_mps.x_m;
    now_[3 * i + 1] = bodies[i].guess_mps.y_m;
    now_[3 * i + 2] = bodies[i].guess_radps;
  }
  for (std::size_t d = 0; d < drives.size(); ++d) now_[n + d] = drives[d].free_mps;
  if (!settle(softness_mps)) {
    for (const double softer_mps : kSofter_mps)
      if (softer_mps > softness_mps) settle(softer_mps);
    settle(softness_mps);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].velocity_mps = {now_[3 * i], now_[3 * i + 1]};
    bodies[i].yaw_rate_radps = now_[3 * i + 2];
  }
  for (CoulombContact& c : contacts) {
    const Vec2 slip = slip_mps(now_, c);
    c.impulse_ns = (-c.grip_ns / std::sqrt(dot(slip, slip) + softness_mps * softness_mps)) * slip;
  }
  for (std::size_t d = 0; d < drives.size(); ++d) drives[d].added_mps = now_[n + d];
  for (CoulombLink& link : links) link.impulse_ns = -(link.resistance_kg * speed_along(link, now_) + link.bias_ns);
}

}  // namespace odolab
