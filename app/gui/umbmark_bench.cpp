#include "app/gui/umbmark_bench.h"

#include "core/base/random.h"
#include "physics/benchmark.h"

namespace odolab {

void UmbmarkBench::start(const Scenario& scenario, int runs_each_way, bool keep_things, Jobs& jobs) {
  const DifferentialDrive* vehicle = std::get_if<DifferentialDrive>(&scenario.vehicle.kind);
  if (!vehicle || jobs.running()) return;
  experiments_.clear();
  scenario_ = scenario;
  if (!std::holds_alternative<SquarePath>(scenario_.path)) scenario_.path = SquarePath{};
  scenario_.benchmark = Benchmark{runs_each_way, false};
  if (!keep_things) {
    scenario_.floor.bumps.clear();
    scenario_.floor.slip_zones.clear();
  }
  drive("uncalibrated", *vehicle, jobs);
}

void UmbmarkBench::apply(Jobs& jobs) {
  if (experiments_.empty() || !experiments_.back().calibration || jobs.running()) return;
  const DifferentialDrive corrected = experiments_.back().calibration->corrected;
  drive(experiments_.size() == 1 ? "after calibration" : "after calibration " + std::to_string(experiments_.size()),
        corrected, jobs);
}

const DifferentialDrive* UmbmarkBench::kept_vehicle() const {
  return experiments_.empty() ? nullptr : &experiments_.back().vehicle;
}

void UmbmarkBench::drive(const std::string& name, const DifferentialDrive& vehicle, Jobs& jobs) {
  ui::BenchExperiment experiment;
  experiment.name = name;
  experiment.vehicle = vehicle;
  experiment.runs.side_m = std::get<SquarePath>(scenario_.path).side_m;
  experiments_.push_back(experiment);
  running_ = true;
  Scenario scenario = scenario_;
  scenario.vehicle.kind = vehicle;
  const std::uint64_t seed = seed_of_stream(scenario_.seed, experiments_.size() - 1);  // as run_umbmark_calibration

  const auto work = [this, scenario, seed](const Progress& progress, const Jobs::Deliver& deliver) {
    run_umbmark(
        scenario, seed,
        [this, &deliver](const BenchmarkRun& run) {
          deliver([this, run] {
            ui::BenchExperiment& e = experiments_.back();
            if (!run.finished) {
              e.lost.push_back({run.clockwise, run.number});
              return;
            }
            (run.clockwise ? e.runs.clockwise : e.runs.counter_clockwise).push_back(run.error);
            e.measure = measure_umbmark(e.runs);
          });
        },
        progress);
  };
  const auto finished = [this](bool cancelled) {
    running_ = false;
    ui::BenchExperiment& e = experiments_.back();
    if (cancelled) {
      experiments_.pop_back();
      return;
    }
    if (!e.lost.empty()) return;  // half an experiment calibrates nothing
    e.measure = measure_umbmark(e.runs);
    e.calibration = calibrate_umbmark(e.runs, e.vehicle);
    if (e.calibration) {
      // Eqs. 6.29 and 6.24 the other way: alpha = 90 deg (1 - 1 / Eb); beta = side (Ed - 1) / wheelbase to first order.
      const UmbmarkCalibration& c = *e.calibration;
      e.alpha_stderr_rad = 0.5 * kPi / (c.wheelbase_ratio * c.wheelbase_ratio) * c.wheelbase_ratio_stderr;
      e.beta_stderr_rad = e.runs.side_m / c.corrected.wheelbase_m * c.wheel_diameter_ratio_stderr;
    }
    e.only_clockwise = calibrate_one_direction(e.runs, true, e.vehicle);
    e.only_counter_clockwise = calibrate_one_direction(e.runs, false, e.vehicle);
  };
  if (!jobs.start("driving the squares of UMBmark", work, finished)) {
    experiments_.pop_back();
    running_ = false;
  }
}

}  // namespace odolab
