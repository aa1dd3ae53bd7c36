// The clock of encoders or commands runs fast (positive) or slow against the clock of the truth.
#include <map>
#include <mutex>

#include "core/diagnosis/effects/effect.h"

namespace odolab::effects {

namespace {

Effect clocks_run_apart() {
  Effect e;
  e.name = "clock_rate";
  e.component = "vehicle";
  e.sentence = "the vehicle's clock and the truth's run at different rates";
  e.regime = "grows with the time since the start";
  e.looks_like = {"truth_time_offset", "traction_slip"};
  e.told_apart_by = "starts and stops early and late in a long run";
  e.clock_rate = true;
  e.motions = [](const DriveView& view, const std::vector<double>&) {
    return motions_by_number(Motions(view.steps.size()));
  };
  return e;
}

const Effect::Amplitude kRate = {"rate", "1", 5e-4, -0.05, 0.05};

Effect in_each_run(int runs) {
  Effect e = clocks_run_apart();
  e.sentence += ", in each recording at one of its own";
  e.of_each_recording = true;
  e.amplitudes.assign(static_cast<std::size_t>(runs), kRate);
  // Their mean first, which is what one number can say.
  e.to_parameters = [](const std::vector<double>& v, const std::vector<double>&) {
    std::vector<FoundParameter> out{{"rate", 0.0, 0.0, "1"}};
    for (std::size_t r = 0; r < v.size(); ++r) {
      out[0].value += v[r] / static_cast<double>(v.size());
      out.push_back({"rate_" + std::to_string(r + 1), v[r], 0.0, "1"});
    }
    return out;
  };
  return e;
}

}  // namespace

const std::vector<Effect>& clock_rate_of_each_run(int runs) {
  static std::map<int, std::vector<Effect>> known;
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  std::vector<Effect>& of = known[runs];
  if (of.empty()) of = {in_each_run(runs)};
  return of;
}

std::vector<Effect> clock_rate() {
  Effect e = clocks_run_apart();
  e.amplitudes = {kRate};
  return {e};
}

}  // namespace odolab::effects
