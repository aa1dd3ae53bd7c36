#include <gtest/gtest.h>

#include "test/ui/headless_screen.h"
#include "ui/floor/drawing.h"
#include "ui/floor/lens.h"
#include "ui/panels/floor_panel.h"
#include "ui/panels/floor_view.h"

namespace odolab::ui {
namespace {

Camera camera_of(double px_per_m) {
  Camera c;
  c.low = {100, 50};
  c.high = {900, 650};
  c.px_per_m = px_per_m;
  c.centre = {2.0, 1.0};
  return c;
}

TEST(Camera, MapsTheFloorToTheScreenAndBackWithYUp) {
  const Camera c = camera_of(100.0);
  const ImVec2 middle = c.screen({2.0, 1.0});
  EXPECT_FLOAT_EQ(middle.x, 500.0f);
  EXPECT_FLOAT_EQ(middle.y, 350.0f);
  EXPECT_LT(c.screen({2.0, 2.0}).y, middle.y);
  const Vec2 back = c.floor(c.screen({3.25, -0.5}));
  EXPECT_NEAR(back.x_m, 3.25, 1e-6);  // single precision of the screen at 100 px/m
  EXPECT_NEAR(back.y_m, -0.5, 1e-6);
}

TEST(Camera, ZoomsAboutThePointUnderTheMouse) {
  Camera c = camera_of(100.0);
  const ImVec2 at{700, 200};
  const Vec2 before = c.floor(at);
  c.zoom(at, 3.0);
  EXPECT_NEAR(c.floor(at).x_m, before.x_m, 1e-9);
  EXPECT_NEAR(c.floor(at).y_m, before.y_m, 1e-9);
  EXPECT_DOUBLE_EQ(c.px_per_m, 300.0);
}

TEST(Camera, FitsARectangleInsideItsMargins) {
  Camera c = camera_of(1.0);
  c.fit({0, 0}, {4, 4}, {60, 40, 220, 30});
  const ImVec2 low = c.screen({0, 0}), high = c.screen({4, 4});
  EXPECT_GE(low.x, c.low.x + 60 - 0.01f);
  EXPECT_LE(high.x, c.high.x - 220 + 0.01f);
  EXPECT_GE(high.y, c.low.y + 40 - 0.01f);
  EXPECT_LE(low.y, c.high.y - 30 + 0.01f);
}

TEST(Editing, AnEndOfACableIsPulledWhileTheOtherStays) {
  Floor floor;
  floor.bumps.push_back(new_bump({1.0, 1.0}));
  const auto [first, second] = ends_of(floor.bumps[0]);
  const Floor pulled = dragged(floor, {{ThingKind::bump, 0}, Grip::second_end}, second, {3.0, 2.0});
  const auto [a, b] = ends_of(pulled.bumps[0]);
  EXPECT_NEAR(length(a - first), 0.0, 1e-12);
  EXPECT_NEAR(length(b - Vec2{3.0, 2.0}), 0.0, 1e-12);
}

TEST(Editing, ADiscNeverBecomesSmallerThanAWheel) {
  Floor floor;
  floor.slip_zones.push_back(new_slip_disc({0, 0}));
  const Floor pulled = dragged(floor, {{ThingKind::slip_zone, 0}, Grip::size}, {0.5, 0}, {-3.0, 0});
  EXPECT_GT(std::get<Disc>(pulled.slip_zones[0].shape).radius_m, 0.0);
}

TEST(Editing, TakingAwayAThingThatIsGoneChangesNothing) {
  Floor floor;
  floor.bumps.push_back(new_bump({0, 0}));
  EXPECT_EQ(removed(floor, {ThingKind::bump, 5}).bumps.size(), 1u);
  EXPECT_EQ(removed(floor, {ThingKind::bump, 0}).bumps.size(), 0u);
}

TEST(Lens, MagnifiesByRoundNumbersSoThatTheGapFits) {
  for (double gap_m = 1e-5; gap_m < 500.0; gap_m *= 1.7) {  // a lost robot drives far
    const double m = lens_magnification(gap_m, 100.0, 90.0);
    EXPECT_LE(m, 1000.0);
    EXPECT_LE(gap_m * 100.0 * m, 90.0);  // both ends of the gap are inside
    if (m < 1000.0) {
      EXPECT_GT(gap_m * 100.0 * m,
                0.25 * 90.0);  // and it is not lost in there: 0.7 of the radius, less a round step of 2.5
    }
  }
  EXPECT_DOUBLE_EQ(lens_magnification(0.012, 100.0, 90.0), 50.0);
}

TEST(Exaggerated, MultipliesTheDeviationAlone) {
  const Pose e = exaggerated({1.0, 2.0, 0.1}, {1.01, 1.98, 0.12}, 10.0);
  EXPECT_NEAR(e.x_m, 1.1, 1e-12);
  EXPECT_NEAR(e.y_m, 1.8, 1e-12);
  EXPECT_NEAR(e.heading_rad, 0.3, 1e-12);
}

// A floor with one cable at (1, 1), seen by a view that stays where it is; SetFloor is carried out.
class FloorViewTest : public ::testing::Test {
 protected:
  FloorViewTest() {
    floor.bumps.push_back(new_bump({1.0, 1.0}));
    scene.floor = &floor;
    scene.editable = true;
    scene.planned = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}};
    state.show_lens = false;
    draw = [this] {
      for (const Action& a : floor_view(scene, state, screen.theme))
        if (const SetFloor* set = std::get_if<SetFloor>(&a)) {
          floor = set->floor;
          gestures += set->begins_gesture;
          ++edits;
        }
    };
    screen.picture(draw);
    screen.picture(draw);
    state.touched = true;
  }

