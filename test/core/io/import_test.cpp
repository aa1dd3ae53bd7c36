#include <Eigen/Dense>
#include <cmath>
#include <functional>

#include "core/io/import/imported_recording.h"
#include "core/io/recording_csv.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

std::string square(int run, const std::string& ending) {
  return recordings_folder() + "/optiodom/square/231220200029/231220200029_run-0" + std::to_string(run) + ending;
}

TEST(Import, SynchronisedTicksAreRightThenLeftAndAddUp) {
  ScratchFolder folder;
  const std::string path = folder.write("run-01.csv", "0,0,0,0,0,0\n0.05,0.1,0.2,0.3,6,5\n0.1,0.4,0.5,0.6,-2,7\n");
  const Result<ImportedRecording> imported = import_recording({path});
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  const Recording& r = imported->recording;
  EXPECT_EQ(r.time_s, (std::vector<double>{0.0, 0.05, 0.1}));
  EXPECT_EQ(r.channel("right_ticks")->values, (std::vector<double>{0, 6, 4}));
  EXPECT_EQ(r.channel("left_ticks")->values, (std::vector<double>{0, 5, 12}));
  EXPECT_EQ(r.channel("truth_y_m")->values, (std::vector<double>{0, 0.2, 0.5}));
  EXPECT_TRUE(imported->warnings.empty());
  EXPECT_TRUE(problems_in(r).empty());
}

TEST(Import, UtiasKeepsCommandsAndTruthOnOneClock) {
  ScratchFolder folder;
  const std::string odometry =
      folder.write("Robot1_Odometry.dat",
                   "# UTIAS\n# Time [s]\n1248444187.156 \t  0.086 \t -0.398\n1248444187.200 0.1 0.0\n"
                   "1248444187.190 0.2 0.0\n1248444187.200 0.3 0.0\n");
  folder.write("Robot1_Groundtruth.dat", "# UTIAS\n1248444187.100 1 2 3\n1248444187.156 1.1 2.1 3.1\n");
  const Result<ImportedRecording> imported = import_recording({odometry});
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  const Recording& r = imported->recording;
  EXPECT_EQ(r.time_s, (std::vector<double>{0.0, 0.056, 0.1, 0.1}));
  EXPECT_TRUE(std::isnan(r.channel("command_speed_mps")->values[0]));
  EXPECT_EQ(r.channel("command_yaw_rate_radps")->values[1], -0.398);
  EXPECT_EQ(r.channel("truth_heading_rad")->values[1], 3.1);
  EXPECT_EQ(r.channel("command_speed_mps")->values[3], 0.3);
  EXPECT_EQ(imported->warnings,
            std::vector<std::string>{"1 row of Robot1_Odometry.dat left out: time goes back there"});
  EXPECT_TRUE(problems_in(r).empty());
}

