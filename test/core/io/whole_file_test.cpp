#include "core/io/whole_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "test/core/io/files.h"

namespace odolab {
namespace {

namespace fs = std::filesystem;

TEST(WholeFile, WritesWhatALinkLeadsToAndLeavesTheLink) {
  const ScratchFolder folder;
  folder.write("real/old.json", "old");
  fs::create_symlink("real/old.json", folder.path("link"));  // as seen from the link's own folder
  fs::create_symlink("link", folder.path("link_of_link"));
  ASSERT_TRUE(write_whole_file(folder.path("link_of_link"), "new").ok());
  EXPECT_TRUE(fs::is_symlink(folder.path("link")));
  EXPECT_TRUE(fs::is_symlink(folder.path("link_of_link")));
  EXPECT_FALSE(fs::is_symlink(folder.path("real/old.json")));
  EXPECT_EQ(text_of(folder.path("real/old.json")), "new");
  EXPECT_EQ(folder.files(), 3u) << "nothing is left beside them";
}

TEST(WholeFile, MakesWhatALinkLeadsToWhereItIsNotThereYet) {
  const ScratchFolder folder;
  fs::create_symlink(folder.path("later/file"), folder.path("link"));
  ASSERT_TRUE(write_whole_file(folder.path("link"), "text").ok());
  EXPECT_TRUE(fs::is_symlink(folder.path("link")));
  EXPECT_EQ(text_of(folder.path("later/file")), "text");
}

TEST(WholeFile, RefusesLinksThatLeadToEachOther) {
  const ScratchFolder folder;
  fs::create_symlink("b", folder.path("a"));
  fs::create_symlink("a", folder.path("b"));
  const Result<Done> written = write_whole_file(folder.path("a"), "text");
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().found, "too many levels of symbolic links");
  EXPECT_TRUE(fs::is_symlink(folder.path("a")));
}

// As `--json /dev/stdout > file` has it: what is open is written on, and neither replaced nor emptied.
TEST(WholeFile, WritesOnWhatIsOpenAlready) {
  const ScratchFolder folder;
  const int open = ::open(folder.path("redirected").c_str(), O_WRONLY | O_CREAT, 0644);
  ASSERT_GE(open, 0);
  ASSERT_EQ(::write(open, "before ", 7), 7);
  const std::string by_number = "/proc/self/fd/" + std::to_string(open);
  fs::create_symlink(by_number, folder.path("as_dev_stdout"));
  ASSERT_TRUE(write_whole_file(folder.path("as_dev_stdout"), "between ").ok());
  ASSERT_TRUE(write_whole_file(by_number, "and ").ok());
  ASSERT_EQ(::write(open, "after", 5), 5);
  ::close(open);
  EXPECT_TRUE(fs::is_symlink(folder.path("as_dev_stdout")));
  EXPECT_EQ(text_of(folder.path("redirected")), "before between and after");
  EXPECT_EQ(folder.files(), 2u);
}

TEST(WholeFile, WritesStraightThroughALinkToAPipe) {
  const ScratchFolder folder;
  ASSERT_EQ(::mkfifo(folder.path("pipe").c_str(), 0644), 0);
  fs::create_symlink("pipe", folder.path("link"));
  std::string heard;
  std::thread listener([&] { heard = text_of(folder.path("pipe")); });
  const bool written = write_whole_file(folder.path("link"), "text").ok();
  listener.join();
  EXPECT_TRUE(written);
  EXPECT_EQ(heard, "text");
  EXPECT_TRUE(fs::is_fifo(folder.path("pipe")));
  EXPECT_TRUE(fs::is_symlink(folder.path("link")));
}

TEST(WholeFile, TellsBeforehandWhatCannotBeWrittenAndLeavesNothing) {
  const ScratchFolder folder;
  folder.write("file", "kept");
  EXPECT_EQ(unwritable(folder.path("file")), std::nullopt);
  EXPECT_EQ(unwritable(folder.path("new/folder/file")), std::nullopt);
  EXPECT_EQ(unwritable("/dev/null"), std::nullopt);
  EXPECT_EQ(text_of(folder.path("file")), "kept");
  EXPECT_EQ(folder.files(), 1u);
  const auto found = [](const std::string& path) { return unwritable(path).value_or(Error{}).found; };
  EXPECT_EQ(found(folder.path("")), "a folder");
  EXPECT_EQ(found(folder.path("file/below")), "not a directory");
  EXPECT_NE(found("/proc/odolab.json"), "");  // even for root
  EXPECT_EQ(found(folder.path(std::string(300, 'n'))), "file name too long");
}

TEST(WholeFile, PutsAsideWhereTheFileIsMade) {
  const ScratchFolder folder;
  fs::create_symlink("real/file", folder.path("link"));
  EXPECT_EQ(spill_folder_of(folder.path("link")), folder.path("real"));
  EXPECT_EQ(spill_folder_of("file"), ".");
  EXPECT_EQ(spill_folder_of("/dev/null"), fs::temp_directory_path());
}

}  // namespace
}  // namespace odolab
