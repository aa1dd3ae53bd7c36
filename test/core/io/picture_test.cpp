#include <algorithm>
#include <cmath>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "core/base/valid_utf8.h"
#include "core/io/picture/axis.h"
#include "core/io/picture/coloured_track_picture.h"
#include "core/io/picture/line_picture.h"
#include "core/io/picture/scatter_picture.h"
#include "core/io/picture/track_picture.h"
#include "core/io/report_html.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

// Every element that is opened is closed, in order. (Attributes hold no '<' or '>': they are escaped.)
bool is_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  std::size_t tags = 0;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1), ++tags) {
    const std::size_t end = xml.find_first_of("<>", at + 1);
    if (end == std::string::npos || xml[end] == '<') return false;
    const bool closing = xml[at + 1] == '/';
    const std::size_t name = at + (closing ? 2 : 1);
    const std::string element = xml.substr(name, std::min(xml.find_first_of(" />\n", name), end) - name);
    if (closing) {
      if (open.empty() || open.back() != element) return false;
      open.pop_back();
    } else if (xml[end - 1] != '/') {
      if (std::count(xml.begin() + at, xml.begin() + end, '"') % 2 != 0) return false;
      open.push_back(element);
    }
  }
  return tags > 0 && open.empty();
}

// The points of the first polyline in a picture.
std::vector<Point> first_polyline(const std::string& svg) {
  const std::size_t from = svg.find("<polyline points=\"") + 18;
  std::vector<Point> points;
  const char* at = svg.c_str() + from;
  while (*at && *at != '"') {
    char* end;
    Point p;
    p.x = std::strtod(at, &end);
    p.y = std::strtod(end + 1, &end);
    points.push_back(p);
    at = *end == ' ' ? end + 1 : end;
  }
  return points;
}

TrackPicture square_with_everything() {
  TrackPicture picture;
  picture.title = "Square <4 m> & bumps";
  Track square;
  for (Vec2 corner : {Vec2{0, 0}, Vec2{4, 0}, Vec2{4, 4}, Vec2{0, 4}, Vec2{0, 0}})
    square.push_back({static_cast<double>(square.size()), {corner.x_m, corner.y_m, 0.0}});
  picture.tracks.push_back({"truth", square, Look::truth});
  for (TimedPose& p : square) p.pose = Pose{0, 0, 0.05} * p.pose;
  picture.tracks.push_back({"odometry", square, Look::estimate});
  picture.floor.bumps.push_back({{2.0, 0.0}});
  picture.floor.slip_zones.push_back({Disc{{4.0, 2.0}, 0.6}, 0.2, 0.1});
  picture.floor.slip_zones.push_back({Polygon{{{0, 3}, {1, 3}, {1, 4}}}, 0.2, 0.1});
  return picture;
}

TEST(TrackPicture, HasEqualAxesAndAllThatLiesOnTheFloor) {
  const std::string svg = track_picture(square_with_everything());
  EXPECT_TRUE(is_well_formed(svg));
  const std::vector<Point> square = first_polyline(svg);
  ASSERT_EQ(square.size(), 5u);
  const double across = square[1].x - square[0].x, up = square[1].y - square[2].y;
  EXPECT_GT(across, 300.0);         // of 700 pixels
  EXPECT_NEAR(across, up, 0.2001);  // coordinates are rounded to a tenth of a pixel
  EXPECT_NE(svg.find("Square &lt;4 m&gt; &amp; bumps"), std::string::npos);
  EXPECT_EQ(count(svg, "<polyline"), 2u);
  EXPECT_EQ(count(svg, "stroke-dasharray=\"7 4\""), 2u);  // the estimate and its place in the legend
  EXPECT_EQ(count(svg, "slip zone"), 1u);
  EXPECT_EQ(count(svg, ">1 m<") + count(svg, ">2 m<"), 1u);  // the scale bar
}

TEST(TrackPicture, AnEmptyOneIsAPictureToo) {
  EXPECT_TRUE(is_well_formed(track_picture({})));
  EXPECT_TRUE(is_well_formed(scatter_picture({})));
  EXPECT_TRUE(is_well_formed(line_picture({})));
}

TEST(ScatterPicture, DrawsEachRunAndBothCentres) {
  ScatterPicture picture;
  picture.title = "Return errors";
  UmbmarkRuns runs;
  for (int i = 0; i < 5; ++i) {
    runs.clockwise.push_back({0.3 + 0.01 * i, 0.2, 0.0});
    runs.counter_clockwise.push_back({-0.1, -0.2 + 0.01 * i, 0.0});
  }
  picture.experiments.push_back({"", runs});
  const std::string svg = scatter_picture(picture);
  EXPECT_TRUE(is_well_formed(svg));
  EXPECT_EQ(count(svg, "<circle"), 5u + 1u);              // clockwise runs, legend
  EXPECT_EQ(count(svg, "fill=\"#0072B2\""), 5u + 1u);     // blue squares: counter-clockwise runs, legend
  EXPECT_NE(svg.find("cw: 377 mm"), std::string::npos);   // hypot(320, 200)
  EXPECT_NE(svg.find("ccw: 206 mm"), std::string::npos);  // hypot(100, 180)
}

