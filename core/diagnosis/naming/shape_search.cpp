#include "core/diagnosis/naming/shape_search.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>

#include "core/diagnosis/model/coarse_counts.h"

namespace odolab {

namespace {

std::vector<std::vector<double>> shapes_near(const Effect& e, const std::vector<double>& shape, double scale) {
  std::vector<std::vector<double>> near;
  for (std::size_t k = 0; k < e.shapes.size(); ++k)
    for (double side : {-1.0, 1.0}) {
      if (!is_estimated(e.shapes[k])) continue;
      std::vector<double> s = shape;
      const std::string& unit = e.shapes[k].unit;
      if (unit == "s" && !e.shape_follows_amplitude)
        s[k] += side * scale * (e.local ? 0.1 : 3.0);
      else if (is_extent(e.shapes[k]))
        s[k] *= 1.0 + side * 0.25 * scale;
      else if (e.shapes[k].name == "direction_rad")
        s[k] += side * scale * 0.3;
      else if (unit == "m")
        s[k] += side * scale * 0.2;
      else
        s[k] *= 1.0 + side * 0.15 * scale;
      near.push_back(s);
    }
  // A place is not found along the axes alone; and of a patch that is crossed on a line both ends are known well, so
  // that it grows as it moves away from one of them.
  for (std::size_t k = 0; k + 1 < e.shapes.size(); ++k)
    if (e.shapes[k].name == "x_m" && e.shapes[k + 1].name == "y_m")
      for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {-1.0, 1.0}, {1.0, -1.0}, {1.0, 1.0}}) {
        std::vector<double> s = shape;
        s[k] += x * scale * 0.15;
        s[k + 1] += y * scale * 0.15;
        near.push_back(s);
        if (k + 2 >= e.shapes.size() || e.shapes[k + 2].name != "radius_m") continue;
        for (const double grown : {-0.2, 0.2}) {
          near.push_back(s);
          near.back()[k + 2] = std::max(0.5 * shape[k + 2], shape[k + 2] + grown * scale);
        }
      }
  return near;
}

// So near each other that what is looked for from one is found from the other.
bool is_one_place(const Effect& e, const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kSmall_m = 0.25;
  const Apart p = apart(e, a, b);
  const double near_m = std::max(kSmall_m, 0.5 * p.radii_m);
  return p.away_m2 < near_m * near_m;
}

// Patches about one, by such a share of its radius, larger and smaller: rims are sharp, so that a climb may come to
// rest beside the summit.
std::vector<std::vector<double>> patches_about(const std::vector<double>& patch, double share) {
  std::vector<std::vector<double>> about;
  for (const double size : {1.0 / (1.0 + 0.8 * share), 1.0, 1.0 + 0.8 * share})
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        if (size == 1.0 && x == 0 && y == 0) continue;
        about.push_back(patch);
        about.back()[0] += share * x * patch[2];
        about.back()[1] += share * y * patch[2];
        about.back()[2] *= size;
      }
  return about;
}

class ShapeSearch {
 public:
  ShapeSearch(const CandidateScan& scan, const Effect& effect, const std::vector<std::vector<double>>& also_from,
              double worth_refining)
      : scan_(scan),
        e_(effect),
        also_from_(also_from),
        worth_refining_(worth_refining),
        forms_(std::max<std::size_t>(1, effect.forms.size())) {}

  SearchedShapes run(const std::vector<DriveView>& views) {
    std::vector<std::vector<double>> shapes;
    if (e_.scan)
      shapes = e_.scan(views);
    else
      shapes.push_back({});
    out_.tried = std::max<std::size_t>(1, shapes.size() * forms_);
    // Few shapes are tried in every form; where there are many, the best one is.
    const bool in_every_form = forms_ > 1 && shapes.size() <= kFew;
    out_.shapes = forms_ > 1 ? with_forms(shapes, in_every_form) : std::move(shapes);
    look_at_all();
    climb_from_given_places();
    if (best().statistic <= 0.0) return std::move(out_);
    // At a place that is only near another form may fit because it is longer.
    if (forms_ > 1 && !in_every_form && places_.empty()) try_other_forms();
    // Refined only where there is something to refine: a place, or a limit of speed, is sharp, and half of what it
    // says, or less, shows beside it.
    if (e_.scan && best().statistic > std::max(kWorthRefining, worth_refining_)) refine();
    return std::move(out_);
  }

 private:
  static constexpr std::size_t kFew = 40;
  static constexpr double kWorthRefining = 7.0, kWorthAnotherStart = 10.0;

