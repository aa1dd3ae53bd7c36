#include "core/calibration/linked.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/odometry/ipec.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// What is estimated, as departures from the vehicle file.
enum Unknown { kDifferenceA, kWheelbaseA, kScaleB, kDifferenceB, kWheelbaseB, kOffsetA, kOffsetB, kLength, kUnknowns };

// How far from the vehicle file a machine is expected at most: wide beside what recordings tell, so that only what they
// cannot tell is held.
constexpr std::array<double, kUnknowns> kPrior = {0.03, 0.05, 0.03, 0.03, 0.05, 0.05, 0.05, 0.02};
constexpr double kDeterminedShare = 0.2;  // of the prior's width, at most
constexpr double kHuber = 3.0;            // residuals beyond so many standard deviations count less: bumps
constexpr int kIterations = 12;

LinkedTrucks with(const LinkedTrucks& nominal, const VectorXd& x) {
  LinkedTrucks v = nominal;
  const auto truck = [](DifferentialDrive& t, double scale, double difference, double wheelbase) {
    t.wheel_radius_left_m *= (1.0 + scale) * (1.0 - 0.5 * difference);
    t.wheel_radius_right_m *= (1.0 + scale) * (1.0 + 0.5 * difference);
    t.wheelbase_m *= 1.0 + wheelbase;
  };
  truck(v.truck_a, 0.0, x[kDifferenceA], x[kWheelbaseA]);
  truck(v.truck_b, x[kScaleB], x[kDifferenceB], x[kWheelbaseB]);
  v.link_angle_a_offset_rad += x[kOffsetA];
  v.link_angle_b_offset_rad += x[kOffsetB];
  v.link_length_offset_m += x[kLength];
  return v;
}

// Consecutive samples of one recording, from `first` to `last`.
struct Stretch {
  const std::vector<LinkedSample>* samples = nullptr;
  std::size_t first = 0, last = 0;
};

std::vector<Stretch> stretches_of(const std::vector<LinkedSample>& samples, const LinkedTrucks& v,
                                  const LinkedCalibrationOptions& options) {
  std::vector<Stretch> stretches;
  double travel_m = 0.0, turn_rad = 0.0;
  std::size_t first = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const auto of = [&](const DifferentialDrive& t, const WheelRotation& from, const WheelRotation& to) {
      const Pose step = dead_reckoned(Pose{}, to.left_rad - from.left_rad, to.right_rad - from.right_rad, t);
      return std::array<double, 2>{length(step.position()), std::abs(step.heading_rad)};
    };
    const auto a = of(v.truck_a, samples[i - 1].a, samples[i].a), b = of(v.truck_b, samples[i - 1].b, samples[i].b);
    travel_m += std::max(a[0], b[0]);
    turn_rad += std::max(a[1], b[1]);
    if (travel_m < options.stretch_m && turn_rad < options.stretch_rad) continue;
    stretches.push_back({&samples, first, i});
    first = i;
    travel_m = turn_rad = 0.0;
  }
  return stretches;
}

// What the link's encoders read at the stretch's end, less what its start and the wheels predict: alpha, beta, length.
Vector3d contradiction(const Stretch& stretch, const LinkedTrucks& v) {
  const std::vector<LinkedSample>& s = *stretch.samples;
  LinkedSample start = s[stretch.first];
  start.link_angle_a_rad -= v.link_angle_a_offset_rad;
  start.link_angle_b_rad -= v.link_angle_b_offset_rad;
  start.link_length_m -= v.link_length_offset_m;
  const IpecState state = ipec_start(start, {});
  Pose a = state.a, b = state.b;
  for (std::size_t i = stretch.first + 1; i <= stretch.last; ++i) {
    a = dead_reckoned(a, s[i].a.left_rad - s[i - 1].a.left_rad, s[i].a.right_rad - s[i - 1].a.right_rad, v.truck_a);
    b = dead_reckoned(b, s[i].b.left_rad - s[i - 1].b.left_rad, s[i].b.right_rad - s[i - 1].b.right_rad, v.truck_b);
  }
  const Vec2 link = a.position() - b.position();
  const double link_rad = std::atan2(link.y_m, link.x_m);
  const LinkedSample& end = s[stretch.last];
  return {wrapped(end.link_angle_a_rad - v.link_angle_a_offset_rad - (a.heading_rad - link_rad)),
          wrapped(end.link_angle_b_rad - v.link_angle_b_offset_rad - (b.heading_rad - link_rad)),
          end.link_length_m - v.link_length_offset_m - length(link)};
}

