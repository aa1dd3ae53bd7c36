#include "core/diagnosis/generic/tracked_point.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "core/base/parallel.h"
#include "core/diagnosis/generic/truth_off.h"
#include "core/geometry/heading_range.h"

namespace odolab {

namespace {

// Ahead, to the left and in heading, to one side or the other of a mount with play: which one, the body's turns say,
// each beginning anew. A wheel's tremble on a straight turns no mount round.
constexpr std::size_t kOfLooseMount = 3;
std::vector<Motions> of_loose_mount(const DriveView& view, const std::vector<double>&) {
  constexpr double kHalfWay_rad = 0.05;
  std::vector<Motions> out(kOfLooseMount, Motions(view.steps.size()));
  double turned_rad = 0.0, before = 0.0;
  for (std::size_t i = 0; i < view.steps.size(); ++i) {
    const EffectStep& s = view.steps[i];
    turned_rad = std::clamp(turned_rad + s.turn_rad, -kHalfWay_rad, kHalfWay_rad);
    const double side = turned_rad / kHalfWay_rad;
    out[0][i].forward_m = out[1][i].sideways_m = out[2][i].turn_rad = side - before;
    // The offset turns with the body; and a body whose heading is measured turned goes to the other side of that.
    out[0][i].sideways_m = before * s.turn_rad;
    out[1][i].forward_m = -before * s.turn_rad;
    out[2][i].sideways_m = -side * s.forward_m();
    before = side;
  }
  return out;
}

// Once and twice a turn. Once a turn the same way round is where the point is mounted.
constexpr std::size_t kOfPosition = 6, kOfHeading = 4;

void position_by_heading(int, const EffectStep& step, std::vector<TruthOff>& out) {
  const double c = std::cos(step.heading_rad), s = std::sin(step.heading_rad), cc = std::cos(2.0 * step.heading_rad),
               ss = std::sin(2.0 * step.heading_rad);
  const Vec2 by[kOfPosition] = {{c, -s}, {s, c}, {cc, 0.0}, {ss, 0.0}, {0.0, cc}, {0.0, ss}};
  for (std::size_t k = 0; k < kOfPosition; ++k) out[k].by = by[k];
}

void heading_by_heading(int, const EffectStep& step, std::vector<TruthOff>& out) {
  for (std::size_t k = 0; k < kOfHeading; ++k) {
    const double turns = k < 2 ? 1.0 : 2.0;
    out[k].turned_rad = k % 2 == 0 ? std::cos(turns * step.heading_rad) : std::sin(turns * step.heading_rad);
  }
}

// What has several faces: cubes of tags, prisms of a total station.
constexpr double kFaces[] = {3.0, 4.0, 6.0};
constexpr std::size_t kOfFaces = 4 * std::size(kFaces);

void position_by_faces(int, const EffectStep& step, std::vector<TruthOff>& out) {
  std::size_t k = 0;
  for (const double faces : kFaces) {
    const double c = std::cos(faces * step.heading_rad), s = std::sin(faces * step.heading_rad);
    for (const Vec2 by : {Vec2{c, 0.0}, Vec2{s, 0.0}, Vec2{0.0, c}, Vec2{0.0, s}}) out[k++].by = by;
  }
}

// Who hardly turns tells where the point sits by nothing but the rounding of counts and the noise.
bool turns(const DriveView& view) {
  constexpr double kLeast_rad = 0.3;
  return heading_range_rad(view.steps) > kLeast_rad;
}

// Where it sits, ahead and to the left, in each recording that turns but the first of these; or how it is turned, in
// each but the first. Each by itself: a frame that turns slowly within its error says nothing of places.
class MountingByRecording {
 public:
  enum class Part { place, heading };
  MountingByRecording(const std::vector<DriveView>& views, Part part) : part_(part) {
    bool has_any = false;
    for (const DriveView& view : views) {
      if (part == Part::place && !turns(view)) continue;
      if (std::exchange(has_any, true))
        first_[view.number] = std::exchange(count_, count_ + (part == Part::place ? 2 : 1));
    }
  }
  std::size_t count() const { return count_; }
  void operator()(int recording, const EffectStep& step, std::vector<TruthOff>& out) const {
    std::fill(out.begin(), out.end(), TruthOff{});
    const auto at = first_.find(recording);
    if (at == first_.end()) return;
    const double c = std::cos(step.heading_rad), s = std::sin(step.heading_rad);
    if (part_ == Part::heading)
      out[at->second].turned_rad = 1.0;
    else
      out[at->second].by = {c, s}, out[at->second + 1].by = {-s, c};
  }

