// The symmetric 3 by 3 covariance of a pose, by x, y and heading.
#pragma once

namespace odolab {

struct PoseCovariance {
  double xx = 0.0, xy = 0.0, xh = 0.0, yy = 0.0, yh = 0.0, hh = 0.0;

  static PoseCovariance packed(const double* of) { return {of[0], of[1], of[2], of[3], of[4], of[5]}; }
  void pack(double* into) const {
    const double of[6] = {xx, xy, xh, yy, yh, hh};
    for (int k = 0; k < 6; ++k) into[k] = of[k];
  }

  // That of a point (dx, dy) further on, or of the pose behind a motion by as much: F P F' with F = (1 0 -dy; 0 1 dx;
  // 0 0 1).
  PoseCovariance carried(double dx, double dy) const {
    PoseCovariance out;
    out.xh = xh - dy * hh;
    out.yh = yh + dx * hh;
    out.xx = xx - dy * xh - dy * out.xh;
    out.xy = xy - dy * yh + dx * out.xh;
    out.yy = yy + dx * yh + dx * out.yh;
    out.hh = hh;
    return out;
  }
  // In a frame turned back by the angle of that cosine and sine.
  PoseCovariance turned(double c, double s) const {
    const double ax = c * xx - s * xy, ay = c * xy - s * yy, bx = s * xx + c * xy, by = s * xy + c * yy;
    return {c * ax - s * ay, s * ax + c * ay, c * xh - s * yh, s * bx + c * by, s * xh + c * yh, hh};
  }
  // Adds a variance along (x, y, h).
  void add(double variance, double x, double y, double h) {
    xx += x * (variance * x);
    xy += x * (variance * y);
    xh += x * (variance * h);
    yy += y * (variance * y);
    yh += y * (variance * h);
    hh += h * (variance * h);
  }
  void add(const PoseCovariance& other) {
    xx += other.xx;
    xy += other.xy;
    xh += other.xh;
    yy += other.yy;
    yh += other.yh;
    hh += other.hh;
  }
  PoseCovariance times(double variance) const {
    return {variance * xx, variance * xy, variance * xh, variance * yy, variance * yh, variance * hh};
  }
};

}  // namespace odolab
