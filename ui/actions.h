// What a person wants done. Panels return actions; whoever owns the session carries them out.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/guide/guide_session.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "ui/diagnosis_actions.h"

namespace odolab::ui {

enum class Mode { drive, calibrate, compare, diagnose, learn };

// The transport bar, of whatever the present mode plays.
struct Play {};
struct Pause {};
struct StepForward {};  // by one picture, 20 ms
struct StepBack {};
struct ToStart {};
struct ToEnd {};
struct Restart {};
struct SetSpeed {
  double factor = 1.0;  // 0: as fast as possible
};
struct ScrubTo {
  double time_s = 0.0;
};

// The experiment.
struct EditScenario {  // restarts the run
  Scenario scenario;
};
struct SetFloor {  // takes effect while the run goes on
  Floor floor;
  bool begins_gesture = true;  // false: goes on with the same drag, one step for undo
};
struct DriveByHandInstead {  // of the scenario's path, or back to it
  bool by_hand = true;
};
struct DriveByHand {
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
  double sideways_mps = 0.0;  // of vehicles that can
};
struct Push {
  Vec2 impulse_ns;
};
struct Undo {};
struct Redo {};

// The bench.
struct StartBenchmark {
  int runs_each_way = 5;     // 0: as the scenario asks for
  bool keep_things = false;  // cables and patches stay on the floor; else only its friction, tilt and roughness count
};
struct ApplyCalibration {};  // the corrected vehicle is driven through the same benchmark
struct AdoptCalibration {};  // the corrected vehicle becomes the one that Drive drives
struct ClearBenchmark {};
struct CancelJob {};

// The guides.
struct ShowGuides {  // in Calibrate, instead of the bench
  bool on = true;
};
struct BeginGuide {
  GuideKind kind = GuideKind::umbmark;
  bool real_robot = true;
};
struct ResumeGuide {
  std::string path;
};
struct LeaveGuide {};                          // it is kept, and can be gone on with
enum class GuideEdit { edit, goes_on, page };  // a step for undo; the same drag or word; only another page
struct ChangeGuide {                           // what a person has entered, or another page
  GuideSession session;
  GuideEdit how = GuideEdit::edit;
};
struct ChooseGuideVehicle {  // a vehicle file
  std::string path;
};
struct DriveGuide {};  // the simulated robot drives what the page asks for
enum class GuideExport { vehicle, ros2, report };
struct ExportGuide {
  GuideExport what = GuideExport::vehicle;
  std::string path;
};

// Lessons.
struct OpenLesson {
  std::string path;
};
struct LessonStepTo {
  int step = 0;  // counted from 0
};
struct AnswerLesson {
  int choice = 0;
  int stake = 0;
};
struct AskMystery {};  // the concealed robot drives, and is diagnosed
struct LeaveLesson {};

// Recordings.
enum class ReplayVehicle { nominal, calibrated };
struct ReplayWith {
  ReplayVehicle vehicle = ReplayVehicle::nominal;
};
struct CalibrateFromRecording {};
struct RecordSimulatedRun {};  // the present scenario, driven to its end, becomes the recording to compare

// Diagnose.
struct InDiagnosis {
  DiagnosisAction what;
};
struct TakeDriveVehicle {};  // the vehicle of Drive is the one to diagnose

// Files and the window.
struct OpenFile {
  std::string path;
};
struct SaveScenario {
  std::string path;
};
struct SaveRecording {
  std::string path;
};
struct SaveCurves {  // that the plot over time shows, within what it shows of it
  std::string path;
  Recording curves;
};
struct LoadFirstScenario {};
struct SetMode {
  Mode mode = Mode::drive;
};
struct DismissMessage {
  std::size_t index = 0;
};
struct SavePicture {};
struct Quit {};

using Action =
    std::variant<Play, Pause, StepForward, StepBack, ToStart, ToEnd, Restart, SetSpeed, ScrubTo, EditScenario, SetFloor,
                 DriveByHandInstead, DriveByHand, Push, Undo, Redo, StartBenchmark, ApplyCalibration, AdoptCalibration,
                 ClearBenchmark, CancelJob, ShowGuides, BeginGuide, ResumeGuide, LeaveGuide, ChangeGuide,
                 ChooseGuideVehicle, DriveGuide, ExportGuide, OpenLesson, LessonStepTo, AnswerLesson, AskMystery,
                 LeaveLesson, ReplayWith, CalibrateFromRecording, RecordSimulatedRun, InDiagnosis, TakeDriveVehicle,
                 OpenFile, SaveScenario, SaveRecording, SaveCurves, LoadFirstScenario, SetMode, DismissMessage,
                 SavePicture, Quit>;

using Actions = std::vector<Action>;

inline void append(Actions& all, Actions more) {
  for (Action& a : more) all.push_back(std::move(a));
}

}  // namespace odolab::ui