// A robust standard deviation of each of the three contradictions, no smaller than the encoders' rounding at both ends.
Vector3d deviations(const std::vector<Vector3d>& residuals, const LinkedTrucks& v) {
  Vector3d result;
  const double least[3] = {v.link_angle_resolution_rad, v.link_angle_resolution_rad, v.link_length_resolution_m};
  for (int k = 0; k < 3; ++k) {
    std::vector<double> sizes;
    for (const Vector3d& r : residuals) sizes.push_back(std::abs(r[k]));
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    result[k] = std::max({1.4826 * *middle, least[k] / std::sqrt(6.0), 1e-7});
  }
  return result;
}

struct Fit {
  VectorXd x;
  MatrixXd covariance;
};

using Matrix3X = Eigen::Matrix<double, 3, Eigen::Dynamic>;

// How the contradictions of one stretch answer to every unknown, by differences.
Matrix3X jacobian_of(const Stretch& stretch, const LinkedTrucks& nominal, const VectorXd& x) {
  constexpr double kStep = 1e-5;
  Matrix3X jacobian(3, static_cast<int>(kUnknowns));
  for (int k = 0; k < kUnknowns; ++k) {
    VectorXd more = x, less = x;
    more[k] += kStep;
    less[k] -= kStep;
    jacobian.col(k) =
        (contradiction(stretch, with(nominal, more)) - contradiction(stretch, with(nominal, less))) / (2.0 * kStep);
  }
  return jacobian;
}

// The linearised problem about one x, all unknowns, without the priors.
struct Normal {
  MatrixXd information = MatrixXd::Zero(kUnknowns, kUnknowns);
  VectorXd gradient = VectorXd::Zero(kUnknowns);
  MatrixXd spread = MatrixXd::Zero(kUnknowns, kUnknowns);  // of the gradient, from its scatter and from rounding
};

// Rounding at the end of one stretch is that at the start of the next: the scores are correlated (Newey, West 1987).
void add_scatter(const std::vector<VectorXd>& scores, MatrixXd& spread) {
  constexpr std::size_t kLags = 2;
  for (std::size_t lag = 0; lag <= kLags; ++lag) {
    const double weight = 1.0 - static_cast<double>(lag) / (kLags + 1);
    for (std::size_t i = lag; i < scores.size(); ++i) {
      const MatrixXd product = weight * scores[i] * scores[i - lag].transpose();
      spread += product;
      if (lag > 0) spread += product.transpose();
    }
  }
}

// Trucks that hold an angle hold its rounding: all readings of one step of an encoder may err alike.
class RoundingByStep {
 public:
  explicit RoundingByStep(double step_rad) : step_rad_(step_rad) {}
  void add(double reading_rad, const VectorXd& effect) {
    if (step_rad_ <= 0.0) return;
    const auto [entry, is_new] = effects_.emplace(std::llround(reading_rad / step_rad_), effect);
    if (!is_new) entry->second += effect;
  }
  void add_to(MatrixXd& spread) const {
    for (const auto& [step, effect] : effects_) spread += step_rad_ * step_rad_ / 12.0 * effect * effect.transpose();
  }

 private:
  double step_rad_;
  std::map<long long, VectorXd> effects_;
};

