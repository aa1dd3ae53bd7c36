#include "physics/floor_grip.h"

#include <cmath>

namespace odolab {

namespace {

// Coulomb's law is softened below the last of these slips; the solve comes down to it through softer ones, each from
// the last's answer.
constexpr double kSofteningSlips_mps[] = {0.05, 0.008, 0.0014, 0.0003, 0.00008, 0.00002};
constexpr double kHardestSlip_mps = 0.00002;
constexpr int kNewtonSteps = 30;

}  // namespace

FloorGrip::FloorGrip(PlanarWorld& world, int body, double mass_kg, double moment_of_inertia_kgm2, double step_s)
    : world_(&world), body_(body), mass_kg_(mass_kg), inertia_kgm2_(moment_of_inertia_kgm2), step_s_(step_s) {}

int FloorGrip::add_pad(Vec2 place) {
  Pad pad;
  pad.place = place;
  pads_.push_back(pad);
  return static_cast<int>(pads_.size()) - 1;
}

void FloorGrip::set_pad(int pad, Vec2 velocity_mps, double grip_n) {
  pads_[static_cast<std::size_t>(pad)].velocity_mps = velocity_mps;
  pads_[static_cast<std::size_t>(pad)].grip_n = grip_n;
}

// Half the kinetic energy of the change plus what friction dissipates in the step: its minimum is the motion after it.
double FloorGrip::cost(const Motion& m, const Motion& free, double softness_mps) const {
  const double dx = m.x_mps - free.x_mps, dy = m.y_mps - free.y_mps, dr = m.rate_radps - free.rate_radps;
  double sum = 0.5 * (mass_kg_ * (dx * dx + dy * dy) + inertia_kgm2_ * dr * dr);
  for (const Pad& pad : pads_) {
    const Vec2 slip = slip_mps(pad, m);
    sum += step_s_ * pad.grip_n * std::sqrt(dot(slip, slip) + softness_mps * softness_mps);
  }
  return sum;
}

FloorGrip::Motion FloorGrip::newton_step(const Motion& m, const Motion& free, double softness_mps) const {
  double gx = mass_kg_ * (m.x_mps - free.x_mps), gy = mass_kg_ * (m.y_mps - free.y_mps);
  double gr = inertia_kgm2_ * (m.rate_radps - free.rate_radps);
  double hxx = mass_kg_, hxy = 0.0, hyy = mass_kg_, hxr = 0.0, hyr = 0.0, hrr = inertia_kgm2_;
  for (const Pad& pad : pads_) {
    const Vec2 slip = slip_mps(pad, m);
    const double size = std::sqrt(dot(slip, slip) + softness_mps * softness_mps);
    const double k = step_s_ * pad.grip_n / size;
    const double ux = slip.x_m / size, uy = slip.y_m / size;
    const double px = -pad.place.y_m, py = pad.place.x_m;  // the pad's velocity for a turn rate of one
    gx += k * slip.x_m;
    gy += k * slip.y_m;
    gr += k * (px * slip.x_m + py * slip.y_m);
    const double axx = k * (1.0 - ux * ux), axy = -k * ux * uy, ayy = k * (1.0 - uy * uy);
    const double axr = axx * px + axy * py, ayr = axy * px + ayy * py;
    hxx += axx;
    hxy += axy;
    hyy += ayy;
    hxr += axr;
    hyr += ayr;
    hrr += px * axr + py * ayr;
  }
  // The symmetric 3 x 3 system by elimination.
  const double lyx = hxy / hxx, lrx = hxr / hxx;
  const double dyy = hyy - lyx * hxy, dyr = hyr - lyx * hxr;
  const double lry = dyr / dyy;
  const double drr = hrr - lrx * hxr - lry * dyr;
  const double by = gy - lyx * gx;
  const double r = (gr - lrx * gx - lry * by) / drr;
  const double y = (by - dyr * r) / dyy;
  const double x = (gx - hxy * y - hxr * r) / hxx;
  return {-x, -y, -r};
}

void FloorGrip::before_step() {
  const Pose& pose = world_->pose(body_);
  const Vec2 velocity = world_->velocity_mps(body_);
  const double rate = world_->yaw_rate_radps(body_);
  const double middle_rad = pose.heading_rad + 0.5 * step_s_ * rate;
  const Vec2 in_body = rotated(velocity, -middle_rad);
  const Vec2 pushed = rotated(velocity + (step_s_ / mass_kg_) * other_force_n_, -middle_rad);
  const Motion free{pushed.x_m, pushed.y_m, rate + step_s_ / inertia_kgm2_ * other_torque_nm_};

  Motion m{in_body.x_m, in_body.y_m, rate};
  for (const double softness : kSofteningSlips_mps) {
    double now = cost(m, free, softness);
    for (int i = 0; i < kNewtonSteps; ++i) {
      const Motion step = newton_step(m, free, softness);
      double share = 1.0;
      Motion next = m;
      double then = now;
      for (int halvings = 0; halvings < 30; ++halvings) {
        next = {m.x_mps + share * step.x_mps, m.y_mps + share * step.y_mps, m.rate_radps + share * step.rate_radps};
        then = cost(next, free, softness);
        if (then <= now) break;
        share *= 0.5;
      }
      if (then > now) break;  // rounding: it stands at the minimum
      const bool settled = now - then <= 1e-15 * now;
      m = next;
      now = then;
      if (settled) break;
    }
  }

  Vec2 force_n;
  double torque_nm = 0.0;
  for (Pad& pad : pads_) {
    const Vec2 slip = slip_mps(pad, m);
    const double size = std::sqrt(dot(slip, slip) + kHardestSlip_mps * kHardestSlip_mps);
    pad.force_n = (-pad.grip_n / size) * slip;
    force_n = force_n + pad.force_n;
    torque_nm += cross(pad.place, pad.force_n);
  }
  const Vec2 on_floor_n = rotated(force_n, middle_rad);
  world_->apply_force(body_, on_floor_n, torque_nm);
  expected_mps_ = velocity + (step_s_ / mass_kg_) * on_floor_n;
  expected_radps_ = rate + step_s_ / inertia_kgm2_ * torque_nm;
}

void FloorGrip::after_step() {
  other_force_n_ = (mass_kg_ / step_s_) * (world_->velocity_mps(body_) - expected_mps_);
  other_torque_nm_ = inertia_kgm2_ / step_s_ * (world_->yaw_rate_radps(body_) - expected_radps_);
}

}  // namespace odolab
