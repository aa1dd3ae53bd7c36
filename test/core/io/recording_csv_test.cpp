#include "core/io/recording_csv.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/random.h"
#include "core/io/import/imported_recording.h"
#include "core/io/track_csv.h"
#include "core/io/whole_file.h"
#include "core/recording/clock_jump.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

std::string complaint_of_recording(const std::string& text) {
  ScratchFolder folder;
  const std::string path = folder.write("run.csv", text);
  return message_of(read_recording_csv(path), path);
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Any finite double, of any size, from random bits.
double any_number(Random& random) {
  for (;;) {
    const std::uint64_t bits = random.next();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) return value;
  }
}

TEST(RecordingCsv, ReadsColumnsInAnyOrderWithEmptyCells) {
  ScratchFolder folder;
  const std::string path = folder.write("run.csv",
                                        "left_wheel_rad,time_s,right_wheel_rad,truth_x_m,truth_y_m\n"
                                        "0,0,0,1.5,-2\n"
                                        "0.1,0.05,0.2,,\n");
  const Result<Recording> recording = read_recording_csv(path);
  ASSERT_TRUE(recording.ok()) << recording.error().message();
  EXPECT_EQ(recording->name, "run.csv");
  EXPECT_EQ(recording->time_s, (std::vector<double>{0.0, 0.05}));
  ASSERT_NE(recording->channel("right_wheel_rad"), nullptr);
  EXPECT_EQ(recording->channel("right_wheel_rad")->values[1], 0.2);
  EXPECT_EQ(recording->channel("truth_y_m")->values[0], -2.0);
  EXPECT_TRUE(std::isnan(recording->channel("truth_y_m")->values[1]));
}

TEST(RecordingCsv, ToleratesWhatOtherProgramsWrite) {
  ScratchFolder folder;
  const std::string path = folder.write("run.csv",
                                        "\xEF\xBB\xBF\"time_s\", left_ticks ,right_ticks,note\r\n"
                                        " 0 ,+1,2,start\r\n"
                                        "\r\n"
                                        "0.5, 3,nan,\"turned left, slowly\"");
  const Result<Recording> recording = read_recording_csv(path);
  ASSERT_TRUE(recording.ok()) << recording.error().message();
  EXPECT_EQ(recording->time_s.size(), 2u);
  EXPECT_EQ(recording->channel("left_ticks")->values, (std::vector<double>{1.0, 3.0}));
  EXPECT_TRUE(std::isnan(recording->channel("right_ticks")->values[1]));
  EXPECT_TRUE(std::isnan(recording->channel("note")->values[0]));
}

TEST(RecordingCsv, ReadsSemicolonsAndTabsWithDecimalCommasBelowComments) {
  for (const char divider : {';', '\t'}) {
    std::string text =
        "# a log\n# of 2026\ntime_s;left_ticks;right_ticks;truth_x_m;truth_y_m\n0,0;1;2;;\n0,5;3;4;-1,25;2.5\n";
    std::replace(text.begin(), text.end(), ';', divider);
    ScratchFolder folder;
    const Result<ImportedRecording> read = load_recording(folder.write("run.csv", text));
    ASSERT_TRUE(read.ok()) << read.error().message();
    EXPECT_EQ(read->recording.time_s, (std::vector<double>{0.0, 0.5}));
    EXPECT_EQ(read->recording.channel("right_ticks")->values, (std::vector<double>{2.0, 4.0}));
    EXPECT_TRUE(std::isnan(read->recording.channel("truth_x_m")->values[0]));
    EXPECT_EQ(read->recording.channel("truth_x_m")->values[1], -1.25);
    EXPECT_EQ(read->recording.channel("truth_y_m")->values[1], 2.5);
  }
}

TEST(RecordingCsv, TakesTheWordsOfOtherProgramsForNothing) {
  for (const char* nothing : {"", "NaN", "nan", "NA", "N/A", "#N/A", "null", "None"}) {
    ScratchFolder folder;
    const std::string path =
        folder.write("run.csv", std::string("time_s,left_ticks,right_ticks\n0,1,2\n1,3,") + nothing + "\n");
    const Result<Recording> read = read_recording_csv(path);
    ASSERT_TRUE(read.ok()) << read.error().message();
    EXPECT_TRUE(std::isnan(read->channel("right_ticks")->values[1])) << nothing;
  }
}

TEST(RecordingCsv, SaysThatAColumnOfWordsIsLeftOut) {
  ScratchFolder folder;
  const Result<ImportedRecording> read = load_recording(
      folder.write("run.csv", "time_s,left_ticks,right_ticks,mode,load_n\n0,1,2,auto,\n1,3,4,manual,5\n"));
  ASSERT_TRUE(read.ok()) << read.error().message();
  EXPECT_EQ(read->recording.channel("mode"), nullptr);
  EXPECT_NE(read->recording.channel("load_n"), nullptr);
  EXPECT_EQ(read->warnings, std::vector<std::string>{"the column 'mode' holds no number and is left out"});
}

