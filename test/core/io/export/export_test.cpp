#include <cmath>

#include "core/io/export/plotjuggler_csv.h"
#include "core/io/export/tum_text.h"
#include "core/io/import/imported_recording.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

TEST(Export, ATumTrajectoryReadsBackAsTheSameTruth) {
  ScratchFolder folder;
  Track track;
  for (int i = 0; i < 200; ++i) track.push_back({0.1 * i, {std::sin(0.1 * i), -0.3 * i, 0.09 * i}});
  ASSERT_TRUE(write_tum(folder.path("t.tum"), track).ok());
  EXPECT_EQ(text_of(folder.path("t.tum")).substr(0, 54), "# timestamp tx ty tz qx qy qz qw\n0 0 -0 0 0 0 0 1\n0.1 ");
  const Result<ImportedRecording> back = import_recording({folder.path("t.tum")});
  ASSERT_TRUE(back.ok()) << back.error().message();
  const Track again = truth_track(back->recording);
  ASSERT_EQ(again.size(), track.size());
  for (std::size_t i = 0; i < track.size(); ++i) {
    EXPECT_NEAR(again[i].time_s, track[i].time_s, 0.5e-9);  // stamps are whole nanoseconds
    EXPECT_EQ(again[i].pose.x_m, track[i].pose.x_m);
    EXPECT_EQ(again[i].pose.y_m, track[i].pose.y_m);
    EXPECT_NEAR(again[i].pose.heading_rad, track[i].pose.heading_rad, 1e-14);  // unwrapped again, over 18 rad
  }
}

TEST(Export, PlotJugglerGetsGroupsEmptyCellsAndDecimalPoints) {
  ScratchFolder folder;
  Recording recording;
  recording.time_s = {0.0, 0.5};
  recording.channels = {{"left_wheel_rad", {1.0, std::nan("")}},
                        {"truth_x_m", {std::nan(""), 1e-7}},
                        {"castor1_pivot_rad", {2.0, 0.25}},
                        {"hitch_angle_rad", {0.0, 0.0}}};
  ASSERT_TRUE(write_plotjuggler_csv(folder.path("p.csv"), recording).ok());
  EXPECT_EQ(text_of(folder.path("p.csv")),
            "time_s,wheels/left_wheel_rad,truth/x_m,castor1/pivot_rad,hitch_angle_rad\n0.0,1.0,,2.0,0.0\n"
            "0.5,,1.0e-07,0.25,0.0\n");
}

}  // namespace
}  // namespace odolab
