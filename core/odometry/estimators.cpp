#include "core/odometry/estimators.h"

#include <optional>

#include "core/geometry/angles.h"
#include "core/odometry/cast_rejection.h"
#include "core/odometry/encoder_trailer.h"
#include "core/odometry/ipec.h"
#include "core/odometry/synchro_step.h"

namespace odolab {

namespace {

// Two wheels of one axle, whose readings stand at `left` and behind it.
struct Wheels {
  std::size_t left = 0;
  WheelRotation of(const std::vector<double>& readings) const { return {readings[left], readings[left + 1]}; }
};

class DeadReckoning final : public RunningEstimator {
 public:
  DeadReckoning(const DifferentialDrive& drive, Wheels wheels, HeadingRule rule, const Pose& start)
      : drive_(drive), wheels_(wheels), rule_(rule), pose_(start) {}
  void take(double, const std::vector<double>& readings) override {
    const WheelRotation now = wheels_.of(readings);
    if (last_) pose_ = dead_reckoned(pose_, *last_, now, drive_, rule_);
    last_ = now;
  }
  Pose pose() const override { return pose_; }

 private:
  DifferentialDrive drive_;
  Wheels wheels_;
  HeadingRule rule_;
  Pose pose_;
  std::optional<WheelRotation> last_;
};

class SynchroReckoning final : public RunningEstimator {
 public:
  SynchroReckoning(const SynchroDrive& drive, HeadingRule rule, const Pose& start)
      : drive_(drive), rule_(rule), at_{start, start.heading_rad} {}
  void take(double, const std::vector<double>& readings) override {
    if (!last_.empty()) at_ = dead_reckoned(at_, readings[0] - last_[0], readings[1] - last_[1], drive_, rule_);
    last_ = readings;
  }
  Pose pose() const override { return at_.pose; }

 private:
  SynchroDrive drive_;
  HeadingRule rule_;
  SynchroPose at_;
  std::vector<double> last_;
};

// What the encoders of two trucks and their link say, whichever vehicle they belong to; offsets are taken off.
using LinkedReading = std::function<LinkedSample(double time_s, const std::vector<double>& readings)>;

class Ipec final : public RunningEstimator {
 public:
  Ipec(const IpecTrucks& trucks, LinkedReading read, const IpecOptions& options, const Pose& start)
      : trucks_(trucks), read_(std::move(read)), options_(options) {
    state_.a = start;
  }
  void take(double time_s, const std::vector<double>& readings) override {
    const LinkedSample now = read_(time_s, readings);
    state_ = last_ ? ipec_step(state_, *last_, now, trucks_, options_) : ipec_start(now, state_.a);
    last_ = now;
  }
  Pose pose() const override { return state_.a; }

 private:
  IpecTrucks trucks_;
  LinkedReading read_;
  IpecOptions options_;
  IpecState state_;
  std::optional<LinkedSample> last_;
};

// Truck B's wheels alone, and truck A where the link's readings put it.
class RearTruckReckoning final : public RunningEstimator {
 public:
  RearTruckReckoning(const DifferentialDrive& truck_b, LinkedReading read, const Pose& start)
      : truck_b_(truck_b), read_(std::move(read)), a_(start) {}
  void take(double time_s, const std::vector<double>& readings) override {
    const LinkedSample now = read_(time_s, readings);
    if (!last_) {
      b_ = ipec_start(now, a_).b;
    } else {
      b_ = dead_reckoned(b_, last_->b, now.b, truck_b_);
      const double link_rad = b_.heading_rad - now.link_angle_b_rad;
      a_ = {b_.x_m + now.link_length_m * std::cos(link_rad), b_.y_m + now.link_length_m * std::sin(link_rad),
            unwrapped(link_rad + now.link_angle_a_rad, a_.heading_rad)};
    }
    last_ = now;
  }
  Pose pose() const override { return a_; }

 private:
  DifferentialDrive truck_b_;
  LinkedReading read_;
  Pose a_, b_;
  std::optional<LinkedSample> last_;
};

class TrailerReckoning final : public RunningEstimator {
 public:
  TrailerReckoning(const EncoderTrailer& vehicle, const Pose& start) : vehicle_(vehicle), pose_(start) {}
  void take(double, const std::vector<double>& readings) override {
    const WheelRotation now = Wheels{2}.of(readings);
    hitch_rad_ = last_ ? unwrapped(readings[4], hitch_rad_) : readings[4];
    const Pose to_tow = trailer_T_tow(vehicle_, hitch_rad_);
    if (!last_) {
      trailer_ = pose_ * inverse(to_tow);
    } else {
      trailer_ = dead_reckoned(trailer_, *last_, now, vehicle_.trailer);
    }
    pose_ = trailer_ * to_tow;
    last_ = now;
  }
  Pose pose() const override { return pose_; }

