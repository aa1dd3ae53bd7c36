// How the filter's pose and covariance change with the logarithm of each noise size, carried along with it: README.md
// in this folder, Eq. 9a.
#pragma once

#include <Eigen/Core>

#include "core/calibration/noise_slopes.h"
#include "core/calibration/pose_covariance.h"

namespace odolab {

// The Cholesky factor of an innovation's covariance, and what the filter has worked out with it.
struct WhitenedUpdate {
  double l10, l20, l21;     // below the diagonal
  double i00, i11, i22;     // one over the diagonal
  const double (*by)[3];    // by[j]: l^-1 H P of the pose's column j
  const double* white;      // l^-1 of the residual
  Vec2 arm;                 // from the axle to the tracked point, in the room
  bool has_heading = true;  // else the third row of H is zero
};

class NoiseCarry {
 public:
  // The pose is a truth sample taken back by the arm. `heading2`: the noise's part of its heading's variance.
  void begin_at(double position2, double heading2, Vec2 arm) {
    xx_ = xy_ = xh_ = yy_ = yh_ = hh_ = x_ = y_ = h_ = Sizes::Zero();
    PoseCovariance by_heading{0.0, 0.0, 0.0, 0.0, 0.0, 2.0 * heading2};
    add(noise_size::heading, by_heading.carried(-arm.x_m, -arm.y_m));
    add(noise_size::position, {2.0 * position2, 0.0, 0.0, 2.0 * position2, 0.0, 0.0});
  }

  // Moved by (dx, dy) in the room.
  void carry(double dx, double dy) {
    x_ -= dy * h_;
    y_ += dx * h_;
    const Sizes xh = xh_ - dy * hh_, yh = yh_ + dx * hh_;
    xx_ -= dy * (xh_ + xh);
    xy_ += dx * xh - dy * yh_;
    yy_ += dx * (yh_ + yh);
    xh_ = xh;
    yh_ = yh;
  }
  // That much variance of one size was added.
  void grow(int size, const PoseCovariance& variance) {
    add(size, {2.0 * variance.xx, 2.0 * variance.xy, 2.0 * variance.xh, 2.0 * variance.yy, 2.0 * variance.yh,
               2.0 * variance.hh});
  }

