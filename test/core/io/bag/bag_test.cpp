#include "core/io/bag/bag.h"

#include <cmath>
#include <cstring>

#include "core/io/import/imported_recording.h"
#include "core/io/recording_csv.h"
#include "source_dir.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

std::string bag(const std::string& name) { return ODOLAB_SOURCE_DIR "/test/recordings/bags/" + name; }

// The messages of a bag, as a line each.
std::vector<std::string> messages_of(const std::string& path, std::vector<std::string>* damage = nullptr) {
  std::vector<std::string> lines;
  const Result<BagFileReading> reading =
      read_bag(path, [&](const BagTopic& topic, std::int64_t log_ns, std::string_view bytes) {
        lines.push_back(topic.name + " " + topic.type + " " + std::to_string(log_ns) + " " + std::string(bytes));
      });
  EXPECT_TRUE(reading.ok()) << reading.error().message();
  if (damage && reading.ok()) *damage = reading->damage;
  return lines;
}

void set_u64(std::string& bytes, std::size_t at, std::uint64_t value) {
  for (int i = 0; i < 8; ++i) bytes[at + static_cast<std::size_t>(i)] = static_cast<char>(value >> (8 * i));
}

// Where the records of an MCAP file begin, found by walking it.
std::vector<std::size_t> records_of(const std::string& file, unsigned char opcode) {
  std::vector<std::size_t> places;
  for (std::size_t at = 8; at + 9 <= file.size();) {
    std::uint64_t size = 0;
    for (int i = 8; i-- > 0;) size = size << 8 | static_cast<unsigned char>(file[at + 1 + static_cast<std::size_t>(i)]);
    if (static_cast<unsigned char>(file[at]) == opcode) places.push_back(at);
    if (size > file.size()) break;
    at += 9 + size;
  }
  return places;
}

class EveryStorage : public testing::TestWithParam<const char*> {};

// test/recordings/README.md: the run by its formulas.
TEST_P(EveryStorage, HoldsTheRun) {
  const Result<ImportedRecording> imported = import_recording({bag(GetParam())});
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  const Recording& r = imported->recording;
  ASSERT_TRUE(problems_in(r).empty());
  // commands have no header: logged 3 ms after the wheels' stamps they make rows of their own
  ASSERT_EQ(r.time_s.size(), 90u);
  int wheels = 0, truths = 0, commands = 0;
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    if (const double left = r.channel("left_wheel_rad")->values[i]; !std::isnan(left)) {
      EXPECT_EQ(r.time_s[i], wheels / 50.0);
      EXPECT_EQ(left, 0.25 * wheels);
      EXPECT_EQ(r.channel("right_wheel_rad")->values[i], 0.5 * wheels);
      ++wheels;
    }
    if (const double x_m = r.channel("truth_x_m")->values[i]; !std::isnan(x_m)) {
      EXPECT_EQ(r.time_s[i], truths / 25.0);
      EXPECT_EQ(x_m, 0.01 * truths);
      EXPECT_EQ(r.channel("truth_y_m")->values[i], -0.02 * truths);
      EXPECT_NEAR(r.channel("truth_heading_rad")->values[i], 0.03 * truths, 1e-15);  // rounding of sine and cosine
      ++truths;
    }
    if (const double v = r.channel("command_speed_mps")->values[i]; !std::isnan(v)) {
      EXPECT_NEAR(r.time_s[i], commands / 25.0 + 0.003, 1e-12);
      EXPECT_EQ(v, 0.2 + 0.001 * commands);
      EXPECT_EQ(r.channel("command_yaw_rate_radps")->values[i], -0.01 * commands);
      ++commands;
    }
  }
  EXPECT_EQ(wheels, 60);
  EXPECT_EQ(truths, 30);
  EXPECT_EQ(commands, 30);
  EXPECT_EQ(imported->warnings,
            std::vector<std::string>{
                "/cmd_vel: all messages stamped by the time they were logged: their type has no stamp of its own"});
}
INSTANTIATE_TEST_SUITE_P(Bag, EveryStorage,
                         testing::Values("plain.mcap", "chunks.mcap", "zstd.mcap", "lz4.mcap", "no_index.mcap",
                                         "big_endian.mcap", "two_files", "two_files/", "packed", "packed.mcap.zstd"));