TEST(RecordingCsv, SaysInOneLineWhatIsWrong) {
  EXPECT_EQ(complaint_of_recording("0.0,1,2\n0.1,1,2\n"),
            "run.csv:1: found numbers, expected a header line that names the columns, 'time_s' among them");
  EXPECT_EQ(complaint_of_recording(std::string("\xFF\xFEt\0,\0", 6)),
            "run.csv: found text in UTF-16, expected text in UTF-8: 'iconv -f UTF-16 -t UTF-8' makes it");

  EXPECT_EQ(complaint_of_recording(""), "run.csv: found an empty file, expected a header line with a column 'time_s'");
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\n"),
            "run.csv:1: found a header without rows, expected one row or more");
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\r0,0,0\r1,2,3\r"),
            "run.csv: found lines that end in a carriage return alone, expected line feeds: 'tr \"\\r\" \"\\n\"' makes "
            "them");
  EXPECT_EQ(
      complaint_of_recording("t,left_ticks\n0,1\n"),
      "run.csv:1: found the columns 't', 'left_ticks', expected a column 'time_s'; odolab import --map reads other "
      "names");
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks\n0,1\n"),
            "run.csv:1: found the column 'left_ticks' alone, expected a column 'right_ticks' with it");
  EXPECT_EQ(complaint_of_recording("time_s,left_wheel_rad,right_ticks\n0,1,2\n"),
            "run.csv:1: found the column 'left_wheel_rad' beside 'right_ticks', expected both wheels in one unit: "
            "'right_wheel_rad' with the first, or 'left_ticks' with the second");
  EXPECT_EQ(complaint_of_recording("time_s,truth_x_m,truth_y_m,truth_x_m\n0,1,2,3\n"),
            "run.csv:1: found the column 'truth_x_m' twice, expected each column once");
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\n0,1,2\n1,2,three\n"),
            "run.csv:3: right_ticks: found 'three', expected a number");
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\n0,1,inf\n"),
            "run.csv:2: right_ticks: found 'inf', expected a number");
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\n0,1,0x1f\n"),
            "run.csv:2: right_ticks: found '0x1f', expected a number");
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\n,1,2\n"),
            "run.csv:2: time_s: found an empty cell, expected a number");
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\n0.2,1,2\n0.1,1,2\n"),
            "run.csv:3: time_s: found 0.1 after 0.2, expected times that never decrease");
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\n0,1\n1,1,2\n"),
            "run.csv:2: found 2 cells, expected 3, one for each column of the header");
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\n0,1,2,3\n"),
            "run.csv:2: found 4 cells, expected 3, one for each column of the header");
}

TEST(RecordingCsv, RefusesAClockThatWasSetOnTheWay) {
  const std::string header = "time_s,left_ticks,right_ticks\n", expected = ", expected " + std::string(kRowsOfOneClock);
  EXPECT_EQ(complaint_of_recording(header + "0,1,2\n\n1700000000.05,1,2\n1700000000.1,1,2\n"),
            "run.csv:4: time_s: found 1700000000.05 after 0" + expected);
  EXPECT_EQ(complaint_of_recording(header + "0,1,2\n0.05,1,2\n1e30,1,2\n"),
            "run.csv:4: time_s: found 1e+30 after 0.05" + expected);
  EXPECT_EQ(complaint_of_recording(header + "0,1,2\n0.05,1,2\n72000,1,2\n"), "ok");
}