 private:
  Part part_;
  std::map<int, std::size_t> first_;  // of its columns, by the recording's number
  std::size_t count_ = 0;
};

GenericCurve curve_of(const char* channel, const TruthOffsets& offsets, std::size_t count,
                      const std::function<double(const TruthOff&)>& part) {
  constexpr int kPoints = 49;
  GenericCurve curve;
  curve.variable = "heading [rad]";
  curve.channel = channel;
  std::vector<TruthOff> off(count);
  for (int i = 0; i < kPoints; ++i) {
    curve.at.push_back(kPi * (2.0 * i / (kPoints - 1) - 1.0));
    EffectStep step;
    step.heading_rad = curve.at.back();
    offsets(0, step, off);
    std::vector<double>& by = curve.basis.emplace_back();
    for (const TruthOff& o : off) by.push_back(part(o));
  }
  return curve;
}

}  // namespace

std::vector<GenericTest> tracked_point_tests(const AskedModel& asked, double looked_at) {
  struct Asked {
    const char *variable, *channel;
    std::size_t amplitudes;
    MotionsOfTerm motions;
    std::vector<GenericCurve> curves;
  };
  const auto by = [](const TruthOffsets& offsets, std::size_t count) -> MotionsOfTerm {
    return
        [=](const DriveView& view, const std::vector<double>&) { return motions_of_truth_off(view, offsets, count); };
  };
  // On a straight the heading is the noise of its own truth, to which a term by heading answers.
  const auto where_it_turns = [](MotionsOfTerm motions, std::size_t count) -> MotionsOfTerm {
    return [=](const DriveView& view, const std::vector<double>& shape) {
      return turns(view) ? motions(view, shape) : std::vector<Motions>(count);
    };
  };
  const auto of_position = [&](const char* variable, const TruthOffsets& offsets, std::size_t count) -> Asked {
    return {variable,
            "truth's position",
            count,
            where_it_turns(by(offsets, count), count),
            {curve_of("truth off along x [m]", offsets, count, [](const TruthOff& o) { return o.by.x_m; }),
             curve_of("truth off along y [m]", offsets, count, [](const TruthOff& o) { return o.by.y_m; })}};
  };
  std::vector<Asked> all = {of_position("heading", position_by_heading, kOfPosition),
                            of_position("heading, three, four and six times a turn", position_by_faces, kOfFaces),
                            {"heading",
                             "truth's heading",
                             kOfHeading,
                             where_it_turns(by(heading_by_heading, kOfHeading), kOfHeading),
                             {curve_of("truth's heading, off to the left [rad]", heading_by_heading, kOfHeading,
                                       [](const TruthOff& o) { return o.turned_rad; })}},
                            {"which way it turned last",
                             "truth's tracked point, as of a loose mount",
                             kOfLooseMount,
                             where_it_turns(of_loose_mount, kOfLooseMount),
                             {}}};
  for (const auto part : {MountingByRecording::Part::place, MountingByRecording::Part::heading})
    if (const MountingByRecording mounting(asked.joint.views(), part); mounting.count() > 0)
      all.push_back(
          {"recording",
           part == MountingByRecording::Part::place ? "truth's tracked point" : "truth's heading by its mount",
           mounting.count(),
           by(mounting, mounting.count()),
           {}});
  std::vector<GenericTest> tests(all.size());
  parallel_for(static_cast<int>(all.size()), [&](int i) {
    const auto& [variable, channel, amplitudes, motions, curves] = all[static_cast<std::size_t>(i)];
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    t = asked_of(asked, variable, channel, amplitudes, motions, looked_at);
    t.component = "truth";
    t.curves = curves;
  });
  return tests;
}

}  // namespace odolab