 private:
  EncoderTrailer vehicle_;
  Pose pose_, trailer_;
  double hitch_rad_ = 0.0;
  std::optional<WheelRotation> last_;
};

// Readings of all castors, their pivots unwrapped.
class CastorReadings {
 public:
  const CastorSample& take(double time_s, const std::vector<double>& readings) {
    CastorSample now{time_s, {}};
    for (std::size_t i = 0; 3 * i < readings.size(); ++i) {
      const double pivot_rad =
          last_.castors.empty() ? readings[3 * i + 2] : unwrapped(readings[3 * i + 2], last_.castors[i].pivot_rad);
      now.castors.push_back({Wheels{3 * i}.of(readings), pivot_rad});
    }
    return last_ = now;
  }

 private:
  CastorSample last_;
};

class Castors final : public RunningEstimator {
 public:
  Castors(const MultiCastor& vehicle, const CastOptions& options, const Pose& start)
      : vehicle_(vehicle), options_(options), left_out_(vehicle.castors.size(), 0), body_(start) {
    if (options.left_out > 0) left_out_[static_cast<std::size_t>(options.left_out - 1)] = 1;
  }
  void take(double time_s, const std::vector<double>& readings) override {
    const CastorSample now = readings_.take(time_s, readings);
    if (last_)
      body_ = moved_by_pivots(body_, pivot_ways(vehicle_, *last_, now, body_, options_.heading, left_out_), options_);
    last_ = now;
  }
  Pose pose() const override { return body_; }

 private:
  MultiCastor vehicle_;
  CastOptions options_;
  std::vector<char> left_out_;
  CastorReadings readings_;
  std::optional<CastorSample> last_;
  Pose body_;
};

class Rejecting final : public RunningEstimator {
 public:
  Rejecting(const MultiCastor& vehicle, const Pose& start) : cast_(vehicle, start) {}
  void take(double time_s, const std::vector<double>& readings) override {
    cast_.take(readings_.take(time_s, readings));
  }
  Pose pose() const override { return cast_.body(); }