TEST(Bag, AnUnfinishedFileIsReadUpToItsLastWholeRecord) {
  ScratchFolder folder;
  for (const char* name : {"plain.mcap", "no_index.mcap", "zstd.mcap", "lz4.mcap"}) {
    const std::string whole = text_of(bag(name));
    const std::vector<std::string> all = messages_of(bag(name));
    ASSERT_EQ(all.size(), 120u);
    std::size_t before = 0;
    for (std::size_t size = 8; size < whole.size(); size += 331) {
      std::vector<std::string> damage;
      const std::vector<std::string> some = messages_of(folder.write("cut.mcap", whole.substr(0, size)), &damage);
      ASSERT_LE(some.size(), all.size());
      EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin())) << name << " cut at " << size;
      EXPECT_GE(some.size(), before) << name << " cut at " << size;
      before = some.size();
      if (some.size() < all.size()) {
        EXPECT_EQ(damage.size(), 1u) << name << " cut at " << size;
      }
    }
    EXPECT_GT(before, all.size() - 10) << name;
  }
  // in chunks that are not packed each message that is whole is had: no more than the last one is lost
  const std::string whole = text_of(bag("no_index.mcap"));
  const std::size_t second_chunk = records_of(whole, 0x06).at(1);
  std::vector<std::string> damage;
  const std::size_t first_alone = messages_of(folder.write("a.mcap", whole.substr(0, second_chunk))).size();
  EXPECT_EQ(messages_of(folder.write("b.mcap", whole.substr(0, second_chunk + 1000)), &damage).size(), first_alone + 6);
  EXPECT_EQ(damage,
            std::vector<std::string>{"b.mcap: the file ends within a chunk, at byte " + std::to_string(second_chunk) +
                                     "; every whole record before its end was read"});
}

TEST(Bag, ADamagedChunkIsLeftOutAndTheRestIsRead) {
  ScratchFolder folder;
  for (const char* name : {"chunks.mcap", "zstd.mcap", "lz4.mcap"}) {
    std::string file = text_of(bag(name));
    const std::size_t at = records_of(file, 0x06).at(1);
    file[at + 600] = static_cast<char>(file[at + 600] ^ 0x10);
    std::vector<std::string> damage;
    const std::vector<std::string> some = messages_of(folder.write(name, file), &damage);
    EXPECT_LT(some.size(), 120u);
    EXPECT_GT(some.size(), 60u);
    ASSERT_EQ(damage.size(), 2u) << name;  // the chunk's checksum, and the one over all data
    EXPECT_NE(damage[0].find("the chunk at byte " + std::to_string(at) + " was left out"), std::string::npos);
  }
}

TEST(Bag, SizesThatCannotBeAreNotFollowed) {
  ScratchFolder folder;
  const std::string whole = text_of(bag("chunks.mcap"));
  const std::size_t chunk = records_of(whole, 0x06).at(1);
  // the chunk's record, what it says it holds unpacked, and its inner size
  for (const std::size_t place : {chunk + 1, chunk + 9 + 16, chunk + 9 + 16 + 8 + 4 + 4})
    for (const std::uint64_t size : {~0ull, 1ull << 62, 1ull << 40, 3ull, 0ull}) {
      std::string file = whole;
      set_u64(file, place, size);
      std::vector<std::string> damage;
      const std::vector<std::string> some = messages_of(folder.write("sizes.mcap", file), &damage);
      EXPECT_GE(damage.size(), 1u) << place - chunk << " " << size;
      // the index leads on to the third chunk
      EXPECT_GT(some.size(), 60u) << place - chunk << " " << size;
      EXPECT_LT(some.size(), 120u) << place - chunk << " " << size;
    }
}

TEST(Bag, ACutDatabaseGivesWhatCanBeRead) {
  ScratchFolder folder;
  const std::string whole = text_of(bag("two_files/two_files_0.db3"));
  const std::size_t all = messages_of(bag("two_files/two_files_0.db3")).size();
  EXPECT_EQ(all, 60u);
  for (std::size_t pages = 1; pages < whole.size() / 4096; ++pages) {
    const std::string path = folder.write("cut.db3", whole.substr(0, 4096 * pages + 100));
    std::size_t some = 0;
    const Result<BagFileReading> reading =
        read_bag(path, [&](const BagTopic&, std::int64_t, std::string_view) { ++some; });
    if (!reading) {
      EXPECT_NE(reading.error().message().find("cut.db3: found "), std::string::npos);
    } else if (some < all) {
      ASSERT_FALSE(reading->damage.empty());
    }
  }
}

