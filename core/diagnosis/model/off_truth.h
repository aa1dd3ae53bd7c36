// What a derivative of the pose does to a truth whose frame comes back: for the linearised runs alone, README.md, Eq.
// 3a.
#pragma once

namespace odolab {

// By how much the frame is off, x, y and heading, for each column that is carried: `T` is one number or several
// abreast.
template <typename T>
struct OffTruth {
  T by[3];

  OffTruth() {
    for (T& row : by) row = T(nothing());
  }

  // Beside what the pose alone makes of it: e is predicted, `out` whitened, d goes on.
  template <typename Carry>
  void go_on(const Carry& carry, const T& e0, const T& e1, const T& e2, T* out, T& d0, T& d1, T& d2) {
    T f[3];
    for (int r = 0; r < 3; ++r) f[r] = carry.decay * by[r];
    const T read_h = carry.read_heading * f[2];
    const T seen[3] = {e0 - carry.ay * e2 + f[0], e1 + carry.ax * e2 + f[1], carry.read_heading * e2 + read_h};
    T* const d[3] = {&d0, &d1, &d2};
    for (int r = 0; r < 3; ++r) {
      const double *w = carry.out + 3 * r, *pose = carry.pose_gain + 3 * r, *truth = carry.truth_gain + 3 * r;
      out[r] += w[0] * f[0] + w[1] * f[1] + w[2] * read_h;
      *d[r] -= pose[0] * f[0] + pose[1] * f[1] + pose[2] * read_h;
      by[r] = f[r] - (truth[0] * seen[0] + truth[1] * seen[1] + truth[2] * seen[2]);
    }
  }

  // The other way about: `out` is the whitened sample's part, a that of d behind it; `e` is added to.
  template <typename Carry>
  void go_back(const Carry& carry, const T* out, const T& a0, const T& a1, const T& a2, T* e) {
    const T a[3] = {a0, a1, a2};
    T seen[3];
    for (int c = 0; c < 3; ++c)
      seen[c] = -(carry.truth_gain[c] * by[0] + carry.truth_gain[3 + c] * by[1] + carry.truth_gain[6 + c] * by[2]);
    e[0] += seen[0];
    e[1] += seen[1];
    e[2] += -carry.ay * seen[0] + carry.ax * seen[1] + carry.read_heading * seen[2];
    for (int c = 0; c < 3; ++c) {
      T read = seen[c];
      for (int r = 0; r < 3; ++r) read += carry.out[3 * r + c] * out[r] - carry.pose_gain[3 * r + c] * a[r];
      by[c] = carry.decay * (by[c] + (c == 2 ? carry.read_heading : 1.0) * read);
    }
  }

 private:
  static auto nothing() {
    if constexpr (requires { T::Zero(); })
      return T::Zero();
    else
      return 0.0;
  }
};

}  // namespace odolab