TEST(RecordingCsv, TakesAStepBackByOneUnitOfTheLastDigitForRounding) {
  const auto times = [](const std::string& rows) {
    ScratchFolder folder;
    const std::string text = "time_s,left_ticks,right_ticks\n" + rows;
    const Result<Recording> read = read_recording_csv(folder.write("run.csv", text));
    return read ? read->time_s : std::vector<double>{};
  };
  EXPECT_EQ(times("1710000009.030,1,2\n1710000009.040,1,2\n1710000009.039,,\n1710000009.050,1,2\n"),
            (std::vector<double>{1710000009.030, 1710000009.040, 1710000009.040, 1710000009.050}));
  EXPECT_EQ(times("1710001330.6924,1,2\n1710001330.6923,,\n"), std::vector<double>(2, 1710001330.6924));
  EXPECT_EQ(times("1710000461.090684,1,2\n1710000461.090683,,\n"), std::vector<double>(2, 1710000461.090684));
  EXPECT_EQ(times("0.5,1,2\n0.7001,1,2\n0.7,,\n"), (std::vector<double>{0.5, 0.7001, 0.7001}));
  EXPECT_EQ(times("7.1E-1,1,2\n7.0E-1,,\n"), std::vector<double>(2, 0.71));
  const std::string header = "time_s,left_ticks,right_ticks\n", expected = ", expected times that never decrease";
  EXPECT_EQ(complaint_of_recording(header + "0.6924,1,2\n0.6922,1,2\n"),
            "run.csv:3: time_s: found 0.6922 after 0.6924" + expected);
  EXPECT_EQ(complaint_of_recording(header + "0.6924,1,2\n0.6923,1,2\n0.6922,1,2\n"),
            "run.csv:4: time_s: found 0.6922 after 0.6924" + expected);
  // Digits that other rows have count: zeros at the end may be left out.
  EXPECT_EQ(complaint_of_recording(header + "0.6001,1,2\n0.71,1,2\n0.7,1,2\n"),
            "run.csv:4: time_s: found 0.7 after 0.71" + expected);
  EXPECT_EQ(complaint_of_recording(header + "2,1,2\n1,1,2\n"), "run.csv:3: time_s: found 1 after 2" + expected);
}

TEST(RecordingCsv, IsRefusedWithAValueThatNoRobotHas) {
  ScratchFolder folder;
  const auto complaint = [&](const std::string& row) {
    const std::string path =
        folder.write("run.csv", "time_s,left_wheel_rad,right_wheel_rad,truth_x_m,truth_y_m,price\n0,0,0,0,0,0\n" + row);
    return message_of(load_recording(path), path);
  };
  EXPECT_EQ(complaint("1,0,0,1e200,0,0\n"),
            "run.csv:3: truth_x_m: found '1e200', expected a number from -1e+08 to 1e+08 (m)");
  EXPECT_EQ(complaint("1,0,-1e12,0,0,0\n"),
            "run.csv:3: right_wheel_rad: found '-1e12', expected a number from -1e+09 to 1e+09 (rad)");
  EXPECT_EQ(complaint("1,5e6,5e6,500000,9000000,1e300\n"), "ok");
}

TEST(RecordingCsv, SendsNoBytesToTheTerminalThatItCannotShow) {
  EXPECT_EQ(complaint_of_recording("\xEA\xF5\x1B[2J,\xC2\x9Bm,\xC2\xB5m\n0,1,2\n"),
            "run.csv:1: found the columns '???[2J', '?m', '\xC2\xB5m', expected a column 'time_s'; odolab import --map "
            "reads other names");
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\n0,1,\xFF\x80\x1B\n"),
            "run.csv:2: right_ticks: found '?\?\?', expected a number");
  std::string umlauts;
  for (int i = 0; i < 50; ++i) umlauts += "\xC3\xBC";
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\n0,1," + umlauts + "\n"),
            "run.csv:2: right_ticks: found '" + umlauts.substr(0, 80) + "...', expected a number");
  ScratchFolder folder;
  const Result<ImportedRecording> read =
      load_recording(folder.write("run.csv", "time_s,left_ticks,right_ticks,\x1B[1m\n0,1,2,x\n1,3,4,y\n"));
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->warnings, std::vector<std::string>{"the column '?[1m' holds no number and is left out"});
}

TEST(RecordingCsv, NoticesAFileCutOffInTheMiddle) {
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\n0,1,2\n1,2"),
            "run.csv:3: found a last line cut off after 2 cells, expected 3, one for each column of the header");
  EXPECT_EQ(complaint_of_recording("time_s,left_ticks,right_ticks\n0,1,2\n1,2,-"),
            "run.csv:3: right_ticks: found '-', expected a number");
  EXPECT_EQ(complaint_of_recording("time_s,left_ti"),
            "run.csv:1: found a header without rows, expected one row or more");
  ScratchFolder folder;
  EXPECT_EQ(message_of(read_recording_csv(folder.path("none.csv")), folder.path("none.csv")),
            "none.csv: found no such file, expected a file that can be read");
}

