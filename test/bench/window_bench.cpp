// What a picture of Diagnose costs the processor before anything is drawn: ten runs of 60 000 poses each.
#include <benchmark/benchmark.h>

#include <cmath>

#include "app/gui/diagnosis_view.h"
#include "test/ui/headless_screen.h"
#include "ui/panels/diagnosis_findings_panel.h"
#include "ui/panels/diagnosis_runs_panel.h"
#include "ui/panels/diagnosis_time_panel.h"
#include "ui/panels/floor_view.h"

namespace odolab {
namespace {

constexpr int kRuns = 10, kPoses = 60000;

struct LongRuns {
  std::vector<MismatchOverTime> mismatch{std::size_t(kRuns)};
  std::vector<ui::Trail> trails;
  std::vector<Track> truth{std::size_t(kRuns)}, simulated{std::size_t(kRuns)};
  Diagnosis diagnosis;
  ui::DiagnosisView view;

  LongRuns() {
    for (std::size_t r = 0; r < std::size_t(kRuns); ++r) {
      MismatchOverTime& m = mismatch[r];
      for (int i = 0; i < kPoses; ++i) {
        const double t = 0.01 * i, a = 0.3 * t;
        m.time_s.push_back(t);
        m.x_m.push_back(0.1 * double(r) + 2.0 * std::cos(a) + std::cos(0.37 * a));
        m.y_m.push_back(2.0 * std::sin(a) + std::sin(0.53 * a));
        m.before.push_back(1.0 + 4.0 * std::abs(std::sin(7.0 * a)));
        m.after.push_back(1.0 + 0.5 * std::sin(31.0 * t));
        const Pose pose{m.x_m.back(), m.y_m.back(), a};
        truth[r].push_back({t, pose});
        simulated[r].push_back({t, {pose.x_m + 0.01, pose.y_m, a}});
      }
      trails.emplace_back(m.time_s, m.x_m, m.y_m, m.before);
    }
    for (std::size_t r = 0; r < std::size_t(kRuns); ++r) {
      ui::DiagnosedRun run;
      run.name = "run_" + std::to_string(r) + ".csv";
      run.duration_s = 600.0;
      run.way = run.mismatch_trail = &trails[r];
      run.mismatch = &mismatch[r];
      run.truth_track = &truth[r];
      run.simulated_track = &simulated[r];
      view.runs.push_back(run);
    }
    view.diagnosis = &diagnosis;
    view.findings.resize(2);
  }
};

void picture_of_diagnose(benchmark::State& bench) {
  static const LongRuns runs;
  ui::HeadlessScreen screen(1280, 720);
  ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;  // as the window's renderer
  ui::DiagnosisState state;
  ui::FloorViewState floor;
  floor.exaggerate = bench.range(0) != 0;
  const auto all = [&] {
    bool ask = false;
    ImGui::BeginChild("left", {300, 500});
    ui::diagnosis_runs_panel(runs.view, state, "LabMate", ask, screen.theme);
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("floor", {660, 500});
    ui::floor_view(diagnosis_scene(runs.view, state, screen.theme), floor, screen.theme);
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("right", {280, 500});
    ui::diagnosis_findings_panel(runs.view, state, screen.theme);
    ImGui::EndChild();
    ui::diagnosis_time_panel(runs.view, state, screen.theme);
  };
  for (auto _ : bench) screen.picture(all);
}
BENCHMARK(picture_of_diagnose)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace odolab