TEST(ScatterPicture, DrawsBeforeOpenAndAfterFilledAndLeavesOutWhatLiesBetween) {
  ScatterPicture picture;
  UmbmarkRuns runs;
  runs.clockwise = {{0.3, 0.2, 0.0}, {0.31, 0.2, 0.0}};
  runs.counter_clockwise = {{-0.1, -0.2, 0.0}, {-0.1, -0.21, 0.0}};
  picture.experiments = {{"before", runs}, {"between", runs}, {"after", runs}};
  const std::string svg = scatter_picture(picture);
  EXPECT_EQ(count(svg, "between"), 0u);
  EXPECT_EQ(count(svg, "fill=\"#D55E00\""), 2u + 1u);  // after: discs and legend
  EXPECT_EQ(count(svg, "fill=\"#0072B2\""), 2u + 1u);
  EXPECT_EQ(count(svg, "<circle"), 2u * (2u + 1u));  // before and after
}

TEST(LinePicture, KeepsPeaksHoweverManySamplesThereAre) {
  LinePicture picture;
  DrawnLine line;
  for (int i = 0; i < 200000; ++i) {
    line.x.push_back(0.001 * i);
    line.y.push_back(i == 123456 ? 5.0 : std::sin(0.01 * i));
  }
  line.label = "yaw rate";
  picture.lines.push_back(line);
  const std::string svg = line_picture(picture);
  EXPECT_TRUE(is_well_formed(svg));
  EXPECT_LT(svg.size(), 100000u);  // four points for each of 800 columns
  const std::vector<Point> points = first_polyline(svg);
  double top = 1e9, bottom = -1e9;
  for (Point p : points) top = std::min(top, p.y), bottom = std::max(bottom, p.y);
  // from -1 to 5 with air of 6 % at both ends on 248 pixels, the peak is where it belongs
  EXPECT_NEAR(bottom - top, 248.0 / 1.12, 0.2);
}

TEST(ColouredTrackPicture, LeavesNoGapWhereOnlyOneSampleIsOff) {
  ColouredTrackPicture picture;
  for (int i = 0; i <= 4000; ++i) {  // 4 m, a tenth of a pixel from one sample to the next
    picture.track.x_m.push_back(0.001 * i);
    picture.track.y_m.push_back(0.0);
    picture.track.times_noise.push_back(i == 2000 ? 2.5 : 1.0);
  }
  const std::string svg = coloured_track_picture(picture);
  const std::regex polyline("<polyline points=\"([^\"]*)\"");
  std::vector<std::pair<double, double>> drawn;  // from, to along the line
  for (std::sregex_iterator it(svg.begin(), svg.end(), polyline), end; it != end; ++it) {
    const std::string points = (*it)[1];
    drawn.emplace_back(std::stod(points), std::stod(points.substr(points.rfind(' ') + 1)));
  }
  std::sort(drawn.begin(), drawn.end());
  ASSERT_EQ(drawn.size(), 3u);
  for (std::size_t k = 0; k + 1 < drawn.size(); ++k) EXPECT_GE(drawn[k].second, drawn[k + 1].first);
}

TEST(LinePicture, LeavesAGapWhereThereIsNoValue) {
  LinePicture picture;
  picture.lines.push_back({"", {0, 1, 2, 3, 4}, {1, 1, std::nan(""), 1, 1}, Look::second});
  EXPECT_EQ(count(line_picture(picture), "<polyline"), 2u);
}

TEST(Axis, HasRoundTicks) {
  EXPECT_EQ(round_step(10.0, 5), 2.0);
  EXPECT_EQ(round_step(0.07, 7), 0.01);
  EXPECT_EQ(round_step(3.0, 7), 0.5);
  EXPECT_EQ((Axis{-0.3, 2.1, 0, 100}.ticks(3)), (std::vector<double>{0.0, 1.0, 2.0}));
  EXPECT_EQ(tick_text(0.25, 0.05), "0.25");
  EXPECT_EQ(tick_text(-2.0, 1.0),
            "\xE2\x88\x92"
            "2");
  EXPECT_EQ(tick_text(1e-17, 0.1), "0.0");
}

TEST(ReportHtml, IsOnePageThatNeedsNothingElse) {
  HtmlReport report("Calibration <LabMate>");
  report.heading("What was found");
  report.paragraph("a < b & c");
  report.table({"parameter", "nominal", "calibrated"}, {{"wheelbase_m", "0.340", "0.3412"}, {"short row"}});
  report.picture(track_picture(square_with_everything()), "The square");
  report.picture(line_picture({}));
  const std::string html = report.text();
  EXPECT_TRUE(is_well_formed(html.substr(html.find("<body>"), html.find("</html>") - html.find("<body>"))));
  EXPECT_NE(html.find("<title>Calibration &lt;LabMate&gt;</title>"), std::string::npos);
  EXPECT_NE(html.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_EQ(count(html, "<td>"), 6u);
  EXPECT_EQ(html.find("src="), std::string::npos);
  EXPECT_EQ(html.find("href="), std::string::npos);
}

// What it says of itself, whatever bytes the name of a recording has.
TEST(ReportHtml, IsUtf8WhateverBytesATextHas) {
  HtmlReport report("caf\xE9.csv");
  report.table({"recording"}, {{"na\xEFve & caf\xE9"}});
  TrackPicture picture = square_with_everything();
  picture.title = "caf\xE9";
  report.picture(track_picture(picture));
  EXPECT_EQ(report.text(), valid_utf8(report.text()));
  EXPECT_NE(report.text().find("na\xEF\xBF\xBDve &amp; caf\xEF\xBF\xBD"), std::string::npos);
}

}  // namespace
}  // namespace odolab
