#include <cmath>

#include "core/geometry/angles.h"
#include "core/io/import/imported_recording.h"
#include "core/io/import/text_rows.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

ImportWishes mapped(const std::vector<std::string>& columns) {
  ImportWishes wishes;
  for (const std::string& words : columns) {
    const std::optional<Error> error = add_column(wishes.mapping, words);
    EXPECT_FALSE(error) << error->message();
  }
  return wishes;
}

TEST(TextStamp, KeepsEveryNanosecond) {
  EXPECT_EQ(stamp_ns("1700000000.123456789", 1'000'000'000), 1700000000123456789);
  EXPECT_EQ(stamp_ns("1700000000123456789", 1), 1700000000123456789);
  EXPECT_EQ(stamp_ns("-0.5", 1'000'000'000), -500000000);
  EXPECT_EQ(stamp_ns("12.3456785", 1'000'000), 12345679);  // half a nanosecond rounds up
  EXPECT_EQ(stamp_ns("1.7e3", 1'000'000), 1700000000);
  EXPECT_EQ(stamp_ns("0.0000000000000000001", 1'000'000'000), 0);
  for (const char* none : {"", "-", ".", "12a", "1e400", "99999999999999999999", "nan"})
    EXPECT_FALSE(stamp_ns(none, 1'000'000'000)) << none;
}

TEST(MappedText, TakesColumnsByNameUnitAndSign) {
  ScratchFolder folder;
  const std::string path = folder.write("log.csv",
                                        "\xEF\xBB\xBFstamp_ms;note;enc_l;enc_r;x_mm\r\n"
                                        "1000;start;0;0;0\r\n"
                                        "1500;;90;-180;\r\n"
                                        "2000;\"a;b\";180;-360;2500\r\n");
  const Result<ImportedRecording> imported =
      import_recording({path}, mapped({"time_s=stamp_ms,ms", "left_wheel_rad=enc_l,deg", "right_wheel_rad=-enc_r,deg",
                                       "truth_x_m=x_mm,mm", "truth_y_m=5,mm,0"}));
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  const Recording& r = imported->recording;
  EXPECT_TRUE(imported->warnings.empty());
  EXPECT_EQ(r.time_s, (std::vector<double>{0.0, 0.5, 1.0}));
  EXPECT_DOUBLE_EQ(r.channel("left_wheel_rad")->values[2], kPi);
  EXPECT_DOUBLE_EQ(r.channel("right_wheel_rad")->values[2], 2.0 * kPi);
  EXPECT_TRUE(std::isnan(r.channel("truth_x_m")->values[1]));
  EXPECT_EQ(r.channel("truth_x_m")->values[2], 2.5);
}

TEST(TextStamp, ReadsDates) {
  EXPECT_EQ(stamp_ns("2024-01-02T03:04:05.25", 1), 1704164645250000000);
  EXPECT_EQ(stamp_ns("2024/01/02 03:04:05Z", 1), 1704164645000000000);
  EXPECT_EQ(stamp_ns("2024-01-02T03:04:05+02:00", 1), 1704157445000000000);
  EXPECT_EQ(stamp_ns("2024-01-02T03:04:05,5-0130", 1), 1704170045500000000);
  EXPECT_EQ(stamp_ns("1970-01-01 00:00:00", 1), 0);
  EXPECT_EQ(stamp_ns("2000-03-01T00:00:00", 1), 951868800000000000);  // a leap year of a full century
  for (const char* none : {"2024-13-02T03:04:05", "2024-01-02T03:04", "2024-01-02T03:04:05x", "2024-01-02T03:04:05+2"})
    EXPECT_FALSE(stamp_ns(none, 1)) << none;
}

// As a spreadsheet writes it where the comma is the decimal point.
TEST(MappedText, TakesDecimalCommasWhereTheyDivideNoCells) {
  ScratchFolder folder;
  const std::string path =
      folder.write("log.csv", "\xEF\xBB\xBFZeit [ms];links;rechts\r\n0,0;0,5;-1\r\n20,5;1,25;2.5\r\n");
  const Result<ImportedRecording> imported =
      import_recording({path}, mapped({"time_s=Zeit [ms],ms", "left_wheel_rad=links", "right_wheel_rad=rechts"}));
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  EXPECT_EQ(imported->recording.time_s, (std::vector<double>{0.0, 0.0205}));
  EXPECT_EQ(imported->recording.channel("left_wheel_rad")->values, (std::vector<double>{0.5, 1.25}));
  EXPECT_EQ(imported->recording.channel("right_wheel_rad")->values, (std::vector<double>{-1.0, 2.5}));
  EXPECT_EQ(imported->warnings, std::vector<std::string>{"log.csv: commas in numbers are taken for decimal points"});
}

// As pandas writes it where the comma is the decimal point.
TEST(MappedText, TakesDecimalCommasInQuotesWhereCommasDivideCells) {
  ScratchFolder folder;
  const auto imported = [&](const std::string& text) {
    const std::string path = folder.write("log.csv", text);
    return import_recording({path}, mapped({"time_s=t", "left_wheel_rad=l", "right_wheel_rad=r"}));
  };
  const Result<ImportedRecording> read = imported("t,l,r\n\"0,000\",0,0\n\"0,020\",\"2,004\",\"-1,5\"\n");
  ASSERT_TRUE(read.ok()) << read.error().message();
  EXPECT_EQ(read->recording.time_s, (std::vector<double>{0.0, 0.02}));
  EXPECT_EQ(read->recording.channel("left_wheel_rad")->values, (std::vector<double>{0.0, 2.004}));
  EXPECT_EQ(read->recording.channel("right_wheel_rad")->values, (std::vector<double>{0.0, -1.5}));
  EXPECT_EQ(read->warnings, std::vector<std::string>{"log.csv: commas in numbers are taken for decimal points"});
}

TEST(MappedText, TakesNoCommaForADecimalPointThatMayDivideThousands) {
  ScratchFolder folder;
  const auto said = [&](const std::string& text) {
    const std::string path = folder.write("log.csv", text);
    return message_of(import_recording({path}, mapped({"time_s=t", "left_ticks=l", "right_ticks=r"})), path);
  };
  const std::string doubt =
      "log.csv: found '1,004', whose comma may divide thousands, expected decimal points, or cells that semicolons "
      "divide";
  EXPECT_EQ(said("t,l,r\n0,0,0\n1,\"1,004\",999\n"), doubt);
  EXPECT_EQ(said("t,l,r\n0,\"1,004\",0\n0.5,0,\"0,5\"\n"), doubt);
}

TEST(TextStamp, ReadsTimesOfDay) {
  EXPECT_EQ(time_of_day_ns("12:00:00"), 43'200'000'000'000);
  EXPECT_EQ(time_of_day_ns("9:00:00,25"), 32'400'250'000'000);
  for (const char* none : {"", "12:00", "24:00:00", "12:60:00", "12:00:00 PM", "1:2:3", "123:00:00"})
    EXPECT_FALSE(time_of_day_ns(none)) << none;
}

// A row that comes late neither turns the day nor turns it back.
TEST(MappedText, CountsTimesOfDayPastMidnight) {
  ScratchFolder folder;
  const std::string path = folder.write(
      "log.csv", "t;l;r\n23:59:59.500;0;0\n23:59:59,900;1;1\n00:00:00.1;2;2\n23:59:59.950;9;9\n0:00:00.5;3;3\n");
  const Result<ImportedRecording> imported =
      import_recording({path}, mapped({"time_s=t", "left_ticks=l", "right_ticks=r"}));
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  EXPECT_EQ(imported->recording.time_s, (std::vector<double>{0.0, 0.4, 0.6, 1.0}));
  EXPECT_EQ(imported->recording.channel("left_ticks")->values, (std::vector<double>{0.0, 1.0, 2.0, 3.0}));
  EXPECT_EQ(imported->warnings,
            std::vector<std::string>{"log.csv: 1 row left out, the first in line 5: time goes back"});
}

TEST(MappedText, KeepsTheFirstRowOfTimesWithoutNames) {
  ScratchFolder folder;
  for (const std::string day : {"", "2024-01-31 "}) {
    const std::string path = folder.write("log.csv", day + "12:00:00.0,1,2\n" + day + "12:00:00.5,3,4\n");
    const Result<ImportedRecording> imported =
        import_recording({path}, mapped({"time_s=1", "left_ticks=2", "right_ticks=3"}));
    ASSERT_TRUE(imported.ok()) << imported.error().message();
    EXPECT_EQ(imported->recording.time_s, (std::vector<double>{0.0, 0.5})) << day;
  }
}

// Whichever of the two columns is mapped, or both, or the name that they share.
TEST(MappedText, AddsNanosecondsToTheSecondsOfAStamp) {
  ScratchFolder folder;
  const std::vector<std::vector<std::string>> names = {
      {"header.stamp", ".sec", ".nanosec"}, {"/odom/stamp", "/secs", "/nsecs"}, {"stamp", "_sec", "_nsec"}};
  for (const std::vector<std::string>& name : names) {
    const std::string seconds = name[0] + name[1], nanoseconds = name[0] + name[2];
    const std::string path = folder.write("log.csv", seconds + "," + nanoseconds + ",l,r\n" +
                                                         "1712345678,999999999,0,0\n1712345679,8,1,1\n"
                                                         "1712345679,20000000,2,2\n");
    const std::vector<std::vector<std::string>> mappings = {{"time_s=" + seconds},
                                                            {"time_s=" + name[0]},
                                                            {"time_s=1,s"},
                                                            {"time_s=" + nanoseconds + ",ns"},
                                                            {"time_s=" + seconds, "time_s=" + nanoseconds + ",ns"}};
    for (std::vector<std::string> columns : mappings) {
      const std::string& by = columns.back();
      SCOPED_TRACE(by);
      columns.insert(columns.end(), {"left_ticks=l", "right_ticks=r"});
      const Result<ImportedRecording> imported = import_recording({path}, mapped(columns));
      ASSERT_TRUE(imported.ok()) << imported.error().message();
      EXPECT_EQ(imported->recording.time_s, (std::vector<double>{0.0, 9e-9, 0.020000001}));
      EXPECT_EQ(imported->warnings,
                std::vector<std::string>{"log.csv: time_s is the sum of '" + seconds + "' and '" + nanoseconds + "'"});
    }
  }
}

TEST(MappedText, RefusesNanosecondsBesideSecondsThatAreNotWhole) {
  ScratchFolder folder;
  const std::string path = folder.write("log.csv", "sec,nanosec,l,r\n1.5,500000000,0,0\n2.5,500000000,0,0\n");
  EXPECT_EQ(message_of(import_recording({path}, mapped({"time_s=sec", "left_ticks=l", "right_ticks=r"})), path),
            "log.csv:2: found '1.5' and '500000000' are no whole second and its nanoseconds, expected rows of numbers "
            "in the mapped columns");
}

TEST(MappedText, DoubtsWholeSecondsThatManyRowsShare) {
  ScratchFolder folder;
  const auto warnings = [&](int rows_a_second) {
    std::string text = "t,l,r\n";
    for (int i = 0; i < 40; ++i)
      text += std::to_string(1712345678 + i / rows_a_second) + "," + std::to_string(i) + ",0\n";
    const std::string path = folder.write("log.csv", text);
    return import_recording({path}, mapped({"time_s=t", "left_ticks=l", "right_ticks=r"}))->warnings;
  };
  EXPECT_EQ(warnings(20), std::vector<std::string>{
                              "log.csv: 38 of 40 rows bear the same stamp as the row before, the first in line 3: 't' "
                              "has whole seconds; map time_s to a column with parts of them, or leave it out and give "
                              "the period between rows"});
  EXPECT_TRUE(warnings(1).empty());
}

TEST(MappedText, TakesItsColumnsFromSeveralFiles) {
  ScratchFolder folder;
  const std::string wheels = folder.write("wheels.csv", "stamp,l,r\n10,0,0\n11,1,2\n");
  const std::string truth = folder.write("truth.csv", "t,x,y\n10,0,0\n10.5,1,2\n");
  const std::vector<std::string> columns = {"time_s=stamp",      "time_s=t",    "left_wheel_rad=l",
                                            "right_wheel_rad=r", "truth_x_m=x", "truth_y_m=y"};
  const Result<ImportedRecording> imported = import_recording({wheels, truth}, mapped(columns));
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  EXPECT_EQ(imported->recording.time_s, (std::vector<double>{0.0, 0.5, 1.0}));
  std::vector<std::string> more = columns;
  more.push_back("truth_heading_rad=yaw");
  EXPECT_EQ(import_recording({wheels, truth}, mapped(more)).error().message(),
            "--map: found no column 'yaw' in any source, expected one for truth_heading_rad");
}

TEST(MappedText, SaysWhichFilesAreByTwoClocks) {
  ScratchFolder folder;
  const std::string wheels = folder.write("wheels.csv", "stamp,l,r\n5.321,0,0\n155.301,1,2\n");
  const auto imported = [&](const std::string& truth) {
    return import_recording({wheels, folder.write("truth.csv", "stamp,x,y\n" + truth)},
                            mapped({"time_s=stamp", "left_ticks=l", "right_ticks=r", "truth_x_m=x", "truth_y_m=y"}));
  };
  EXPECT_EQ(message_of(imported("1712345678.015,0,0\n1712345827.915,1,2\n"), wheels),
            "wheels.csv: found times from 5.321 to 155.301 s in wheels.csv and from 1712345678.015 to 1712345827.915 s "
            "in truth.csv, expected times of one clock that overlap: map each file's in its unit (s, ms, us, ns), and "
            "where clocks differ add to one file's times what it is behind");
  const Result<ImportedRecording> near = imported("200,0,0\n300,1,2\n");
  ASSERT_TRUE(near.ok()) << near.error().message();
  EXPECT_EQ(near->warnings,
            std::vector<std::string>{"times from 5.321 to 155.301 s in wheels.csv and from 200.000 to 300.000 s in "
                                     "truth.csv do not overlap: the files may be by two clocks"});
  EXPECT_TRUE(imported("155.301,0,0\n300,1,2\n")->warnings.empty());
}

// What a person who gives odd files is told.
TEST(MappedText, SaysWhatIsOdd) {
  ScratchFolder folder;
  const auto complaint = [&](const std::string& text, const std::vector<std::string>& columns) {
    return message_of(import_recording({folder.write("log.csv", text)}, mapped(columns)), folder.path("x"));
  };
  EXPECT_EQ(complaint("a;b\n1;2\n", {}),
            "log.csv: found columns of one's own ('a', 'b'), expected --map CHANNEL=COLUMN[,UNIT] for each, such as "
            "time_s=1,ms left_wheel_rad=2,deg (a name or a number)");
  EXPECT_EQ(complaint("t,a,a\n1,2,3\n", {"time_s=t", "left_wheel_rad=a", "right_wheel_rad=a"}),
            "log.csv:1: found several columns 'a', expected one, or the column's number in the mapping");
  EXPECT_EQ(complaint("t,a\n1,2\n", {"time_s=t", "left_ticks=a"}),
            "log.csv: found left_ticks alone, expected right_ticks with it");
  EXPECT_EQ(complaint("t,a,b\r0,0,0\r1,2,3\r", {"time_s=t", "truth_x_m=a", "truth_y_m=b"}),
            "log.csv: found lines that end in a carriage return alone, expected line feeds: 'tr \"\\r\" \"\\n\"' makes "
            "them");
  EXPECT_EQ(complaint(std::string("\xFF\xFEt\0,\0", 6), {"time_s=t", "truth_x_m=a", "truth_y_m=a"}),
            "log.csv: found text in UTF-16, expected text in UTF-8: 'iconv -f UTF-16 -t UTF-8' makes it");
  EXPECT_EQ(
      complaint("t,a,b\n1700000000123456789,2,3\n", {"time_s=t", "truth_x_m=a", "truth_y_m=b"}),
      "log.csv:2: found '1700000000123456789' is no time in s (ms, us, ns say otherwise), expected rows of numbers "
      "in the mapped columns");
  EXPECT_EQ(complaint("0.5,1,2,3\n1.0,1,2,3\n", {}),
            "log.csv: found columns of one's own ('0.5', '1', '2', '3'), expected --map "
            "CHANNEL=COLUMN[,UNIT] for each, such as time_s=1,ms left_wheel_rad=2,deg (a name or a number)");
  std::string hardly_any = "t,a,b\n0,1,2\n";
  for (int i = 1; i < 20; ++i) hardly_any += std::to_string(i) + ",x,3\n";
  EXPECT_EQ(complaint(hardly_any, {"time_s=t", "truth_x_m=a", "truth_y_m=b"}),
            "log.csv:3: found 'x' is no number, expected rows of numbers in the mapped columns");
}

// A wheel that speeds up evenly: the integral between samples is exact by the trapezium rule.
TEST(MappedText, AddsUpRatesOverIrregularTimesAndIncrementsOverRows) {
  ScratchFolder folder;
  const std::vector<double> times = {0.0, 0.5, 0.75, 2.0, 2.25};
  std::string text = "# t rate step\n";
  for (double t : times) text += std::to_string(t) + " " + std::to_string(3.0 * t) + " 7\n";
  const std::string path = folder.write("log.txt", text);
  const Result<ImportedRecording> imported =
      import_recording({path}, mapped({"time_s=t", "left_wheel_rad=rate,rad/s,rate", "right_wheel_rad=step,increment",
                                       "left_ticks=rate,counts/s,rate", "right_ticks=3,increment,-2"}));
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  const Recording& r = imported->recording;
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(r.channel("left_wheel_rad")->values[i], 1.5 * times[i] * times[i], 1e-12);
    EXPECT_EQ(r.channel("right_wheel_rad")->values[i], 7.0 * static_cast<double>(i + 1));
    EXPECT_EQ(r.channel("right_ticks")->values[i], -14.0 * static_cast<double>(i + 1));
  }
}

// A truth that was not there, or a row that came late, takes nothing from the way that the wheel went.
TEST(MappedText, AddsUpIncrementsOfRowsThatItLeavesOut) {
  ScratchFolder folder;
  const std::string path = folder.write("log.txt", "# t step x\n0 1 0\n1 2 gone\n2 4 0\n1.5 8 0\n3 16 0\n");
  const Result<ImportedRecording> imported =
      import_recording({path}, mapped({"time_s=t", "left_wheel_rad=step,increment", "right_wheel_rad=x"}));
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  EXPECT_EQ(imported->recording.channel("left_wheel_rad")->values, (std::vector<double>{1.0, 7.0, 31.0}));
}

// An encoder that is read within a turn, from 0 to 360 degrees.
TEST(MappedText, MakesWheelsContinuousThatWereWrittenWithinATurn) {
  ScratchFolder folder;
  std::string text = "# t deg\n";
  for (int i = 0; i < 50; ++i) text += std::to_string(i) + " " + std::to_string((i * 50) % 360) + "\n";
  const std::string path = folder.write("log.txt", text);
  const Result<ImportedRecording> imported =
      import_recording({path}, mapped({"time_s=t", "left_wheel_rad=deg,deg", "right_wheel_rad=2,deg"}));
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  const std::vector<double>& left = imported->recording.channel("left_wheel_rad")->values;
  for (int i = 0; i < 50; ++i) EXPECT_NEAR(left[static_cast<std::size_t>(i)], i * 50.0 * kPi / 180.0, 1e-9) << i;
  ASSERT_FALSE(imported->warnings.empty());
  EXPECT_NE(imported->warnings.front().find("wrapped into one turn"), std::string::npos) << imported->warnings.front();
}

TEST(MappedText, MakesAHeadingOfAQuaternion) {
  ScratchFolder folder;
  const std::string path =
      folder.write("pose.csv", "t,x,y,qz,qw\n0,1,2,0,1\n1,1,2,0.7071067811865476,0.7071067811865476\n");
  const Result<ImportedRecording> imported =
      import_recording({path}, mapped({"time_s=t", "truth_x_m=x", "truth_y_m=y", "truth_qz=qz", "truth_qw=qw"}));
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  EXPECT_NEAR(imported->recording.channel("truth_heading_rad")->values[1], kPi / 2.0, 1e-15);
}

TEST(MappedText, LeavesOutRowsThatAreNoneAndSaysSo) {
  ScratchFolder folder;
  const std::string path = folder.write("log.csv", "t,l\n0,1\n1,x\n2\n1.5,3\n0.5,4\n3,5\n4");
  const Result<ImportedRecording> imported =
      import_recording({path}, mapped({"time_s=t", "left_ticks=l", "right_ticks=l"}));
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  EXPECT_EQ(imported->recording.time_s, (std::vector<double>{0.0, 1.5, 3.0}));
  EXPECT_EQ(imported->warnings,
            std::vector<std::string>{"log.csv: 4 rows left out, the first in line 3: 'x' is no number"});
}

TEST(MappedText, DoubtsSecondsThatLieFarApart) {
  ScratchFolder folder;
  std::string text = "t,l,r\n";
  for (int i = 0; i < 20; ++i) text += std::to_string(20'000'000 * i) + ",0.1,0.1\n";  // 50 Hz in nanoseconds
  const std::string path = folder.write("log.csv", text);
  const auto warnings = [&](const std::string& time) {
    return import_recording({path}, mapped({time, "left_wheel_rad=l", "right_wheel_rad=r"}))->warnings;
  };
  EXPECT_EQ(
      warnings("time_s=t"),
      std::vector<std::string>{"log.csv: rows are 2e+07 s apart if 't' is in seconds: time_s=t,ms (or us, ns) says "
                               "otherwise"});
  EXPECT_TRUE(warnings("time_s=t,ns").empty());
}

TEST(MappedText, RefusesAClockThatWasSetOnTheWay) {
  ScratchFolder folder;
  const std::string path = folder.write("log.csv", "t,l,r\n0,0,0\n1700000000.05,1,1\n1700000000.1,2,2\n");
  EXPECT_EQ(message_of(import_recording({path}, mapped({"time_s=t", "left_wheel_rad=l", "right_wheel_rad=r"})), path),
            "log.csv:3: time_s: found a row 1700000000 s after the one before, expected rows a day apart at most, by "
            "one clock that nobody sets meanwhile, in the unit that the mapping gives (s, ms, us, ns)");
}

TEST(MappedText, LeavesOutAndRefusesValuesThatNoRobotHas) {
  ScratchFolder folder;
  const std::string one = folder.write("one.csv", "t,x\n0,0\n1,1e300\n2,1\n");
  const Result<ImportedRecording> read = import_recording({one}, mapped({"time_s=t", "truth_x_m=x", "truth_y_m=x"}));
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->recording.time_s, (std::vector<double>{0.0, 2.0}));
  EXPECT_EQ(read->warnings, std::vector<std::string>{"one.csv: 1 row left out, the first in line 3: '1e300' for "
                                                     "truth_y_m is not a number from -1e+08 to 1e+08 (m)"});
  const std::string all = folder.write("all.csv", "t,x\n0,1e200\n1,1e200\n");
  EXPECT_EQ(message_of(import_recording({all}, mapped({"time_s=t", "truth_x_m=x", "truth_y_m=x"})), all),
            "all.csv:2: found '1e200' for truth_y_m is not a number from -1e+08 to 1e+08 (m), expected rows of numbers "
            "in the mapped columns");
}

TEST(MappedText, SaysWhatAMappingLacks) {
  ScratchFolder folder;
  const std::string path = folder.write("log.csv", "t,l\n0,1\n");
  const auto complaint = [&](const ImportWishes& wishes) { return message_of(import_recording({path}, wishes), path); };
  EXPECT_EQ(complaint(mapped({"time_s=stamp"})),
            "log.csv:1: found the columns 't', 'l', expected a column 'stamp' for time_s");
  EXPECT_EQ(complaint(mapped({"left_ticks=l"})),
            "log.csv: found no column for time_s, expected time_s=COLUMN, or a period between rows");
  TextMapping mapping;
  EXPECT_EQ(add_column(mapping, "left_wheel_rad")->message(),
            "--map: found 'left_wheel_rad', expected CHANNEL=COLUMN, then what is known of it: "
            "left_wheel_rad=-enc_l,deg,rate");
  EXPECT_EQ(add_column(mapping, "left_wheel_rad=a,furlongs")->message(),
            "--map: left_wheel_rad: found 'furlongs', expected rad, deg, mrad or turns");
  EXPECT_EQ(add_column(mapping, "truth_x_m=a,rate")->message(),
            "--map: truth_x_m: found rate, expected total: only wheels are added up from rates and increments");
}

TEST(MappedText, ReadsTheMappingFromAFile) {
  ScratchFolder folder;
  const std::string toml =
      folder.write("map.toml",
                   "delimiter = \"tab\"\ncomment = \"%\"\nskip_lines = 1\n\n[[column]]\n"
                   "becomes = \"time_s\"\ncolumn = \"1\"\nunit = \"us\"\n\n[[column]]\n"
                   "becomes = \"left_wheel_rad\"\ncolumn = \"2\"\nunit = \"rpm\"\nkind = \"rate\"\n"
                   "factor = -1\n\n[[column]]\nbecomes = \"right_wheel_rad\"\ncolumn = \"3\"\n");
  const std::string log = folder.write("log.txt", "Logger 2.0\n% begins\n0\t60\t5\n500000\t60\t6\n");
  ImportWishes wishes;
  Result<TextMapping> mapping = read_text_mapping(toml);
  ASSERT_TRUE(mapping.ok()) << mapping.error().message();
  wishes.mapping = *mapping;
  const Result<ImportedRecording> imported = import_recording({log}, wishes);
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  EXPECT_DOUBLE_EQ(imported->recording.channel("left_wheel_rad")->values[1], -kPi);
  EXPECT_EQ(imported->recording.channel("right_wheel_rad")->values[1], 6.0);
  EXPECT_EQ(
      message_of(read_text_mapping(folder.write("bad.toml", "[[column]]\nbecomes = \"time_s\"\n")), folder.path("x")),
      "bad.toml:1: found no key 'column', expected it to be given");
}

TEST(Trajectory, TumGoesWithWheelsOnTheSameClock) {
  ScratchFolder folder;
  const std::string wheels = folder.write("log.csv", "t,l,r\n1700000000.00,0,0\n1700000000.02,1,2\n");
  const std::string truth = folder.write("truth.txt",
                                         "# timestamp tx ty tz qx qy qz qw\n1700000000.01 1 2 0 0 0 0.6 0.8\n"
                                         "1700000000.02 1.5 2 0 0 0 0 1\n");
  const Result<ImportedRecording> imported =
      import_recording({wheels, truth}, mapped({"time_s=t", "left_wheel_rad=l", "right_wheel_rad=r"}));
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  const Recording& r = imported->recording;
  EXPECT_EQ(r.time_s, (std::vector<double>{0.0, 0.01, 0.02}));
  EXPECT_NEAR(r.channel("truth_heading_rad")->values[1], 2.0 * std::atan2(0.6, 0.8), 1e-15);
  EXPECT_EQ(r.channel("truth_x_m")->values[2], 1.5);
  EXPECT_EQ(r.channel("right_wheel_rad")->values[2], 2.0);
}

// A left curve of radius 2 m, as a camera's poses (x right, y down, z ahead) and with z up.
TEST(Trajectory, KittiFindsItsAxesAndItsTimes) {
  for (const bool camera : {true, false}) {
    ScratchFolder folder;
    std::string poses, times;
    for (int i = 0; i < 50; ++i) {
      const double a = 0.05 * i, x = 2.0 * std::sin(a), y = 2.0 - 2.0 * std::cos(a), c = std::cos(a), s = std::sin(a);
      const std::vector<double> m = camera ? std::vector<double>{c, 0, -s, -y, 0, 1, 0, 0, s, 0, c, x}
                                           : std::vector<double>{c, -s, 0, x, s, c, 0, y, 0, 0, 1, 0};
      char cell[40];
      for (double v : m) std::snprintf(cell, sizeof cell, "%.17g ", v), poses += cell;
      poses += "\n";
      times += std::to_string(0.1 * i) + "\n";
    }
    const std::string path = folder.write("poses.txt", poses);
    EXPECT_EQ(
        message_of(import_recording({path}), path),
        "poses.txt: found poses without times, expected a times.txt beside them, --times FILE or --period SECONDS");
    folder.write("times.txt", times);
    const Result<ImportedRecording> imported = import_recording({path});
    ASSERT_TRUE(imported.ok()) << imported.error().message();
    const Track track = truth_track(imported->recording);
    ASSERT_EQ(track.size(), 50u);
    for (int i = 0; i < 50; ++i) {
      const TimedPose& p = track[static_cast<std::size_t>(i)];
      EXPECT_NEAR(p.time_s, 0.1 * i, 1e-12);
      EXPECT_NEAR(p.pose.x_m, 2.0 * std::sin(0.05 * i), 1e-12);
      EXPECT_NEAR(p.pose.y_m, 2.0 - 2.0 * std::cos(0.05 * i), 1e-12);
      EXPECT_NEAR(p.pose.heading_rad, 0.05 * i, 1e-12);
    }
    EXPECT_EQ(imported->warnings.size(), 1u);
  }
}

TEST(Trajectory, WarnsWhereTheBodyLeansOver) {
  ScratchFolder folder;
  const std::string truth = folder.write("truth.txt", "0 0 0 0 0.7071 0 0 0.7071\n1 1 0 0 0.7071 0 0 0.7071\n");
  const Result<ImportedRecording> imported = import_recording({truth});
  ASSERT_TRUE(imported.ok());
  EXPECT_EQ(imported->warnings, std::vector<std::string>{"truth.txt: the body leans over: its axes may not be z up; "
                                                         "--axes y_up or camera says otherwise"});
}

}  // namespace
}  // namespace odolab
