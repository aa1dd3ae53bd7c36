// How much wider a score scatters than the model says, from its sums over batches of time.
#pragma once

#include <vector>

namespace odolab {

constexpr int kBatches = 60;  // over all runs
constexpr double kFewestBatchesBelieved = 6.0;

// Of one candidate along its fitted direction: the score u of each batch, and its information i.
struct ScoreByBatches {
  std::vector<double> u, i;
  double scatter = 1.0;  // of u about its fit, relative to i, where the innovations are white: 1 in the mean
  double count = 0.0;    // of batches that matter (Kish): (sum i)^2 / sum i^2
  void add(double score, double information) { u.push_back(score), i.push_back(information); }
  // After the last batch. Empties what holds no information.
  void finish();
  // 1 or more: the scatter shrunk to that of white innovations with the weight of so many batches, and at least what
  // the batches say by themselves beyond chance.
  double inflation(double batches_believed_white) const;
  // Gain of chi-square on every other batch, fitted on the rest.
  double cross_validated() const;
};

// From squares about their own fit over so many batches that matter, relative to their information; 1 of one alone.
double unbiased_scatter(double about_fit, double count);

// An inflation of 1 or more from a scatter that so many batches give, and the belief of so many that there is none.
double shrunk_inflation(double scatter, double count, double batches_believed_white);

// How much wider the statistics of all shapes scatter than chi-square of 1 to 3 numbers: by the median or the ninetieth
// hundredth, whichever is further out.
double scatter_of_statistics(const std::vector<double>& statistics, int freedom);

// With the weight of how many batches it is to be believed that innovations are white: as many as there are where
// these scores scatter no more than chance makes them, fewer the more their scatters differ from one (empirical Bayes:
// C. N. Morris, "Parametric empirical Bayes inference", J. American Statistical Association 78(381):47-55, 1983).
double batches_of_prior(const std::vector<ScoreByBatches>& scores);

}  // namespace odolab
