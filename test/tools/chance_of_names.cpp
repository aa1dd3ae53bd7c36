// Whether names count their tries rightly: drawn cases with nothing missing, and how often chance made each entry of
// the catalogue, by itself, as likely as one in ten and as three in ten. More often than so is too few tries counted.
//
//   chance_of_names SEED FIRST LAST
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "core/base/parallel.h"
#include "core/diagnosis/naming/scored_candidates.h"
#include "core/diagnosis/ready_recordings.h"
#include "physics/experiments/concealed/drawn_case.h"

using namespace odolab;
using namespace odolab::concealed;

namespace {

constexpr std::array<double, 2> kChances = {0.1, 0.3};

struct Entry {
  int asked = 0;
  std::array<int, kChances.size()> below{};
};

std::map<std::string, Entry> entries_of(const DrawnCase& drawn) {
  std::vector<Recording> given;
  for (const Run& run : drawn.given) given.push_back(run.driven.recording);
  const Vehicle& nominal = drawn.robot.scenario.vehicle;
  const Result<ReadyRecordings> ready = ready_recordings(given, {}, nominal, {});
  if (!ready) return {};
  const Result<JointModel> joint = calibrated_model(*ready, nominal);
  if (!joint) return {};
  const CandidateScan scan(*joint, JointModel::kNone);
  std::map<std::string, Entry> entries;
  for (const Effect& e : catalogue()) {
    if (e.only_commands) continue;
    const ScoredCandidate c = scored_candidate(*joint, scan, e, {});
    Entry& entry = entries[e.name + ", " + e.component + ", " + e.regime];
    ++entry.asked;
    for (std::size_t k = 0; k < kChances.size(); ++k) entry.below[k] += c.beyond_counts && c.p_value < kChances[k];
  }
  return entries;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "chance_of_names SEED FIRST LAST\n");
    return 2;
  }
  const auto seed = static_cast<std::uint64_t>(std::atoll(argv[1]));
  const int first = std::atoi(argv[2]), last = std::atoi(argv[3]);
  std::vector<std::map<std::string, Entry>> of_case(static_cast<std::size_t>(last - first));
  Wish wish;
  wish.kind = Kind::nothing;
  parallel_for(last - first,
               [&](int i) { of_case[static_cast<std::size_t>(i)] = entries_of(drawn_case(seed, first + i, wish)); });
  std::map<std::string, Entry> sum;
  for (const auto& one : of_case)
    for (const auto& [name, entry] : one) {
      sum[name].asked += entry.asked;
      for (std::size_t k = 0; k < kChances.size(); ++k) sum[name].below[k] += entry.below[k];
    }
  std::printf("%-86s %6s %8s %8s\n", "entry", "asked", "p < 0.1", "p < 0.3");
  for (const auto& [name, entry] : sum)
    std::printf("%-86s %6d %7.1f%% %7.1f%%\n", name.c_str(), entry.asked, 100.0 * entry.below[0] / entry.asked,
                100.0 * entry.below[1] / entry.asked);
  return 0;
}