  CandidateTest& best() { return out_.best; }

  std::vector<std::vector<double>> with_forms(const std::vector<std::vector<double>>& shapes, bool in_every_form) {
    std::vector<int> forms = e_.forms_of_the_scan;
    if (in_every_form) {
      forms.resize(forms_);
      std::iota(forms.begin(), forms.end(), 0);
    }
    std::vector<std::vector<double>> with;
    for (const int form : forms)
      for (std::vector<double> s : shapes) {
        s.push_back(form);
        with.push_back(std::move(s));
      }
    return with;
  }

  bool take(CandidateTest t, const std::vector<double>& shape) {
    if (t.value.empty() || t.statistic <= best().statistic || !is_physical(scan_.joint(), e_, t.value, shape))
      return false;
    t.shape = shape;
    best() = std::move(t);
    return true;
  }

  bool take_best_of(const std::vector<std::vector<double>>& shapes) {
    bool moved = false;
    const std::vector<CandidateTest> tests = scan_.tests(e_, shapes);
    for (std::size_t k = 0; k < shapes.size(); ++k) moved = take(tests[k], shapes[k]) || moved;
    return moved;
  }

  void look_at_all() {
    const std::vector<CandidateTest> tests = scan_.tests(e_, out_.shapes);
    const bool is_a_place = e_.local && e_.scan && e_.shapes.size() >= 2 && !e_.of_one_recording;
    for (std::size_t k = 0; k < out_.shapes.size(); ++k) {
      const CandidateTest& t = tests[k];
      take(t, out_.shapes[k]);
      if (t.freedom == 0 || t.survives <= 0.0) continue;
      out_.statistics.push_back(t.statistic);
      out_.of_shape.push_back(k);
      if (is_a_place) places_.emplace_back(-t.statistic, k);
    }
  }

  void try_other_forms() {
    for (std::size_t form = 0; form < forms_; ++form) {
      std::vector<double> s = best().shape;
      s.back() = static_cast<double>(form);
      take(scan_.test(e_, s), s);
    }
  }

  void climb(std::initializer_list<double> scales = {1.0, 0.5, 0.25, 0.12, 0.06}) {
    for (double scale : scales)
      for (int round = 0; round < 4; ++round)
        if (!take_best_of(shapes_near(e_, best().shape, scale))) break;
  }

  // Goes on in small steps only where that may still come to more than a summit that is known.
  bool climbs_towards(double summit) {
    constexpr double kHopeless = 0.5;
    climb({1.0, 0.5});
    if (best().statistic < kHopeless * summit) return false;
    climb({0.25, 0.12, 0.06});
    return true;
  }

  void refine() {
    const std::vector<double> begun = best().shape;
    climb();
    if (forms_ > 1 && !places_.empty()) try_other_forms(), climb(), climb_in_each_form(begun);
    climb_from_other_places();
    if (is_a_patch(e_) && best().statistic > kWorthAnotherStart)
      for (const double share : {0.5, 0.15}) climb_from_patches_about(share);
    if (forms_ > 1) try_other_forms();
  }

  // What is climbed otherwise is met elsewhere.
  void climb_in_each_form(const std::vector<double>& begun) {
    const CandidateTest top = best();
    CandidateTest summit = top;
    for (std::size_t form = 0; form < forms_; ++form) {
      std::vector<double> start = begun;
      start.back() = static_cast<double>(form);
      best().statistic = 0.0;
      if (take(scan_.test(e_, start), start)) climbs_towards(summit.statistic);
      if (best().statistic > summit.statistic) summit = best();
    }
    best() = summit;
  }

  void climb_from_given_places() {
    for (std::vector<double> start : also_from_) {
      if (e_.shapes_about) {
        climb_from_best_of(with_forms(e_.shapes_about({start[0], start[1]}), false));
        continue;
      }
      if (forms_ > 1) start.push_back(0.0);
      climb_in_each_form(start);
    }
  }

  void climb_from_best_of(const std::vector<std::vector<double>>& starts) {
    const CandidateTest top = best();
    best().statistic = 0.0;
    if (take_best_of(starts) && climbs_towards(top.statistic)) try_other_forms(), climb();
    if (best().statistic <= top.statistic) best() = top;
  }