TEST(Bag, SaysInOneLineWhatIsNoBag) {
  ScratchFolder folder;
  const auto complaint = [&](const std::string& path) {
    return message_of(import_recording({path}), folder.path("x"));
  };
  EXPECT_EQ(complaint(folder.write("empty.mcap", "")), "empty.mcap: found an empty file, expected an MCAP file");
  EXPECT_EQ(complaint(folder.write("text.db3", "hello")),
            "text.db3: found other first bytes, expected an SQLite database, as rosbag2 writes it");
  EXPECT_EQ(complaint(folder.write("a.mcap.zstd", "x")),
            "a.mcap.zstd: found other first bytes, expected a file packed by zstd");
  EXPECT_EQ(complaint(folder.write("none.mcap", std::string("\x89MCAP0\r\n", 8))),
            "none.mcap: found a bag without topics, expected joint states, twists, odometry, poses or transforms with "
            "messages, in CDR");
}

TEST(Bag, ListsTopicsJointsAndTransforms) {
  const Result<BagContents> contents = contents_of_bag(bag("every_type.mcap"));
  ASSERT_TRUE(contents.ok());
  ASSERT_EQ(contents->topics.size(), 9u);
  EXPECT_TRUE(contents->damage.empty());
  for (const BagTopicContents& topic : contents->topics) {
    EXPECT_NE(topic.kind, RosKind::other) << topic.topic.name;
    EXPECT_EQ(topic.messages, topic.topic.name == "/joint_states" ? 60u : 30u);
    if (topic.topic.name == "/joint_states") {
      EXPECT_EQ(topic.joints, (std::vector<std::string>{"arm_joint", "wheel_right_joint", "wheel_left_joint"}));
    } else if (topic.topic.name == "/tf") {
      ASSERT_EQ(topic.transforms.size(), 2u);
      EXPECT_EQ(topic.transforms[0].parent + ">" + topic.transforms[0].child, "odom>base_link");
      EXPECT_EQ(topic.transforms[1].parent + ">" + topic.transforms[1].child, "world>marker_body");
      EXPECT_EQ(topic.transforms[1].messages, 30u);
    }
  }
}

// Each type carries the same poses and commands.
TEST(Bag, EveryTypeOfTruthAndCommandIsRead) {
  const std::string path = bag("every_type.mcap");
  for (const char* truth : {"/mocap/pose", "/odom", "/tracked", "/vicon/robot", "/tf:world:marker_body"})
    for (const char* commands : {"/cmd_vel", "/teleop"}) {
      ImportWishes wishes;
      wishes.truth = truth;
      wishes.commands = commands;
      const Result<ImportedRecording> imported = import_recording({path}, wishes);
      ASSERT_TRUE(imported.ok()) << imported.error().message();
      const std::vector<TruthSample> poses = truth_samples(imported->recording);
      ASSERT_EQ(poses.size(), 30u) << truth;
      EXPECT_EQ(poses[7].position.y_m, -0.02 * 7);
      EXPECT_NEAR(*poses[7].heading_rad, 0.03 * 7, 1e-15);
      const std::vector<CommandSample> twists = command_samples(imported->recording);
      ASSERT_EQ(twists.size(), 30u) << commands;
      EXPECT_EQ(twists[9].speed_mps, 0.2 + 0.001 * 9);
      EXPECT_EQ(twists[9].yaw_rate_radps, -0.01 * 9);
    }
}