TEST(Import, SaysInOneLineWhatIsWrong) {
  ScratchFolder folder;
  const auto complaint = [&](const std::vector<std::string>& sources) {
    return message_of(import_recording(sources), folder.path("x"));
  };
  EXPECT_EQ(complaint({folder.path("none.csv")}), "none.csv: found no such file, expected a file that can be read");
  EXPECT_EQ(
      complaint({folder.write("letter.txt", "Dear reader,\n")}),
      "letter.txt: found a file of no known format, expected a recording CSV, a synchronised OptiOdom file (six "
      "columns), "
      "a raw OptiOdom pair (_odo.csv and _opti.csv), a UTIAS RobotN_Odometry.dat with its RobotN_Groundtruth.dat, a "
      "ROS 2 bag (a folder, or its .mcap or .db3 file), a TUM trajectory (t x y z qx qy qz qw), KITTI poses (twelve "
      "numbers a row) with their times or any text of columns with --map or --mapping");
  const std::string synchronised = folder.write("run-01.csv", "0,0,0,0,0,0\n0.05,0.1,0.2\n");
  EXPECT_EQ(complaint({synchronised}), "run-01.csv:2: found 3 cells, expected 6");
  EXPECT_EQ(complaint({synchronised, synchronised}),
            "run-01.csv: found a second file, expected one synchronised file alone");
  EXPECT_EQ(complaint({folder.write("b.csv", "0,0,0,0,0,0\n0.05,0,0,0,-")}),
            "b.csv:2: found a last line cut off after 5 cells, expected 6");
  EXPECT_EQ(complaint({folder.write("c.csv", "0,0,0,0,0,0\n0.05,0,zero,0,1,1\n")}),
            "c.csv:2: column 3: found 'zero', expected a number");
  EXPECT_EQ(complaint({folder.write("d.csv", "0.1,0,0,0,0,0\n0.05,0,0,0,1,1\n")}),
            "d.csv:2: column 1: found 0.05 after 0.1, expected times that never decrease");
  EXPECT_EQ(complaint({folder.write("g.csv", "0,0,0,0,0,0\n1.7e9,0,0,0,1,1\n")}),
            "g.csv:2: column 1: found 1.7e+09 after 0, expected rows a day apart at most, by one clock that nobody "
            "sets meanwhile");
  // A CSV of one's own whose header is missing.
  EXPECT_EQ(complaint({folder.write("f.csv", "0,0,0,0,0,0\n0.05,0.5,0.5,0.03,0.02,0.1\n")}),
            "f.csv:2: column 5: found 0.02, expected whole ticks: six columns without a header are a synchronised "
            "OptiOdom file; a CSV of one's own has one, as time_s,left_wheel_rad,right_wheel_rad,truth_x_m,truth_y_m");
  const std::string odometry = folder.write("a_run-01_odo.csv", "23.5,0,0\n23.55,1,2\n");
  EXPECT_EQ(complaint({odometry}),
            "a_run-01_odo.csv: found three columns as of OptiOdom's raw odometry, alone, expected its _opti.csv too, "
            "or --map "
            "for other columns");
  EXPECT_EQ(complaint({odometry, synchronised}),
            "run-01.csv: found a file of OptiOdom, synchronised, expected one of OptiOdom, raw as the first source");
  folder.write("e_run-01_opti.csv", "Format Version,1.23");
  EXPECT_NE(complaint({folder.write("e_run-01_odo.csv", "23.5,0,0\n23.55,1,2\n")}).find("e_run-01_opti.csv"),
            std::string::npos);  // cut off within its first line
  const std::string utias = folder.write("Robot4_Odometry.dat", "# UTIAS\n1 2 3\n");
  EXPECT_EQ(complaint({utias}),
            "Robot4_Odometry.dat: found the odometry alone, expected the robot's Groundtruth.dat beside it");
  folder.write("runs/one.csv", "time_s,left_ticks,right_ticks\n0,1,2\n");
  EXPECT_EQ(complaint({folder.path("runs")}),
            "runs: found a folder with 1 file of recordings, expected one run, such as 'one.csv'");
  EXPECT_EQ(message_of(load_recording(folder.path("runs/one.csv")), ""), "ok");
  folder.write("runs/estimated_track.csv", "time_s,x_m,y_m,heading_rad\n0,1,2,0\n");
  EXPECT_EQ(complaint({folder.path("runs")}),
            "runs: found a folder with 1 file of recordings, expected one run, such as 'one.csv'");
}

TEST(Import, ReadsEveryRealRecording) {
  SKIP_WITHOUT_RECORDINGS();
  int synchronised = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(recordings_folder())) {
    const std::string name = entry.path().filename().string();
    const bool alone =
        name.find("run-") != std::string::npos && name.size() > 5 && name.find("_o") == std::string::npos;
    if (!alone && name.find("_Odometry.dat") == std::string::npos && name.find("_opti.csv") == std::string::npos)
      continue;
    const Result<ImportedRecording> imported = load_recording(entry.path().string());
    ASSERT_TRUE(imported.ok()) << imported.error().message();
    EXPECT_TRUE(problems_in(imported->recording).empty()) << name;
    EXPECT_GT(imported->recording.duration_s(), 10.0) << name;
    ScratchFolder folder;
    ASSERT_TRUE(write_recording_csv(folder.path("r.csv"), imported->recording).ok());
    const Result<Recording> back = read_recording_csv(folder.path("r.csv"));
    ASSERT_TRUE(back.ok()) << back.error().message();
    EXPECT_EQ(back->time_s, imported->recording.time_s) << name;
    synchronised += alone ? 1 : 0;
  }
  EXPECT_EQ(synchronised, 19);  // the runs that are handed out
}

