// What readings say of what was before them: the filter's score, carried back along the way.
#include "core/diagnosis/units/together/joined_filter.h"

namespace odolab {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Track> JoinedFilter::smoothed() const {
  std::vector<Track> tracks(units(), Track(readings()));
  VectorXd score = VectorXd::Zero(states());
  for (std::size_t r = readings(); r-- > 0;) {
    const Step& step = steps_[r];
    take_in(r, residual_, score);
    const VectorXd off = step.uncertain * score;
    for (std::size_t u = 0; u < units(); ++u) {
      const Index k = 3 * static_cast<Index>(u);
      const Pose& predicted = step.predicted[u];
      tracks[u][r] = {readings_[r].time_s,
                      {predicted.x_m + off[k], predicted.y_m + off[k + 1], predicted.heading_rad + off[k + 2]}};
    }
    if (r > 0) carry_back(r, score);
  }
  return tracks;
}

void JoinedFilter::take_in(std::size_t reading, const VectorXd& left, VectorXd& score) const {
  const Step& step = steps_[reading];
  if (step.starts && reading > 0) {  // what went before is known by the first unit alone
    score.segment(3, rows() - 3).setZero();
  } else if (step.count > 0) {
    score = step.out.transpose() * left.segment(static_cast<Index>(reading) * rows() + step.first_row, step.count) +
            step.on.transpose() * score;
  }
}

// Back over the way: a heading before swings what follows.
void JoinedFilter::carry_back(std::size_t reading, VectorXd& score) const {
  for (std::size_t u = 0; u < units(); ++u) {
    const Index k = 3 * static_cast<Index>(u);
    const Vec2 ahead = steps_[reading].predicted[u].position() - steps_[reading - 1].corrected[u].position();
    score[k + 2] += -ahead.y_m * score[k] + ahead.x_m * score[k + 1];
  }
  if (wanders_) score.tail(3) *= kept_of_frame(reading);
}

std::vector<JoinedFilter::Impact> JoinedFilter::impacts(const VectorXd& left) const {
  const Index n = rows();
  std::vector<Impact> all(readings() - 1);
  VectorXd score = VectorXd::Zero(states());
  MatrixXd information = MatrixXd::Zero(states(), states());
  for (std::size_t r = readings() - 1; r > 0; --r) {
    const Step& step = steps_[r];
    take_in(r, left, score);
    if (step.starts) {
      information.middleCols(3, n - 3).setZero();
      information.middleRows(3, n - 3).setZero();
    } else if (step.count > 0) {
      information = step.out.transpose() * step.out + step.on.transpose() * information * step.on;
    }
    Impact& here = all[r - 1];
    here.time_s = 0.5 * (readings_[r - 1].time_s + readings_[r].time_s);
    here.units = step.predicted;
    here.score = score;
    here.information = information;
    carry_back(r, score);
    for (std::size_t u = 0; u < units(); ++u) {
      const auto k = 3 * static_cast<Index>(u);
      const Vec2 ahead = step.predicted[u].position() - steps_[r - 1].corrected[u].position();
      information.col(k + 2) += -ahead.y_m * information.col(k) + ahead.x_m * information.col(k + 1);
    }
    for (std::size_t u = 0; u < units(); ++u) {
      const auto k = 3 * static_cast<Index>(u);
      const Vec2 ahead = step.predicted[u].position() - steps_[r - 1].corrected[u].position();
      information.row(k + 2) += -ahead.y_m * information.row(k) + ahead.x_m * information.row(k + 1);
    }
    if (wanders_) {
      const double kept = kept_of_frame(r);
      information.bottomRows(3) *= kept;
      information.rightCols(3) *= kept;
    }
  }
  return all;
}

}  // namespace odolab
