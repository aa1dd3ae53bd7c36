// What may be missing on a unit of a vehicle, or on all of them alike, each at the shape at which it says most.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/diagnosis/units/together/joined_model.h"

namespace odolab {

// An entry of the catalogue on one unit, or on all of them.
struct JoinedCandidate {
  const Effect* effect = nullptr;
  std::vector<std::size_t> units;
  std::string component;  // in the vehicle's words
};

struct ScoredTogether {
  JoinedCandidate candidate;
  std::vector<double> shape;
  std::shared_ptr<const JoinedColumns> columns;  // null: it acts nowhere
  JoinedTest test;
  double log_tests = 0.0;        // logarithm of the shapes that it was chosen from
  double p_value = 1.0;          // over these and all candidates
  double of_moments = 0.0;       // above 0: it happens at one, and its inflation is that of all moments
  double least_inflation = 1.0;  // by what the same would say from other times on, in other recordings

  // For the choice between names: what was looked for in more places, or has more numbers, must say more.
  double says() const { return test.judged() - 2.0 * test.freedom - 2.0 * log_tests; }
  // Takes another shape where that says more.
  void take_if_better(const JoinedTest& other, const std::vector<double>& at, JoinedColumns of);
  // p_value, where so many candidates were looked at.
  void judge_among(std::size_t looked_at);
};

// Twice what the likelihood of all gains by what is said, at least. Castors on one rigid frame drag each other along as
// nothing else does that is joined: a smaller gain is the trace of that.
double least_said(const Vehicle& vehicle);

// What lasts and patches of floor, of each unit; and of all of them what a whole vehicle does.
std::vector<JoinedCandidate> joined_candidates(const JoinedModel& model);

std::vector<std::vector<double>> shapes_of(const Effect& effect, const std::vector<DriveView>& views);
JoinedModel::MotionsOf motions_at(const JoinedModel& model, const JoinedCandidate& candidate,
                                  const std::vector<double>& shape);
JoinedColumns columns_at(const JoinedModel& model, const JoinedCandidate& candidate, const std::vector<double>& shape);
// At each shape, side by side.
JoinedColumns columns_at(const JoinedModel& model, const JoinedCandidate& candidate,
                         const std::vector<std::vector<double>>& shapes);

// At the shape that says most; of many, every so many-th first, and then those beside the best. A patch of floor is
// sought at `places` besides: on a wide floor those of its own grid lie far apart.
ScoredTogether at_its_best(const JoinedModel& model, const JoinedCandidate& candidate, double believed_white,
                           const std::vector<Vec2>& places);

}  // namespace odolab