  // A place is looked for from several starts.
  void climb_from_other_places() {
    constexpr std::size_t kStarts = 4;
    constexpr double kWorthAStart = 0.5;  // of the best place that was scanned
    std::sort(places_.begin(), places_.end());
    std::vector<std::size_t> starts;
    for (const auto& [minus_statistic, k] : places_) {
      if (starts.size() >= kStarts || -minus_statistic < kWorthAnotherStart ||
          minus_statistic > kWorthAStart * places_.front().first)
        break;
      const auto is_one_with = [&, k = k](std::size_t other) {
        return is_one_place(e_, out_.shapes[k], out_.shapes[other]);
      };
      if (std::none_of(starts.begin(), starts.end(), is_one_with)) starts.push_back(k);
    }
    for (std::size_t n = 1; n < starts.size(); ++n)  // the first is where it began
      climb_from(out_.shapes[starts[n]]);
  }

  void climb_from_patches_about(double share) {
    constexpr std::size_t kStarts = 4;
    std::vector<std::vector<double>> about;
    for (std::size_t form = 0; form < forms_; ++form)
      for (std::vector<double>& patch : patches_about(best().shape, share)) {
        if (forms_ > 1) patch.back() = static_cast<double>(form);
        about.push_back(std::move(patch));
      }
    const std::vector<CandidateTest> tests = scan_.tests(e_, about);
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < about.size(); ++k)
      if (!tests[k].value.empty() && is_physical(scan_.joint(), e_, tests[k].value, about[k])) order.push_back(k);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return tests[a].statistic > tests[b].statistic; });
    if (order.size() > kStarts) order.resize(kStarts);
    const CandidateTest top = best();
    CandidateTest summit = top;
    for (const std::size_t k : order) {
      best().statistic = 0.0;
      if (take(tests[k], about[k])) climb({0.5, 0.25});
      if (best().statistic > summit.statistic) summit = best();
    }
    best() = summit;
    if (summit.statistic > top.statistic) climb({0.12, 0.06});
  }

  void climb_from(const std::vector<double>& start) {
    const CandidateTest top = best();
    best().statistic = 0.0;
    if (take(scan_.test(e_, start), start) && climbs_towards(top.statistic) && forms_ > 1) try_other_forms(), climb();
    if (best().statistic <= top.statistic) best() = top;
  }

  const CandidateScan& scan_;
  const Effect& e_;
  const std::vector<std::vector<double>>& also_from_;
  double worth_refining_;
  std::size_t forms_;
  SearchedShapes out_;
  std::vector<std::pair<double, std::size_t>> places_;  // minus the statistic, shape
};

}  // namespace

bool is_a_patch(const Effect& e) { return e.local && e.shapes.size() > 2 && e.shapes[2].name == "radius_m"; }

bool is_physical(const JointModel& joint, const Effect& e, const std::vector<double>& value,
                 const std::vector<double>& shape) {
  for (std::size_t k = 0; k < value.size(); ++k)
    if (value[k] < e.amplitudes[k].low || value[k] > e.amplitudes[k].high) return false;
  return !e.form_goes_with || e.form_goes_with(value, shape, largest_count_rad(joint), joint.views());
}

CandidateTest tested_in_form(const JointModel& joint, std::size_t accepted, std::size_t form) {
  const AcceptedEffect& a = joint.accepted[accepted];
  std::vector<double> shape = a.shape;
  shape.back() = static_cast<double>(form);
  const auto test = [&] { return joint.test(joint.columns_of(*a.effect, shape), static_cast<int>(accepted)); };
  CandidateTest t = test();
  if (a.effect->shape_follows_amplitude) {
    constexpr int kMostRounds = 8;
    constexpr double kSettled = 0.01;
    for (int round = 0; round < kMostRounds && !t.value.empty(); ++round) {
      const double by = t.value[0] - shape[0];
      if (std::abs(by) < kSettled * std::max(shape[0], 1e-3)) break;
      shape[0] = std::max(shape[0] + 0.5 * by, 1e-4);
      t = test();
    }
  }
  t.shape = shape;
  return t;
}

Apart apart(const Effect& e, const std::vector<double>& a, const std::vector<double>& b) {
  Apart p;
  for (std::size_t k = 0; k < e.shapes.size(); ++k) {
    if (is_extent(e.shapes[k]))
      p.radii_m = e.shapes[k].name == "radius_m" ? a[k] + b[k] : 0.5 * (a[k] + b[k]);
    else if (e.shapes[k].unit == "m")
      p.away_m2 += (a[k] - b[k]) * (a[k] - b[k]);
  }
  return p;
}

SearchedShapes best_shape(const std::vector<DriveView>& views, const CandidateScan& scan, const Effect& effect,
                          const std::vector<std::vector<double>>& also_from, double worth_refining) {
  return ShapeSearch(scan, effect, also_from, worth_refining).run(views);
}

}  // namespace odolab
