#include "core/odometry/cast.h"

#include <cassert>
#include <cmath>

namespace odolab {

namespace {

constexpr int kTurnIterations = 3;  // the turn of an interval is small: each one gains about two digits

// X of Eq. 16.
struct BodyShift {
  double dx_m = 0.0;
  double dy_m = 0.0;
  double dpsi_rad = 0.0;
};

// Least squares of Eqs. 13 and 14 in the body's motion, linearised at the heading psi: X = (H'H)^-1 H'Y, Eq. 15.
BodyShift least_squares(const std::vector<PivotWay>& pivots, double psi_rad) {
  const double n = static_cast<double>(pivots.size());
  double m_x = 0.0, m_y = 0.0;  // the pivots' middle in the body's frame
  double d = 0.0;
  double sum_x = 0.0, sum_y = 0.0, moment = 0.0;  // H'Y
  for (const PivotWay& pivot : pivots) {
    const Vec2 r = pivot.castor->pivot(), arm = rotated(r, psi_rad);
    m_x += r.x_m / n;
    m_y += r.y_m / n;
    d += dot(r, r);  // Eq. 21
    sum_x += pivot.way.x_m;
    sum_y += pivot.way.y_m;
    moment += cross(arm, pivot.way);  // R (cos(psi + phi) dy - sin(psi + phi) dx), the third row of H'
  }
  const double b = -n * (m_y * std::cos(psi_rad) + m_x * std::sin(psi_rad));  // Eq. 19, where "m_v" is m_y
  const double c = n * (m_x * std::cos(psi_rad) - m_y * std::sin(psi_rad));   // Eq. 20
  const double scale = 1.0 / (n * (b * b + c * c - n * d));                   // Eq. 18
  return {scale * ((c * c - n * d) * sum_x - b * c * sum_y + n * b * moment),
          scale * (-b * c * sum_x + (b * b - n * d) * sum_y + n * c * moment),
          scale * (n * b * sum_x + n * c * sum_y - n * n * moment)};
}

// Eq. 22.
BodyShift centred(const std::vector<PivotWay>& pivots, double psi_rad) {
  const double n = static_cast<double>(pivots.size());
  BodyShift x;
  for (const PivotWay& pivot : pivots) {
    const double direction_rad = psi_rad + pivot.castor->pivot_angle_rad;
    x.dx_m += pivot.way.x_m / n;
    x.dy_m += pivot.way.y_m / n;
    x.dpsi_rad += (pivot.way.y_m * std::cos(direction_rad) - pivot.way.x_m * std::sin(direction_rad)) /
                  pivot.castor->pivot_radius_m / n;
  }
  return x;
}

Pose moved_by_cast(const Pose& body, const std::vector<PivotWay>& pivots, const CastOptions& options) {
  const auto solve = [&](double psi_rad) {
    return options.method == CastorMethod::cast ? least_squares(pivots, psi_rad) : centred(pivots, psi_rad);
  };
  BodyShift x = solve(body.heading_rad);
  if (options.linearisation == Linearisation::middle_heading) {
    for (int i = 0; i < kTurnIterations; ++i) {
      x = solve(body.heading_rad + 0.5 * x.dpsi_rad);
      x.dpsi_rad = 2.0 * std::asin(0.5 * x.dpsi_rad);  // at the middle heading the unknown is 2 sin(turn / 2)
    }
  }
  return {body.x_m + x.dx_m, body.y_m + x.dy_m, body.heading_rad + x.dpsi_rad};
}

Pose moved_by_ipec(const Pose& body, const PivotWay& first, const PivotWay& second) {
  const Vec2 pivot_1 = body * first.castor->pivot() + first.way, pivot_2 = body * second.castor->pivot() + second.way;
  const Vec2 seen = pivot_2 - pivot_1, drawn = second.castor->pivot() - first.castor->pivot();
  // Eq. 10, with the direction in which the two pivots lie on the body taken off, modulo a turn
  const double heading_rad = unwrapped(std::atan2(seen.y_m, seen.x_m) - std::atan2(drawn.y_m, drawn.x_m),  //
                                       body.heading_rad);
  const Vec2 origin = pivot_1 - rotated(first.castor->pivot(), heading_rad);
  return {origin.x_m, origin.y_m, heading_rad};
}

}  // namespace

std::string problem_in(const CastOptions& options, const MultiCastor& vehicle) {
  const int castors = static_cast<int>(vehicle.castors.size());
  if (options.left_out < 0 || options.left_out > castors)
    return "left_out: found " + std::to_string(options.left_out) + ", expected 0 (none) to " + std::to_string(castors);
  const int used = castors - (options.left_out > 0 ? 1 : 0);
  if (used < 2) return "castors: found " + std::to_string(used) + " to be used, expected two or more";
  if (options.method == CastorMethod::ipec && used != 2)
    return "castors: found " + std::to_string(used) + " for IPEC, expected two: leave the others out";
  if (options.method == CastorMethod::cast_centred) {
    Vec2 sum;
    for (int i = 0; i < castors; ++i)
      if (i + 1 != options.left_out) sum = sum + vehicle.castors[static_cast<std::size_t>(i)].pivot();
    if (length(sum) > 1e-6) return "castors: found pivots about another point than the origin, expected them centred";
    for (const Castor& castor : vehicle.castors)
      if (std::abs(castor.pivot_radius_m - vehicle.castors.front().pivot_radius_m) > 1e-6)
        return "castors: found pivots at different radii, expected one radius";
  }
  return "";
}

std::vector<PivotWay> pivot_ways(const MultiCastor& vehicle, const CastorSample& before, const CastorSample& now,
                                 const Pose& body, HeadingRule rule, const std::vector<char>& left_out) {
  std::vector<PivotWay> pivots;
  for (std::size_t i = 0; i < vehicle.castors.size(); ++i) {
    if (i < left_out.size() && left_out[i]) continue;
    const Castor& castor = vehicle.castors[i];
    const CastorMotion motion = castor_motion(castor, before.castors[i], now.castors[i]);
    pivots.push_back({&castor, pivot_way(castor, motion, body.heading_rad, rule)});
  }
  return pivots;
}

Pose moved_by_pivots(const Pose& body, const std::vector<PivotWay>& pivots, const CastOptions& options) {
  assert(pivots.size() >= 2);
  return options.method == CastorMethod::ipec ? moved_by_ipec(body, pivots[0], pivots[1])
                                              : moved_by_cast(body, pivots, options);
}

Track castor_track(const std::vector<CastorSample>& samples, const MultiCastor& vehicle, const Pose& start,
                   const CastOptions& options) {
  assert(problem_in(options, vehicle).empty());
  std::vector<char> left_out(vehicle.castors.size(), 0);
  if (options.left_out > 0) left_out[static_cast<std::size_t>(options.left_out - 1)] = 1;
  Track track;
  track.reserve(samples.size());
  Pose body = start;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    // The castors' headings are the body's new one and the measured angles: nothing of their own is carried on.
    if (i > 0)
      body = moved_by_pivots(body, pivot_ways(vehicle, samples[i - 1], samples[i], body, options.heading, left_out),
                             options);
    track.push_back({samples[i].time_s, body});
  }
  return track;
}

}  // namespace odolab