  HeadlessScreen screen;
  Floor floor;
  FloorScene scene;
  FloorViewState state;
  std::function<void()> draw;
  int gestures = 0, edits = 0;
};

TEST_F(FloorViewTest, DraggingACableMovesItByTheMousesWay) {
  const ImVec2 from = state.camera.screen({1.0, 1.0}), to = state.camera.screen({2.5, 0.5});
  screen.drag(from, to, draw);
  const double pixel_m = 1.0 / state.camera.px_per_m;
  EXPECT_NEAR(floor.bumps[0].centre.x_m, 2.5, pixel_m);
  EXPECT_NEAR(floor.bumps[0].centre.y_m, 0.5, pixel_m);
  EXPECT_GT(edits, 3);     // it moves while it is dragged
  EXPECT_EQ(gestures, 1);  // and is one step for undo
}

TEST_F(FloorViewTest, DraggingTheFloorMovesTheViewAndNothingElse) {
  const Vec2 centre = state.camera.centre;
  screen.drag(state.camera.screen({3.0, 3.0}), state.camera.screen({2.0, 3.5}), draw);
  EXPECT_EQ(edits, 0);
  EXPECT_NEAR(state.camera.centre.x_m, centre.x_m + 1.0, 0.02);
  EXPECT_NEAR(state.camera.centre.y_m, centre.y_m - 0.5, 0.02);
}

TEST_F(FloorViewTest, AClickWithTheCableToolPutsOneDownThere) {
  state.tool = FloorTool::bump;
  screen.click(state.camera.screen({3.0, 2.0}), draw);
  ASSERT_EQ(floor.bumps.size(), 2u);
  EXPECT_NEAR(floor.bumps[1].centre.x_m, 3.0, 0.02);
  EXPECT_NEAR(floor.bumps[1].centre.y_m, 2.0, 0.02);
  EXPECT_EQ(state.tool, FloorTool::pointer);
  EXPECT_TRUE((state.selected == FloorThing{ThingKind::bump, 1}));
}

TEST_F(FloorViewTest, AFloorThatIsNotEditableStaysAsItIs) {
  scene.editable = false;
  screen.drag(state.camera.screen({1.0, 1.0}), state.camera.screen({2.0, 1.0}), draw);
  EXPECT_EQ(edits, 0);
}

TEST_F(FloorViewTest, TheWheelZoomsAboutTheMouse) {
  const Vec2 target{3.0, 3.0};
  screen.move(state.camera.screen(target));
  screen.picture(draw);
  const ImVec2 at = state.camera.screen(target);
  const double before = state.camera.px_per_m;
  screen.wheel(3.0f);
  screen.picture(draw);
  EXPECT_GT(state.camera.px_per_m, 1.5 * before);
  // The mouse stands on a whole pixel, so up to half of one is magnified as well.
  EXPECT_NEAR(state.camera.screen(target).x, at.x, 1.0);
  EXPECT_NEAR(state.camera.screen(target).y, at.y, 1.0);
}

TEST_F(FloorViewTest, DrawsALongTrackWithoutMorePointsThanTheScreenCanShow) {
  Track track;
  for (int i = 0; i < 200000; ++i)
    track.push_back({0.001 * i, {2.0 + std::cos(1e-4 * i), 2.0 + std::sin(1e-4 * i), 0.0}});
  TrackLine line;
  line.label = "true";
  line.track = &track;
  line.colour = screen.theme.truth;
  scene.tracks = {line};
  int vertices = 0;
  screen.picture([&] {
    draw();
    vertices = ImGui::GetWindowDrawList()->VtxBuffer.Size;
  });
  EXPECT_LT(vertices, 60000);  // 16-bit indices of one draw list
}

TEST(FloorPanel, TheCrossTakesACableAway) {
  HeadlessScreen screen;
  Floor floor;
  floor.bumps.push_back(new_bump({1.0, 1.0}));
  std::optional<FloorThing> selected;
  FloorPanelState state;
  std::optional<Floor> edited;
  const auto content = [&] {
    for (const Action& a : floor_panel(floor, selected, state, {0, 0}, screen.theme))
      if (const SetFloor* set = std::get_if<SetFloor>(&a)) edited = set->floor;
  };
  // The cross stands at the right end of its line: it is looked for from the top.
  for (float y = 20.0f; y < 400.0f && !edited; y += 6.0f) screen.click({292.0f, y}, content, {0, 0}, {316, 600});
  ASSERT_TRUE(edited.has_value());
  EXPECT_TRUE(edited->bumps.empty());
}

}  // namespace
}  // namespace odolab::ui