TEST(RecordingCsv, RoundTripKeepsEveryBit) {
  ScratchFolder folder;
  Random random(7);
  Recording recording;
  for (int i = 0; i < 2000; ++i) recording.time_s.push_back(0.1 * i);
  for (const char* name : {"left_wheel_rad", "right_wheel_rad", "battery_v"})
    for (double& v : recording.add_channel(name).values) v = any_number(random);
  recording.channels[0].values[0] = -0.0;
  recording.channels[0].values[1] = std::numeric_limits<double>::denorm_min();
  recording.channels[0].values[2] = std::numeric_limits<double>::max();
  recording.channels[1].values[3] = std::numeric_limits<double>::quiet_NaN();
  const std::string path = folder.path("run.csv");
  ASSERT_TRUE(write_recording_csv(path, recording).ok());
  const Result<Recording> back = read_recording_csv(path);
  ASSERT_TRUE(back.ok()) << back.error().message();
  ASSERT_EQ(back->time_s, recording.time_s);
  ASSERT_EQ(back->channels.size(), 3u);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(back->channels[c].name, recording.channels[c].name);
    for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
      const double was = recording.channels[c].values[i], is = back->channels[c].values[i];
      ASSERT_TRUE(same_bits(was, is) || (std::isnan(was) && std::isnan(is))) << was << " became " << is;
    }
  }
}

TEST(RecordingCsv, LeavesNothingHalfWritten) {
  ScratchFolder folder;
  const std::string path = folder.write("run.csv", "old");
  Recording broken;
  broken.time_s = {1.0, 0.0};
  EXPECT_EQ(message_of(write_recording_csv(path, broken), path),
            "run.csv: time_s: found time going back in row 2, expected times that never decrease");
  EXPECT_EQ(text_of(path), "old");
  EXPECT_EQ(folder.files(), 1u);
  EXPECT_FALSE(write_whole_file(path + "/below/a/file", "text").ok());
  EXPECT_TRUE(write_whole_file(folder.path("new/folder/file"), "text").ok());
  EXPECT_EQ(text_of(folder.path("new/folder/file")), "text");
}

TEST(TrackCsv, RoundTripKeepsEveryBit) {
  ScratchFolder folder;
  Random random(3);
  Track track;
  for (int i = 0; i < 500; ++i)
    track.push_back({0.02 * i, {random.uniform(-9, 9), random.uniform(-9, 9), 0.01 * i + random.uniform(0, 1)}});
  const std::string path = folder.path("track.csv");
  ASSERT_TRUE(write_track_csv(path, track).ok());
  EXPECT_EQ(text_of(path).substr(0, 27), "time_s,x_m,y_m,heading_rad\n");
  const Result<Track> back = read_track_csv(path);
  ASSERT_TRUE(back.ok()) << back.error().message();
  ASSERT_EQ(back->size(), track.size());
  for (std::size_t i = 0; i < track.size(); ++i) {
    EXPECT_TRUE(same_bits((*back)[i].time_s, track[i].time_s) && same_bits((*back)[i].pose.x_m, track[i].pose.x_m));
    EXPECT_TRUE(same_bits((*back)[i].pose.y_m, track[i].pose.y_m));
    EXPECT_TRUE(same_bits((*back)[i].pose.heading_rad, track[i].pose.heading_rad));
  }
}

TEST(TrackCsv, NeedsAllColumnsAndUnwrapsHeadings) {
  ScratchFolder folder;
  const std::string lacking = folder.write("a.csv", "time_s,x_m,y_m\n0,0,0\n");
  EXPECT_EQ(message_of(read_track_csv(lacking), lacking),
            "a.csv:1: found the columns 'time_s', 'x_m', 'y_m', expected a column 'heading_rad'");
  const std::string gap = folder.write("b.csv", "time_s,x_m,y_m,heading_rad\n0,0,,0\n");
  EXPECT_EQ(message_of(read_track_csv(gap), gap), "b.csv:2: y_m: found an empty cell, expected a number");
  const std::string wrapped = folder.write("c.csv", "time_s,x_m,y_m,heading_rad\n0,0,0,3\n1,0,0,-3\n");
  const Result<Track> track = read_track_csv(wrapped);
  ASSERT_TRUE(track.ok());
  EXPECT_NEAR((*track)[1].pose.heading_rad, 2.0 * kPi - 3.0, 1e-15);  // one rounding of a sum of order one
}

TEST(RecordingCsv, StopsReadingWhereItIsTold) {
  const ScratchFolder folder;
  std::string text = "time_s,left_wheel_rad,right_wheel_rad\n";
  for (int i = 0; i < 20000; ++i) text += std::to_string(i) + ",0,0\n";
  const std::string path = folder.write("long.csv", text);
  double most = 0.0;
  EXPECT_TRUE(read_recording_csv(path, [&](double share) { return most = std::max(most, share), true; }).ok());
  EXPECT_GT(most, 0.75);
  EXPECT_LE(most, 1.0);
  const Result<Recording> stopped = read_recording_csv(path, [](double share) { return share < 0.5; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().found, "a wish to stop");
  EXPECT_FALSE(read_recording_csv(path, [](double) { return false; }).ok());
}

}  // namespace
}  // namespace odolab
