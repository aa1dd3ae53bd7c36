#include "core/diagnosis/units/diagnose_units.h"

#include <algorithm>

#include "core/calibration/evened_recording.h"
#include "core/diagnosis/units/beside_truth.h"
#include "core/diagnosis/units/inside.h"
#include "core/diagnosis/units/outside_truth.h"

namespace odolab {

namespace {

std::optional<Error> unusable(const Recording& r, const Vehicle& nominal) {
  const std::string where = r.name.empty() ? "recording" : r.name;
  if (const std::vector<std::string> problems = problems_in(r); !problems.empty())
    return Error{where, "", problems.front()};
  if (std::optional<Error> lacks = lacks_encoders(r, nominal)) return lacks;
  if (unit_samples(r, nominal).size() < 2) return Error{where, "no two rows in which all encoders can be told", ""};
  return std::nullopt;
}

// Stamps of arrival put back onto their even period, of all encoders alike.
std::vector<Recording> all_evened(const std::vector<Recording>& given, const Vehicle& nominal,
                                  std::vector<std::string>& said) {
  std::vector<Recording> all = given;
  const std::vector<std::string> encoders = encoder_columns(nominal);
  for (Recording& r : all) {
    if (encoders.empty()) break;
    std::optional<EvenedRecording> even = evened(r, encoders);
    if (!even) continue;
    said.insert(said.end(), even->said.begin(), even->said.end());
    r = std::move(even->recording);
  }
  return all;
}

// By the truth, where it comes often and has headings; else by each other, if there is another.
Result<Diagnosis> diagnose_even(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress) {
  const OutsideTruth truth = outside_truth(train, held_out);
  if (truth == OutsideTruth::poses) return diagnose_beside_truth(train, held_out, nominal, options, progress);
  const bool is_alone = units_of(nominal).size() == 1;
  const bool is_trailer = is_alone && !units_of(nominal)[0].carries_truth;
  if (!is_alone || (is_trailer && truth == OutsideTruth::positions))
    return diagnose_inside(train, held_out, nominal, truth, options, progress);
  if (is_trailer && truth == OutsideTruth::nothing)
    return Error{train.front().name, "no truth",
                 "one, of both ends of each run at least: the towing vehicle's own wheels are no measure of its way"};
  return diagnose_beside_truth(train, held_out, nominal, options, progress);
}

}  // namespace

Result<Diagnosis> diagnose_units(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                 const Vehicle& nominal, const DiagnosisOptions& options, const Progress& progress) {
  if (const std::vector<std::string> problems = problems_in(nominal.kind); !problems.empty())
    return Error{nominal.name, "", problems.front()};
  if (train.empty()) return Error{"recordings", "none", "one or more"};
  for (const std::vector<Recording>* set : {&train, &held_out})
    for (const Recording& r : *set)
      if (const std::optional<Error> problem = unusable(r, nominal)) return *problem;
  std::vector<std::string> said;
  const std::vector<Recording> even = all_evened(train, nominal, said),
                               even_held_out = all_evened(held_out, nominal, said);
  Result<Diagnosis> d = diagnose_even(even, even_held_out, nominal, options, progress);
  if (d) d->warnings.insert(d->warnings.end(), said.begin(), said.end());
  return d;
}

}  // namespace odolab
