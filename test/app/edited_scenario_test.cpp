#include "app/gui/edited_scenario.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "app/gui/session.h"
#include "test/app/always.h"

namespace odolab {
namespace {

namespace fs = std::filesystem;

class EditedScenarioTest : public ::testing::Test {
 protected:
  ~EditedScenarioTest() override { fs::remove_all(folder); }
  std::string folder = (fs::temp_directory_path() / ("odolab_edited_" + std::to_string(::getpid()))).string();
  std::string path = folder + "/data/edited.toml";
};

TEST_F(EditedScenarioTest, LosesAtMostASecondOfEditsWhenKilled) {
  Floor floor;
  {
    Session session(false, "", path);
    floor = session.run().scenario().floor;
    floor.friction = 0.37;
    session.execute(ui::SetFloor{floor, true});
    Scenario scenario = session.run().scenario();
    scenario.path = FigureEightPath{1.25, 3};
    scenario.name = "Eights of mine";
    session.execute(ui::EditScenario{scenario});
    session.advance(0.9, kAlways);
  }  // gone without a word
  Session again(false, "", path);
  again.take_up_edits();
  EXPECT_EQ(again.run().scenario().name, "Eights of mine");
  EXPECT_EQ(std::get<FigureEightPath>(again.run().scenario().path).radius_m, 1.25);
  EXPECT_EQ(again.run().scenario().floor.friction, 0.37);
  ASSERT_FALSE(again.messages().empty());
}

TEST_F(EditedScenarioTest, WhatAnUndoTakesBackIsNotKeptEither) {
  Session session(false, "", path);
  Floor floor = session.run().scenario().floor;
  const double before = floor.friction;
  floor.friction = 0.37;
  session.execute(ui::SetFloor{floor, true});
  session.advance(0.9, kAlways);
  session.execute(ui::Undo{});
  session.advance(0.9, kAlways);
  Session again(false, "", path);
  again.take_up_edits();
  EXPECT_EQ(again.run().scenario().floor.friction, before);
}

TEST_F(EditedScenarioTest, IsForgottenOnceItIsSavedOrAnotherIsOpened) {
  Session session(false, "", path);
  Floor floor = session.run().scenario().floor;
  for (const bool saved : {true, false}) {
    floor.friction -= 0.05;
    session.execute(ui::SetFloor{floor, true});
    session.advance(0.9, kAlways);
    EXPECT_TRUE(fs::exists(path));
    if (saved)
      session.execute(ui::SaveScenario{folder + "/mine.toml"});
    else
      session.execute(ui::LoadFirstScenario{});
    session.advance(0.9, kAlways);
    EXPECT_FALSE(fs::exists(path));
  }
}

TEST_F(EditedScenarioTest, ADamagedOneIsAMessageAndTheFirstScenarioOpens) {
  fs::create_directories(folder + "/data");
  std::ofstream(path) << "name = \"half a li";
  Session session(false, "", path);
  session.take_up_edits();
  ASSERT_FALSE(session.messages().empty());
  EXPECT_TRUE(session.messages().back().is_error);
  EXPECT_FALSE(session.run().scenario().name.empty());
}

}  // namespace
}  // namespace odolab