Normal normal_equations(const std::vector<Stretch>& stretches, const LinkedTrucks& nominal, const VectorXd& x) {
  std::vector<Vector3d> residuals;
  for (const Stretch& s : stretches) residuals.push_back(contradiction(s, with(nominal, x)));
  const Vector3d sigma = deviations(residuals, nominal);
  Normal normal;
  std::vector<VectorXd> scores;
  RoundingByStep alpha(nominal.link_angle_resolution_rad), beta(nominal.link_angle_resolution_rad);
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Matrix3X jacobian = jacobian_of(stretches[i], nominal, x);
    Vector3d weight;
    for (int row = 0; row < 3; ++row) {
      const double z = std::abs(residuals[i][row]) / sigma[row];
      weight[row] = (z <= kHuber ? 1.0 : kHuber / z) / (sigma[row] * sigma[row]);
    }
    const MatrixXd weighted = jacobian.transpose() * weight.asDiagonal();
    normal.information += weighted * jacobian;
    scores.push_back(-weighted * residuals[i]);
    normal.gradient += scores.back();
    // A reading acts at the stretch's end directly; an offset acts at both ends, which tells how one at the start does.
    const LinkedSample& first = (*stretches[i].samples)[stretches[i].first];
    const LinkedSample& last = (*stretches[i].samples)[stretches[i].last];
    alpha.add(last.link_angle_a_rad, weighted.col(0));
    alpha.add(first.link_angle_a_rad, -weighted.col(0) - weighted * jacobian.col(kOffsetA));
    beta.add(last.link_angle_b_rad, weighted.col(1));
    beta.add(first.link_angle_b_rad, -weighted.col(1) - weighted * jacobian.col(kOffsetB));
  }
  add_scatter(scores, normal.spread);
  alpha.add_to(normal.spread);
  beta.add_to(normal.spread);
  return normal;
}

Fit fit(const std::vector<Stretch>& stretches, const LinkedTrucks& nominal, const std::vector<int>& free,
        const Progress& progress) {
  const int n = static_cast<int>(free.size());
  MatrixXd choice = MatrixXd::Zero(kUnknowns, n);  // the free ones among all
  for (int k = 0; k < n; ++k) choice(free[static_cast<std::size_t>(k)], k) = 1.0;
  VectorXd prior(kUnknowns);
  for (int k = 0; k < kUnknowns; ++k)
    prior[k] = 1.0 / (kPrior[static_cast<std::size_t>(k)] * kPrior[static_cast<std::size_t>(k)]);
  VectorXd x = VectorXd::Zero(kUnknowns);
  MatrixXd covariance;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    if (!goes_on(progress, static_cast<double>(iteration) / kIterations)) break;
    const Normal normal = normal_equations(stretches, nominal, x);
    const MatrixXd of_prior = prior.asDiagonal();
    const MatrixXd inverse = (choice.transpose() * (normal.information + of_prior) * choice).inverse();
    const VectorXd step = inverse * choice.transpose() * (normal.gradient - of_prior * x);
    covariance =
        choice * inverse * (choice.transpose() * (normal.spread + of_prior) * choice) * inverse * choice.transpose();
    x += choice * step;
    if (step.cwiseAbs().maxCoeff() < 1e-9) break;
  }
  return {x, covariance};
}

bool determined(const Fit& fit, int unknown) {
  const double variance = fit.covariance(unknown, unknown);
  return variance > 0.0 && std::sqrt(variance) < kDeterminedShare * kPrior[static_cast<std::size_t>(unknown)];
}

// One number of the vehicle file and how it follows from the unknowns.
struct Parameter {
  const char* name;
  const char* unit;
  double (*value)(const LinkedTrucks& v);
  std::vector<int> from;
};

const std::vector<Parameter>& parameters() {
  static const std::vector<Parameter> list = {
      {"truck_a.wheel_radius_left_m",
       "m",
       [](const LinkedTrucks& v) { return v.truck_a.wheel_radius_left_m; },
       {kDifferenceA}},
      {"truck_a.wheel_radius_right_m",
       "m",
       [](const LinkedTrucks& v) { return v.truck_a.wheel_radius_right_m; },
       {kDifferenceA}},
      {"truck_a.wheelbase_m", "m", [](const LinkedTrucks& v) { return v.truck_a.wheelbase_m; }, {kWheelbaseA}},
      {"truck_b.wheel_radius_left_m",
       "m",
       [](const LinkedTrucks& v) { return v.truck_b.wheel_radius_left_m; },
       {kScaleB, kDifferenceB}},
      {"truck_b.wheel_radius_right_m",
       "m",
       [](const LinkedTrucks& v) { return v.truck_b.wheel_radius_right_m; },
       {kScaleB, kDifferenceB}},
      {"truck_b.wheelbase_m", "m", [](const LinkedTrucks& v) { return v.truck_b.wheelbase_m; }, {kWheelbaseB}},
      {"link_angle_a_offset_rad", "rad", [](const LinkedTrucks& v) { return v.link_angle_a_offset_rad; }, {kOffsetA}},
      {"link_angle_b_offset_rad", "rad", [](const LinkedTrucks& v) { return v.link_angle_b_offset_rad; }, {kOffsetB}},
      {"link_length_offset_m", "m", [](const LinkedTrucks& v) { return v.link_length_offset_m; }, {kLength}},
  };
  return list;
}

