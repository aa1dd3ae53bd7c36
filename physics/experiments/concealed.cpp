// The public proof of the diagnosis: physics hidden in recordings of the planar world, drawn from a seed.
#include "core/base/parallel.h"
#include "physics/experiments/concealed/judged.h"
#include "physics/experiments/concealed/report.h"
#include "physics/experiments/experiment.h"

namespace odolab {

namespace {

constexpr int kConcealedCases = 36;

Result<ExperimentReport> run_concealed(const ExperimentOptions& options, const Progress& progress) {
  const int count = options.cases > 0 ? options.cases : kConcealedCases;
  std::vector<concealed::Judged> cases(static_cast<std::size_t>(count));
  const int done = parallel_for(
      count,
      [&](int i, const std::atomic<bool>& stopped) {
        const concealed::DrawnCase drawn = concealed::drawn_case(options.seed, i);
        if (!stopped) cases[static_cast<std::size_t>(i)] = concealed::judged(drawn, [&](double) { return !stopped; });
      },
      {}, progress);
  cases.resize(static_cast<std::size_t>(done));
  return concealed::report_of(cases);
}

}  // namespace

Experiment concealed_physics() {
  return {"concealed", "what diagnosis finds of physics that is hidden in drawn recordings, and what it makes up",
          "ours; physics/experiments/concealed/README.md", run_concealed};
}

}  // namespace odolab