// test/recordings/README.md: three hops at rates of their own, one of them static, whose product is the run's truth.
TEST(Bag, PutsAChainOfTransformsTogether) {
  ImportWishes wishes;
  wishes.truth = "/tf:map:base_link";
  const Result<ImportedRecording> imported = import_recording({bag("tf_chain.mcap")}, wishes);
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  const Recording& r = imported->recording;
  // map to odom ends at 1.0 s: nothing is made up behind it
  const std::vector<TruthSample> poses = truth_samples(r);
  ASSERT_EQ(poses.size(), 51u);
  EXPECT_EQ(imported->warnings.back(),
            "/tf:map:base_link: 9 poses left out: another transform of the chain is missing there");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double half = 0.5 * static_cast<double>(i);
    EXPECT_EQ(poses[i].time_s, static_cast<double>(i) / 50.0);
    // rounding of some ten products of numbers below 3
    EXPECT_NEAR(poses[i].position.x_m, 0.01 * half, 1e-14);
    EXPECT_NEAR(poses[i].position.y_m, -0.02 * half, 1e-14);
    EXPECT_NEAR(*poses[i].heading_rad, 0.03 * half, 1e-14);
  }
  // upward it is the inverse: at the start the truth is zero, and so is its inverse
  wishes.truth = "/tf:base_link:map";
  const Result<ImportedRecording> upward = import_recording({bag("tf_chain.mcap")}, wishes);
  ASSERT_TRUE(upward.ok());
  const TruthSample last = truth_samples(upward->recording).back();
  const Pose truth{0.25, -0.5, 0.75};
  EXPECT_NEAR(*last.heading_rad, -0.75, 1e-14);
  EXPECT_NEAR(length(truth * last.position), 0.0, 1e-14);
  wishes.truth = "/tf:map:gripper";
  EXPECT_NE(import_recording({bag("tf_chain.mcap")}, wishes)
                .error()
                .message()
                .find("found no chain of transforms from 'map' to 'gripper' on '/tf'"),
            std::string::npos);
}

TEST(Bag, APackedFileThatIsCutGivesWhatCanBeUnpacked) {
  ScratchFolder folder;
  const std::string whole = text_of(bag("packed.mcap.zstd"));
  std::size_t before = 0;
  for (std::size_t size = 100; size < whole.size(); size += 97) {
    std::size_t some = 0;
    const Result<BagFileReading> reading = read_bag(folder.write("cut.mcap.zstd", whole.substr(0, size)),
                                                    [&](const BagTopic&, std::int64_t, std::string_view) { ++some; });
    EXPECT_GE(some, before);
    before = some;
    if (reading.ok()) {
      EXPECT_EQ(reading->damage.front(), "cut.mcap.zstd: the packed file is cut; what could be unpacked was read");
    } else {
      EXPECT_EQ(some, 0u);
    }
  }
  std::string broken = whole;
  broken[whole.size() / 2] = static_cast<char>(broken[whole.size() / 2] ^ 0x55);
  // one block holds it all
  EXPECT_EQ(message_of(read_bag(folder.write("broken.mcap.zstd", broken), {}), folder.path("x")).substr(0, 60),
            "broken.mcap.zstd: found nothing that can be unpacked (zstd: ");
}

// A folder in which somebody unpacked a file beside the packed one holds it once.
TEST(Bag, AnUnpackedFileBesideItsPackedOneIsReadOnce) {
  ScratchFolder folder;
  folder.write("a_0.mcap.zstd", text_of(bag("packed.mcap.zstd")));
  EXPECT_EQ(messages_of(folder.path("")).size(), 120u);
  folder.write("a_0.mcap", text_of(bag("plain.mcap")));
  EXPECT_EQ(messages_of(folder.path("")).size(), 120u);
}

TEST(Bag, StopsWhenItIsAskedTo) {
  ScratchFolder folder;
  const auto stop = [](double) { return false; };
  EXPECT_FALSE(import_into_csv({bag("zstd.mcap")}, {}, folder.path("file.csv"), stop).ok());
  EXPECT_FALSE(import_into_csv({bag("packed")}, {}, folder.path("file.csv"), stop).ok());
  EXPECT_EQ(folder.files(), 0u);
}

TEST(Bag, StraightIntoAFileGivesTheSameBytes) {
  ScratchFolder folder;
  const Result<ImportedRecording> imported = import_recording({bag("zstd.mcap")});
  ASSERT_TRUE(imported.ok());
  ASSERT_TRUE(write_recording_csv(folder.path("memory.csv"), imported->recording).ok());
  ASSERT_TRUE(import_into_csv({bag("zstd.mcap")}, {}, folder.path("file.csv")).ok());
  EXPECT_EQ(text_of(folder.path("memory.csv")), text_of(folder.path("file.csv")));
  EXPECT_EQ(folder.files(), 2u);
}

}  // namespace
}  // namespace odolab