ParameterEstimate estimate_of(const Parameter& p, const LinkedTrucks& nominal, const Fit& fit) {
  bool known = true;
  VectorXd slope = VectorXd::Zero(kUnknowns);
  for (int unknown : p.from) {
    known = known && determined(fit, unknown);
    VectorXd more = fit.x, less = fit.x;
    more[unknown] += 1e-6;
    less[unknown] -= 1e-6;
    slope[unknown] = (p.value(with(nominal, more)) - p.value(with(nominal, less))) / 2e-6;
  }
  const double variance = slope.dot(fit.covariance * slope);
  return {p.name, p.unit, p.value(nominal), p.value(with(nominal, fit.x)), std::sqrt(variance), known};
}

}  // namespace

Result<InternalCalibration> calibrate_linked(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                             const Progress& progress, const LinkedCalibrationOptions& options) {
  const LinkedTrucks& before = std::holds_alternative<Clapper>(nominal.kind)
                                   ? static_cast<const LinkedTrucks&>(std::get<Clapper>(nominal.kind))
                                   : static_cast<const LinkedTrucks&>(std::get<OmniMate>(nominal.kind));
  std::vector<std::vector<LinkedSample>> samples;
  for (const Recording& recording : recordings) {
    if (const std::string missing = missing_columns(recording, nominal); !missing.empty())
      return Error{recording.name.empty() ? "recording" : recording.name, "no " + missing,
                   "the encoders of a " + kind_name(nominal)};
    samples.push_back(linked_samples(recording));
  }
  std::vector<Stretch> stretches;
  for (const std::vector<LinkedSample>& s : samples)
    for (const Stretch& stretch : stretches_of(s, before, options)) stretches.push_back(stretch);
  if (stretches.size() < 8)
    return Error{"recordings", std::to_string(stretches.size()) + " stretches of travel", "two metres or more"};

  std::vector<int> free = {kDifferenceA, kWheelbaseA, kScaleB, kDifferenceB, kWheelbaseB};
  if (options.fit_link_length) free.push_back(kLength);
  std::vector<int> with_angles = free;
  with_angles.insert(with_angles.end() - (options.fit_link_length ? 1 : 0), {kOffsetA, kOffsetB});
  InternalCalibration result;
  Fit found = fit(stretches, before, options.fit_link_angles ? with_angles : free, progress);
  if (options.fit_link_angles && !(determined(found, kOffsetA) && determined(found, kOffsetB))) {
    found = fit(stretches, before, free, progress);
    result.cannot_tell.push_back(
        "biased rotary encoders from unequal wheels: the link angles' offsets are taken as in the vehicle file; drive "
        "sideways, both trucks at 45 degrees to the link or more, and in line too");
  }
  if (!goes_on(progress, 1.0)) return Error{"calibration", "stopped before its end", ""};
  if (!determined(found, kWheelbaseA) || !determined(found, kWheelbaseB))
    result.cannot_tell.push_back("a wheelbase: drive turns with both trucks");
  if (options.fit_link_length && !determined(found, kLength))
    result.cannot_tell.push_back("the link length's bias: drive turns, a full one or more");

  for (int unknown = 0; unknown < kUnknowns; ++unknown)
    if (!determined(found, unknown)) found.x[unknown] = 0.0;
  for (const Parameter& p : parameters()) result.parameters.push_back(estimate_of(p, before, found));
  const LinkedTrucks after = with(before, found.x);
  result.vehicle = nominal;
  if (Clapper* clapper = std::get_if<Clapper>(&result.vehicle.kind)) static_cast<LinkedTrucks&>(*clapper) = after;
  if (OmniMate* omnimate = std::get_if<OmniMate>(&result.vehicle.kind)) static_cast<LinkedTrucks&>(*omnimate) = after;
  result.taken_as_known = {
      "truck A's mean wheel radius, the scale of all lengths: no encoder inside measures the floor",
      "a smooth floor; stretches over bumps count less"};
  return result;
}

}  // namespace odolab
