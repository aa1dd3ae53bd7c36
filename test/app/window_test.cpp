#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "app/gui/gui.h"
#include "app/gui/jobs.h"
#include "app/gui/settings.h"

namespace odolab {
namespace {

std::string temporary(const std::string& name) { return (std::filesystem::temp_directory_path() / name).string(); }

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Jobs, DeliverOnlyWhenPolledAndOneRunsAtATime) {
  Jobs jobs(true);
  std::atomic<bool> go{false};
  int delivered = 0;
  bool finished = false;
  ASSERT_TRUE(jobs.start(
      "waiting",
      [&](const Progress& progress, const Jobs::Deliver& deliver) {
        deliver([&] { ++delivered; });
        while (!go && progress(0.5)) std::this_thread::yield();
      },
      [&](bool cancelled) { finished = !cancelled; }));
  EXPECT_FALSE(jobs.start("another", [](const Progress&, const Jobs::Deliver&) {}));
  EXPECT_TRUE(jobs.running());
  go = true;
  while (jobs.running()) jobs.poll();
  EXPECT_EQ(delivered, 1);
  EXPECT_TRUE(finished);
}

TEST(Jobs, StopWhereTheyAreCancelled) {
  Jobs jobs(true);
  bool was_cancelled = false;
  jobs.start(
      "endless",
      [](const Progress& progress, const Jobs::Deliver&) {
        while (progress(0.1)) std::this_thread::yield();
      },
      [&](bool cancelled) { was_cancelled = cancelled; });
  jobs.cancel();
  while (jobs.running()) jobs.poll();
  EXPECT_TRUE(was_cancelled);
}

TEST(Settings, ComeBackAsTheyWereWritten) {
  const std::string path = temporary("odolab_settings_test/window");
  Settings s;
  s.dark = true;
  s.scale = 1.5;
  s.width = 1600;
  s.left_width = 333.0;
  s.welcome_seen = true;
  s.recent_files = {"/a/b c.toml", "/d.csv"};
  write_settings(path, s);
  const Settings read = read_settings(path);
  EXPECT_TRUE(read.dark);
  EXPECT_DOUBLE_EQ(read.scale, 1.5);
  EXPECT_EQ(read.width, 1600);
  EXPECT_DOUBLE_EQ(read.left_width, 333.0);
  EXPECT_TRUE(read.welcome_seen);
  EXPECT_EQ(read.recent_files, s.recent_files);
  std::filesystem::remove_all(temporary("odolab_settings_test"));
}

TEST(Settings, OfADamagedFileAreTheDefaultsWithinBounds) {
  const std::string path = temporary("odolab_settings_damaged");
  std::ofstream(path) << "width banana\nheight -4\nscale 1e9\nnonsense 3\n\n";
  const Settings read = read_settings(path);
  EXPECT_EQ(read.width, 1280);
  EXPECT_GE(read.height, 320);
  EXPECT_LE(read.scale, 4.0);
  std::filesystem::remove(path);
}

TEST(Gui, AnUnknownModeIsBadUsage) {
  GuiOptions options;
  options.mode = "dance";
  options.screenshot_path = temporary("odolab_never.png");
  EXPECT_EQ(run_gui(options), 2);
  EXPECT_FALSE(std::filesystem::exists(options.screenshot_path));
}

TEST(Gui, AFileThatIsNotThereIsBadInputForAPictureAndLeavesNone) {
  GuiOptions options;
  options.files = {"/no/such/scenario.toml"};
  options.screenshot_path = temporary("odolab_never.png");
  EXPECT_EQ(run_gui(options), 2);
  EXPECT_FALSE(std::filesystem::exists(options.screenshot_path));
}

TEST(Gui, TwoPicturesOfTheSameRunAreTheSameToTheByte) {
  if (!std::getenv("DISPLAY")) GTEST_SKIP() << "no display: run under xvfb-run to draw a window";
  std::string first;
  for (const char* mode : {"drive", "drive"}) {
    GuiOptions options;
    options.mode = mode;
    options.frames = 20;
    options.screenshot_path = temporary("odolab_window_test.png");
    ASSERT_EQ(run_gui(options), 0);
    const std::string picture = content_of(options.screenshot_path);
    EXPECT_GT(picture.size(), 20000u);  // an empty window compresses to a few thousand bytes
    if (first.empty())
      first = picture;
    else
      EXPECT_TRUE(picture == first);
  }
  std::filesystem::remove(temporary("odolab_window_test.png"));
}

}  // namespace
}  // namespace odolab