  void update(const WhitenedUpdate& u, double position2, double heading2) {
    const double third = u.has_heading ? 1.0 : 0.0;
    const auto whiten = [&](Sizes* v) {
      v[0] *= u.i00;
      v[1] = (v[1] - u.l10 * v[0]) * u.i11;
      v[2] = (v[2] - u.l20 * v[0] - u.l21 * v[1]) * u.i22;
    };
    const double ax = u.arm.x_m, ay = u.arm.y_m;
    // w[j]: l^-1 H dP of column j; m: l^-1 dS l^-T, its six entries; b: l^-1 of the residual's change.
    Sizes w[3][3] = {{xx_ - ay * xh_, xy_ + ax * xh_, third * xh_},
                     {xy_ - ay * yh_, yy_ + ax * yh_, third * yh_},
                     {xh_ - ay * hh_, yh_ + ax * hh_, third * hh_}};
    for (auto& column : w) whiten(column);
    Sizes row[3][3];
    for (int i = 0; i < 3; ++i) {
      row[i][0] = w[0][i] - ay * w[2][i];
      row[i][1] = w[1][i] + ax * w[2][i];
      row[i][2] = third * w[2][i];
      whiten(row[i]);
    }
    Sizes &m00 = row[0][0], &m01 = row[0][1], &m02 = row[0][2], &m11 = row[1][1], &m12 = row[1][2], &m22 = row[2][2];
    const double x0 = u.i00, x1 = -u.l10 * x0 * u.i11, x2 = (-u.l20 * x0 - u.l21 * x1) * u.i22;  // l^-1's columns
    const double y1 = u.i11, y2 = -u.l21 * y1 * u.i22, h2 = u.i22;
    const double p = 2.0 * position2;
    constexpr int at = noise_size::position;
    m00(at) += p * x0 * x0;
    m01(at) += p * x0 * x1;
    m02(at) += third * p * x0 * x2;
    m11(at) += p * (x1 * x1 + y1 * y1);
    m12(at) += third * p * (x1 * x2 + y1 * y2);
    m22(at) += third * p * (x2 * x2 + y2 * y2);
    m22(noise_size::heading) += third * 2.0 * heading2 * h2 * h2;
    Sizes b[3] = {ay * h_ - x_, -ax * h_ - y_, -third * h_};
    whiten(b);

    const double w0 = u.white[0], w1 = u.white[1], w2 = u.white[2];
    const Sizes mw0 = m00 * w0 + m01 * w1 + m02 * w2, mw1 = m01 * w0 + m11 * w1 + m12 * w2,
                mw2 = m02 * w0 + m12 * w1 + m22 * w2;
    slope_ += m00 + m11 + m22 + w0 * (2.0 * b[0] - mw0) + w1 * (2.0 * b[1] - mw1) + w2 * (2.0 * b[2] - mw2);
    for (int k = 0; k < noise_size::count; ++k)
      curvature_.col(k) +=
          m00 * m00(k) + m11 * m11(k) + m22 * m22(k) +
          2.0 * (m01 * m01(k) + m02 * m02(k) + m12 * m12(k) + b[0] * b[0](k) + b[1] * b[1](k) + b[2] * b[2](k));

    // The covariance loses by' by, the pose gains by' white.
    for (int j = 0; j < 3; ++j) {
      const double b0 = u.by[j][0], b1 = u.by[j][1], b2 = u.by[j][2];
      const Sizes g0 = m00 * b0 + m01 * b1 + m02 * b2, g1 = m01 * b0 + m11 * b1 + m12 * b2,
                  g2 = m02 * b0 + m12 * b1 + m22 * b2;
      Sizes& pose = j == 0 ? x_ : j == 1 ? y_ : h_;
      pose += (w[j][0] - g0) * w0 + (w[j][1] - g1) * w1 + (w[j][2] - g2) * w2 + b0 * b[0] + b1 * b[1] + b2 * b[2];
      w[j][0] -= 0.5 * g0;
      w[j][1] -= 0.5 * g1;
      w[j][2] -= 0.5 * g2;
    }
    const auto lose = [&](Sizes& of, int i, int j) {
      for (int k = 0; k < 3; ++k) of -= w[i][k] * u.by[j][k] + w[j][k] * u.by[i][k];
    };
    lose(xx_, 0, 0);
    lose(xy_, 0, 1);
    lose(xh_, 0, 2);
    lose(yy_, 1, 1);
    lose(yh_, 1, 2);
    lose(hh_, 2, 2);
  }

  // Of twice the negative log-likelihood: its slope, and Fisher's information times two.
  double slope(int size) const { return slope_(size); }
  double curvature(int size, int other) const { return curvature_(size, other); }

 private:
  static constexpr int kLanes = noise_size::count + noise_size::count % 2;  // even, so that they fill whole registers
  using Sizes = Eigen::Array<double, kLanes, 1>;

  void add(int size, const PoseCovariance& c) {
    xx_(size) += c.xx;
    xy_(size) += c.xy;
    xh_(size) += c.xh;
    yy_(size) += c.yy;
    yh_(size) += c.yh;
    hh_(size) += c.hh;
  }

  Sizes xx_, xy_, xh_, yy_, yh_, hh_;  // of the covariance
  Sizes x_, y_, h_;                    // of the pose
  Sizes slope_ = Sizes::Zero();
  Eigen::Array<double, kLanes, noise_size::count> curvature_ = Eigen::Array<double, kLanes, noise_size::count>::Zero();
};

}  // namespace odolab