 private:
  CastorReadings readings_;
  RejectingCast cast_;
};

template <typename Running, typename... Args>
Estimator estimator(std::string name, std::string about, const Args&... args) {
  return {std::move(name), std::move(about), [args...](const Pose& start) -> std::unique_ptr<RunningEstimator> {
            return std::make_unique<Running>(args..., start);
          }};
}

constexpr const char* kLetter =
    "The same with each increment laid down at the heading after it, Eq. 2.6 of the UMBmark report to the letter.";

std::vector<Estimator> of_drive(const DifferentialDrive& drive) {
  return {estimator<DeadReckoning>("dead reckoning", "From the wheels' encoders: UMBmark report, Eqs. 2.1 to 2.6.",
                                   drive, Wheels{0}, HeadingRule::middle),
          estimator<DeadReckoning>("as printed", kLetter, drive, Wheels{0}, HeadingRule::end_as_printed)};
}

std::vector<Estimator> of_two_trucks(const IpecTrucks& trucks, const LinkedReading& read, const char* front,
                                     const char* rear) {
  IpecOptions printed;
  printed.heading = HeadingRule::end_as_printed;
  printed.resolution = ResolutionRule::as_printed;
  printed.composite = CompositeCorrection::as_printed;
  IpecOptions without;
  without.composite = CompositeCorrection::none;
  return {estimator<Ipec>("IPEC", "Two trucks correct each other's heading: CLAPPER paper, Eqs. 9 to 16.", trucks, read,
                          IpecOptions{}),
          estimator<DeadReckoning>(front, "Dead reckoning of the front wheels alone, without any correction.", trucks.a,
                                   Wheels{0}, HeadingRule::middle),
          estimator<RearTruckReckoning>(rear, "Dead reckoning of the rear wheels alone, carried over by the joints.",
                                        trucks.b, read),
          estimator<Ipec>("no composite", "IPEC without the correction of the position, Eqs. 14 and 15.", trucks, read,
                          without),
          estimator<Ipec>("IPEC printed", "IPEC with the paper's rules for heading, resolution and position.", trucks,
                          read, printed)};
}

struct ListOf {
  std::vector<Estimator> operator()(const DifferentialDrive& v) const { return of_drive(v); }
  std::vector<Estimator> operator()(const Tracked& v) const { return of_drive(as_differential_drive(v)); }
  std::vector<Estimator> operator()(const SynchroDrive& v) const {
    return {estimator<SynchroReckoning>("dead reckoning", "From the encoders of the drive and the steering motor.", v,
                                        HeadingRule::middle),
            estimator<SynchroReckoning>("as printed", kLetter, v, HeadingRule::end_as_printed)};
  }
  std::vector<Estimator> operator()(const LinkedTrucks& v) const {
    const LinkedReading read = [v](double time_s, const std::vector<double>& r) {
      return LinkedSample{time_s,
                          Wheels{0}.of(r),
                          Wheels{2}.of(r),
                          r[4] - v.link_angle_a_offset_rad,
                          r[5] - v.link_angle_b_offset_rad,
                          r[6] - v.link_length_offset_m};
    };
    return of_two_trucks({v.truck_a, v.truck_b, v.link_angle_resolution_rad, v.link_angle_resolution_rad}, read,
                         "truck A alone", "truck B, link");
  }
  std::vector<Estimator> operator()(const SmartEncoderTrailer& v) const {
    const LinkedReading read = [v](double time_s, const std::vector<double>& r) {
      return LinkedSample{time_s, Wheels{0}.of(r),   Wheels{2}.of(r), r[4] - v.hitch_angle_offset_rad,
                          0.0,    v.drawbar_length_m};
    };
    return of_two_trucks({v.tow, v.trailer, v.hitch_angle_resolution_rad, 0.0}, read, "towing wheels", "trailer alone");
  }
  std::vector<Estimator> operator()(const EncoderTrailer& v) const {
    return {estimator<TrailerReckoning>(
                "encoder trailer", "The trailer's wheels, carried over by the hitch: UMBmark report, section 4.5.", v),
            estimator<DeadReckoning>("tracks alone", "Dead reckoning of the tracks' sprockets, which slip in turns.",
                                     v.tow, Wheels{0}, HeadingRule::middle)};
  }
  std::vector<Estimator> operator()(const MultiCastor& v) const {
    const int n = static_cast<int>(v.castors.size());
    std::vector<Estimator> list{estimator<Castors>(
        "CAST-0", "Least squares over the ways of all pivots: multi-castor paper, Eqs. 15 to 21.", v, CastOptions{})};
    if (n >= 3)
      list.push_back(estimator<Rejecting>(
          "CAST-reject", "Least squares that finds a castor which slips or climbs, and leaves it out meanwhile.", v));
    for (const CastorMethod method : {CastorMethod::cast, CastorMethod::ipec})
      for (int out = n > 2 ? 1 : 0; out <= (n > 2 ? n : 0); ++out) {
        CastOptions options;
        options.method = method;
        options.left_out = out;
        if (!problem_in(options, v).empty() || (out == 0 && method == CastorMethod::cast)) continue;
        const std::string number = out > 0 ? "-" + std::to_string(out) : "";
        list.push_back(estimator<Castors>(
            (method == CastorMethod::cast ? "CAST" : "IPEC") + number,
            (method == CastorMethod::cast ? "Least squares" : "The direction between two pivots, Eq. 10") +
                (out > 0 ? ", castor " + std::to_string(out) + " left out." : std::string(".")),
            v, options));
      }
    return list;
  }
};

}  // namespace

std::vector<Estimator> estimators_for(const VehicleKind& kind) { return std::visit(ListOf{}, kind); }

std::size_t steering_estimator(const VehicleKind& kind, bool internal_correction) {
  const bool two_trucks = std::holds_alternative<Clapper>(kind) || std::holds_alternative<OmniMate>(kind) ||
                          std::holds_alternative<SmartEncoderTrailer>(kind);
  return two_trucks && !internal_correction ? 1 : 0;
}

std::vector<std::string> encoder_channels(const VehicleKind& kind) {
  std::vector<std::string> names;
  for (const AlignedChannel& encoder : encoders_of(kind)) names.push_back(encoder.name);
  return names;
}

}  // namespace odolab