// The same run, once as its authors synchronised it and once raw: the planar pose must be the same up to where the
// origin lies, which way it looks, and which point of the robot is tracked.
TEST(Import, TheRawPairAgreesWithTheSynchronisedFileOfTheSameRun) {
  SKIP_WITHOUT_RECORDINGS();
  for (int run = 1; run <= 3; ++run) {
    const Result<ImportedRecording> raw = import_recording({square(run, "_opti.csv"), square(run, "_odo.csv")});
    const Result<ImportedRecording> synchronised = import_recording({square(run, ".csv")});
    ASSERT_TRUE(raw.ok()) << raw.error().message();
    ASSERT_TRUE(synchronised.ok()) << synchronised.error().message();

    // the wheels: the same counts for the same wheel at the same time
    DifferentialDrive drive;
    const std::vector<WheelSample> a = wheel_samples(raw->recording, drive),
                                   b = wheel_samples(synchronised->recording, drive);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].left_rad, b[i].left_rad);
      ASSERT_EQ(a[i].right_rad, b[i].right_rad);
      ASSERT_NEAR(a[i].time_s, b[i].time_s, 1e-9);  // the synchronised stamps carry 1e-11 s of summing
    }

    // the truth: synchronised = R p + t + R(heading) m, linear in the six unknowns
    const Track raw_truth = truth_track(raw->recording), truth = truth_track(synchronised->recording);
    std::vector<Pose> at;
    std::vector<Pose> wanted;
    // Where a frame was left out there is nothing to hold against.
    const auto seen_at = [&](double time_s) {
      const auto later = std::lower_bound(raw_truth.begin(), raw_truth.end(), time_s,
                                          [](const TimedPose& p, double t) { return p.time_s < t; });
      return later != raw_truth.begin() && later != raw_truth.end() && later->time_s - (later - 1)->time_s < 0.015;
    };
    for (const TimedPose& p : truth)
      if (const std::optional<Pose> pose = pose_at(raw_truth, p.time_s); pose && seen_at(p.time_s)) {
        at.push_back(*pose);
        wanted.push_back(p.pose);
      }
    ASSERT_GT(static_cast<double>(at.size()), 0.8 * static_cast<double>(truth.size()));
    const auto n = static_cast<Eigen::Index>(at.size());
    Eigen::MatrixXd design(2 * n, 6);
    Eigen::VectorXd right_side(2 * n);
    double heading_sum = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Pose &p = at[i], &q = wanted[i];
      const double c = std::cos(p.heading_rad), s = std::sin(p.heading_rad);
      design.row(2 * i) << p.x_m, -p.y_m, 1.0, 0.0, c, -s;
      design.row(2 * i + 1) << p.y_m, p.x_m, 0.0, 1.0, s, c;
      right_side[2 * i] = q.x_m;
      right_side[2 * i + 1] = q.y_m;
      heading_sum += wrapped(q.heading_rad - p.heading_rad - (wanted[0].heading_rad - at[0].heading_rad));
    }
    const Eigen::VectorXd fit = design.colPivHouseholderQr().solve(right_side);
    const double rms_m = std::sqrt((design * fit - right_side).squaredNorm() / static_cast<double>(n));
    EXPECT_LT(rms_m, 0.0005);  // linear between 10 ms frames, and the body's pose against markers: 0.25 mm measured
    EXPECT_NEAR(std::hypot(fit[0], fit[1]), 1.0, 5e-5);  // neither stretched nor mirrored
    double heading_square_sum = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double e =
          wrapped(wanted[i].heading_rad - at[i].heading_rad - (wanted[0].heading_rad - at[0].heading_rad)) -
          heading_sum / static_cast<double>(n);
      heading_square_sum += e * e;
    }
    EXPECT_LT(std::sqrt(heading_square_sum / static_cast<double>(n)),
              0.003);  // 1.5 mrad measured, of two markers 10 cm apart
  }
}

