#include "core/diagnosis/parted.h"

#include <algorithm>
#include <tuple>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/diagnosis/model/ready_run.h"

namespace odolab {

namespace {

constexpr double kAtOnce_s = 1.0;  // from where the filter starts anew to the next contradiction

struct ComeApart {
  double from_s = 0.0, to_s = 0.0;  // on the wheels' clock
  int times = 0;                    // that the filter started anew
};

std::vector<ComeApart> apart_in(const InnovationRun& run, const InnovationModel& calibrated) {
  const auto wheels_s = [&](int sample) {
    return run.truth[static_cast<std::size_t>(sample)].time_s - calibrated.truth.time_offset_s;
  };
  const int last_sample = static_cast<int>(run.truth.size()) - 1;
  std::vector<ComeApart> found;
  for (const auto& [first, last] : contradictions(run, summed_up(run, calibrated), calibrated)) {
    // From the last sample that agreed to the first that does so again.
    const double from_s = wheels_s(std::max(first - 1, 0)), to_s = wheels_s(std::min(last + 1, last_sample));
    if (!found.empty() && from_s - found.back().to_s < kAtOnce_s) {
      found.back().to_s = to_s;
      ++found.back().times;
    } else {
      found.push_back({from_s, to_s, 1});
    }
  }
  return found;
}

// `first`: the number of the first of them among all recordings.
std::vector<TimeStretches> parted_in(const std::vector<CheckedRecording>& recordings, std::size_t first,
                                     const ReadyRecordings& ready, const Vehicle& nominal) {
  constexpr int kAgain = 2;               // times in one stretch
  constexpr std::size_t kMostPlaces = 3;  // in all these recordings
  constexpr double kMostOfTheTime = 0.2;  // of a recording
  std::vector<std::vector<ComeApart>> apart(recordings.size());
  std::vector<double> lasts_s(recordings.size(), 0.0);
  parallel_for(static_cast<int>(recordings.size()), [&](int i) {
    const auto r = static_cast<std::size_t>(i);
    const std::optional<KnownRun> known = known_run(ready, recordings[r], first + r, nominal);
    if (!known || known->run.truth.size() < 2) return;
    apart[r] = apart_in(known->run, known->model);
    for (ComeApart& a : apart[r]) std::tie(a.from_s, a.to_s) = known->as_stamped({{a.from_s, a.to_s}}).front();
    lasts_s[r] = known->run.truth.back().time_s - known->run.truth.front().time_s;
  });
  const std::vector<TimeStretches> none(recordings.size());
  std::vector<TimeStretches> parted = none;
  std::size_t places = 0;
  for (std::size_t r = 0; r < apart.size(); ++r) {
    places += apart[r].size();
    double sum_s = 0.0;
    for (const ComeApart& a : apart[r]) {
      sum_s += a.to_s - a.from_s;
      if (a.times >= kAgain) parted[r].emplace_back(a.from_s, a.to_s);
    }
    if (sum_s > kMostOfTheTime * lasts_s[r]) return none;
  }
  return places <= kMostPlaces ? parted : none;
}

}  // namespace

Incidents parted_stretches(const ReadyRecordings& ready, const Vehicle& nominal) {
  std::vector<TimeStretches> all = parted_in(ready.train, 0, ready, nominal);
  const std::vector<TimeStretches> unseen = parted_in(ready.held_out, ready.train.size(), ready, nominal);
  all.insert(all.end(), unseen.begin(), unseen.end());
  if (std::all_of(all.begin(), all.end(), [](const TimeStretches& of) { return of.empty(); })) return {};
  return {std::move(all),
          "the truth and the wheels part, and go on together from where it left them, as where a vehicle is lifted, "
          "carried or dragged, or a tracker takes something else for it"};
}

Incidents incidents_of(const Unnamed& unnamed, std::size_t recordings) {
  if (unnamed.incidents.empty()) return {};
  Incidents incidents{unnamed.incidents, unnamed.where.regime, unnamed.gain, unnamed.p_value};
  incidents.of_each.resize(recordings);
  return incidents;
}

void add_parted(Diagnosis& d, const Incidents& incidents, const ReadyRecordings& ready) {
  const std::string what = incidents.what + "; left out of all else";
  std::vector<Finding> findings;
  for (std::size_t r = 0; r < incidents.of_each.size(); ++r) {
    const TimeStretches& times = incidents.of_each[r];
    if (times.empty()) continue;
    if (r >= ready.train.size()) {
      d.warnings.push_back(ready.held_out[r - ready.train.size()].recording.name +
                           formatted(": from %.1f to %.1f s ", times.front().first, times.front().second) + what);
      continue;
    }
    Finding f;
    f.effect = "unknown";
    f.is_parted = true;
    f.component = "vehicle";
    f.where.recording = ready.train[r].recording.name;
    f.where.time_s = times;
    f.where.regime = "there " + what;
    f.sentence = "something that no entry of the catalogue describes: " + f.where.regime;
    f.log_likelihood_gain = 0.5 * incidents.gain;
    f.p_value = incidents.p_value;
    findings.push_back(std::move(f));
  }
  if (findings.empty()) return;
  d.findings.insert(d.findings.begin(), findings.begin(), findings.end());
  d.verdict = Verdict::unknown_effect;
}

}  // namespace odolab
