// How fast a ROS 2 bag comes in, beside a plain read of the same file.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/io/import/imported_recording.h"

namespace odolab {
namespace {

void put(std::string& bytes, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i));
}
void put_text(std::string& bytes, const std::string& text) {
  put(bytes, text.size(), 4);
  bytes += text;
}
std::string record(unsigned char opcode, const std::string& content) {
  std::string bytes(1, static_cast<char>(opcode));
  put(bytes, content.size(), 8);
  return bytes + content;
}

// CDR, least significant byte first; positions count from behind the four bytes that announce it.
struct Cdr {
  std::string bytes = std::string("\0\1\0\0", 4);
  void align(std::size_t to) {
    while ((bytes.size() - 4) % to != 0) bytes += '\0';
  }
  void u32(std::uint32_t value) {
    align(4);
    put(bytes, value, 4);
  }
  void text(const std::string& value) {
    u32(static_cast<std::uint32_t>(value.size() + 1));
    bytes += value + '\0';
  }
  void f64(double value) {
    align(8);
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    put(bytes, bits, 8);
  }
  void numbers(double a, double b) {
    u32(2);
    f64(a);
    f64(b);
  }
};

std::string message(int channel, std::int64_t ns, const Cdr& cdr) {
  std::string content;
  put(content, static_cast<std::uint64_t>(channel), 2);
  put(content, 0, 4);
  put(content, static_cast<std::uint64_t>(ns), 8);
  put(content, static_cast<std::uint64_t>(ns), 8);
  return record(0x05, content + cdr.bytes);
}

// Joint states at 200 Hz and poses at 100 Hz, in plain chunks of about 1 MB; 64 MB in all. Gone at the program's end.
class Bag {
 public:
  Bag() : path_((std::filesystem::temp_directory_path() / ("odolab-bench-" + std::to_string(::getpid()) + ".mcap"))) {
    std::ofstream file(path_, std::ios::binary);
    std::string head("\x89MCAP0\r\n", 8);
    std::string header;
    put_text(header, "ros2");
    put_text(header, "bench");
    head += record(0x01, header) + topic(1, "/joint_states", "sensor_msgs/msg/JointState") +
            topic(2, "/mocap/pose", "geometry_msgs/msg/PoseStamped");
    file << head;
    std::string chunk;
    for (std::int64_t i = 0, written = 0; written < 64 << 20; ++i) {
      const std::int64_t ns = 1'700'000'000'000'000'000 + i * 5'000'000;
      const double t = 0.005 * static_cast<double>(i);
      Cdr joints = stamped(ns, "");
      joints.u32(2);
      joints.text("left_wheel_joint");
      joints.text("right_wheel_joint");
      joints.numbers(3.1 * t, 3.3 * t);
      joints.numbers(3.1, 3.3);
      joints.numbers(0.1, 0.2);
      chunk += message(1, ns, joints);
      if (i % 2 == 0) {
        Cdr pose = stamped(ns, "world");
        for (double v : {0.2 * t, 0.01 * t, 0.0, 0.0, 0.0, 0.6, 0.8}) pose.f64(v);
        chunk += message(2, ns, pose);
      }
      if (chunk.size() < 1 << 20) continue;
      std::string content;
      put(content, 0, 8);
      put(content, 0, 8);
      put(content, chunk.size(), 8);
      put(content, 0, 4);
      put_text(content, "");
      put(content, chunk.size(), 8);
      file << record(0x06, content + chunk);
      written += static_cast<std::int64_t>(chunk.size());
      chunk.clear();
    }
    file << record(0x0F, std::string(4, '\0')) + record(0x02, std::string(20, '\0')) + head.substr(0, 8);
  }
  ~Bag() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }
  std::int64_t bytes() const { return static_cast<std::int64_t>(std::filesystem::file_size(path_)); }

 private:
  static Cdr stamped(std::int64_t ns, const char* frame) {
    Cdr cdr;
    cdr.u32(static_cast<std::uint32_t>(ns / 1'000'000'000));
    cdr.u32(static_cast<std::uint32_t>(ns % 1'000'000'000));
    cdr.text(frame);
    return cdr;
  }
  static std::string topic(int id, const std::string& name, const std::string& type) {
    std::string schema, channel;
    put(schema, static_cast<std::uint64_t>(id), 2);
    for (const std::string& text : {type, std::string("ros2msg"), std::string()}) put_text(schema, text);
    put(channel, static_cast<std::uint64_t>(id), 2);
    put(channel, static_cast<std::uint64_t>(id), 2);
    put_text(channel, name);
    put_text(channel, "cdr");
    put(channel, 0, 4);
    return record(0x03, schema) + record(0x04, channel);
  }
  std::filesystem::path path_;
};

const Bag& bag() {
  static const Bag bag;
  return bag;
}

void PlainReadOfABag(benchmark::State& state) {
  const Bag& b = bag();
  std::vector<char> buffer(1 << 18);
  for (auto _ : state) {
    std::ifstream file(b.path(), std::ios::binary);
    std::uint64_t sum = 0;
    while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || file.gcount() > 0)
      sum += static_cast<unsigned char>(buffer[0]);
    benchmark::DoNotOptimize(sum);
  }
  state.SetBytesProcessed(state.iterations() * b.bytes());
}
BENCHMARK(PlainReadOfABag)->Unit(benchmark::kMillisecond);

// range(0): 0 into memory, 1 into the CSV file.
void ImportOfABag(benchmark::State& state) {
  const Bag& b = bag();
  const std::string out = b.path() + ".csv";
  double rows = 0.0;
  for (auto _ : state) {
    if (state.range(0) == 0)
      rows = static_cast<double>(import_recording({b.path()})->recording.time_s.size());
    else
      rows = static_cast<double>(import_into_csv({b.path()}, {}, out)->rows);
  }
  std::filesystem::remove(out);
  state.counters["rows"] = rows;
  state.SetBytesProcessed(state.iterations() * b.bytes());
  state.SetLabel(state.range(0) == 0 ? "into memory" : "into a CSV file");
}
BENCHMARK(ImportOfABag)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace odolab