// A left wheel that runs ahead turns the robot clockwise: the sign holds for both forms of the same run.
TEST(Import, WheelsAndTruthTurnTheSameWay) {
  SKIP_WITHOUT_RECORDINGS();
  DifferentialDrive drive;
  drive.wheel_radius_left_m = drive.wheel_radius_right_m = 0.042;
  drive.wheelbase_m = 0.2;
  drive.encoder_counts_per_revolution = 64;
  drive.gear_ratio = 43.7;
  for (const std::string& path : {square(1, ".csv"), square(1, "_odo.csv"),
                                  recordings_folder() + "/optiodom/free/020120212354/020120212354_run-01.csv"}) {
    const Result<ImportedRecording> imported = load_recording(path);
    ASSERT_TRUE(imported.ok()) << imported.error().message();
    const std::vector<WheelSample> wheels = wheel_samples(imported->recording, drive);
    const Track truth = truth_track(imported->recording);
    const WheelSample &first = wheels.front(), &last = wheels.back();
    const double by_wheels_rad = 0.042 * ((last.right_rad - first.right_rad) - (last.left_rad - first.left_rad)) / 0.2;
    const double by_truth_rad = truth.back().pose.heading_rad - truth.front().pose.heading_rad;
    EXPECT_GT(std::abs(by_truth_rad), 3.0) << path;
    EXPECT_NEAR(by_wheels_rad / by_truth_rad, 1.0, 0.1) << path;  // nominal radii and wheelbase, not calibrated
  }
}

// Motive's export of so many frames, 0.1 s apart, in which the second of two markers is hidden where `hides` says so.
std::string motive_export(int frames, const std::function<bool(int frame)>& hides) {
  std::string text =
      "Format Version,1.23\n\n,Type,Rigid Body\n,Name,robot\n,ID,1\n"
      ",,Rotation,Rotation,Rotation,Position,Position,Position,Mean Marker Error,Position,Position,Position,Marker "
      "Quality,"
      "Position,Position,Position,Marker Quality\nFrame,Time (Seconds),Y,X,Z,X,Y,Z,,X,Y,Z,,X,Y,Z,\n";
  for (int k = 0; k < frames; ++k)
    text += std::to_string(k) + "," + std::to_string(0.1 * k) + ",0,0,0," + std::to_string(0.01 * k) +
            ",0,0,0.001,0,0,0,0.9,0,0,0," + (hides(k) ? "0.000001" : "0.8") + "\n";
  return text;
}

TEST(Import, LeavesOutFramesInWhichAMarkerOfTheBodyWasHiddenUnlessItAlwaysIs) {
  std::string odometry;
  for (int k = 0; k < 100; ++k)
    odometry += std::to_string(0.1 * k) + "," + std::to_string(k) + "," + std::to_string(k) + "\n";
  const auto poses = [&](const std::function<bool(int frame)>& hides) {
    ScratchFolder folder;
    folder.write("a_run-01_opti.csv", motive_export(100, hides));
    const Result<ImportedRecording> imported = import_recording({folder.write("a_run-01_odo.csv", odometry)});
    EXPECT_TRUE(imported.ok()) << (imported.ok() ? "" : imported.error().message());
    return imported.ok() ? truth_samples(imported->recording).size() : 0;
  };
  EXPECT_EQ(poses([](int) { return false; }), 100u);
  EXPECT_EQ(poses([](int frame) { return frame >= 40 && frame < 47; }), 93u);
  EXPECT_EQ(poses([](int) { return true; }), 100u);
}

TEST(Import, WithoutMetadataTheTurningLinesUpTheClocks) {
  SKIP_WITHOUT_RECORDINGS();
  for (int run = 1; run <= 3; ++run) {
    ScratchFolder folder;
    std::filesystem::copy_file(square(run, "_odo.csv"), folder.path("r_run-01_odo.csv"));
    std::filesystem::copy_file(square(run, "_opti.csv"), folder.path("r_run-01_opti.csv"));
    const Result<ImportedRecording> alone = import_recording({folder.path("r_run-01_odo.csv")});
    const Result<ImportedRecording> with = import_recording({square(run, "_odo.csv")});
    ASSERT_TRUE(alone.ok()) << alone.error().message();
    ASSERT_TRUE(with.ok()) << with.error().message();
    EXPECT_EQ(alone->warnings.size(), 3u);  // frames without the body, frames without a marker, and the clocks
    // in the first seconds the truth's clock, 2 % fast, has not run away yet; picked by hand, it is good to 0.2 s
    const Track a = truth_track(alone->recording), b = truth_track(with->recording);
    for (double t : {4.0, 5.0, 6.0}) {
      const std::optional<Pose> p = pose_at(a, t), q = pose_at(b, t);
      ASSERT_TRUE(p && q);
      EXPECT_LT(length(p->position() - q->position()), 0.1);  // 0.3 s at about 0.25 m/s
    }
  }
}

}  // namespace
}  // namespace odolab
