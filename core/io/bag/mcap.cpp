#include "core/io/bag/mcap.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "core/io/bag/byte_cursor.h"
#include "core/io/bag/crc32.h"
#include "core/io/bag/decompress.h"
#include "core/io/bag/file_window.h"
#include "core/io/number_text.h"

namespace odolab {

namespace {

constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);
constexpr std::uint64_t kLargestChunk = 1ull << 30;  // beyond it a size is taken for damage
constexpr std::size_t kDamageToTell = 20;

enum Opcode : unsigned char {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kChunkIndex = 0x08,
  kDataEnd = 0x0F,
};

struct Record {
  unsigned char opcode = 0;
  std::uint64_t size = 0;  // of what follows the nine bytes of opcode and size
};
constexpr std::uint64_t kRecordHead = 9;

class Reader {
 public:
  Reader(FileWindow file, const BagSink& sink) : file_(std::move(file)), sink_(sink) {}

  BagFileReading read() {
    crc_ = crc32(file_.peek(kMcapMagic.size()));
    file_.advance(kMcapMagic.size());
    while (!ended_) {
      if (file_.left() == 0) {
        tell("the file ends without the record that closes it: it was not finished; all that stands in it was read");
        break;
      }
      if (!next_record() && !resume_at_next_chunk()) break;
    }
    if (nameless_ > 0)
      tell(std::to_string(nameless_) + (nameless_ == 1 ? " message" : " messages") +
           " left out, of channels that the file does not describe");
    if (untold_ > 0) reading_.damage.push_back("and " + std::to_string(untold_) + " more of the kind");
    return std::move(reading_);
  }

 private:
  void tell(std::string sentence) {
    if (reading_.damage.size() < kDamageToTell)
      reading_.damage.push_back(std::move(sentence));
    else
      ++untold_;
  }

  // One record of the file; false where there is none that can be followed.
  bool next_record() {
    const std::uint64_t start = file_.position();
    const std::string_view head = file_.peek(kRecordHead);
    ByteCursor cursor(head);
    const Record record{static_cast<unsigned char>(cursor.u8()), cursor.u64()};
    if (head.size() < kRecordHead) {
      tell("the file ends within a record, at byte " + std::to_string(start) + "; everything before it was read");
      file_.advance(head.size());
      ended_ = true;
      return true;
    }
    if (record.opcode == 0) {
      tell("no record at byte " + std::to_string(start));
      return false;
    }
    const std::uint64_t there = file_.left() - kRecordHead;
    if (record.size > there) {
      if (ends_properly()) {
        tell("at byte " + std::to_string(start) + " a record of " + std::to_string(record.size) +
             " bytes, where the file has " + std::to_string(there) + " more");
        return false;
      }
      if (record.opcode == kChunk) cut_chunk();
      tell("the file ends within " + std::string(record.opcode == kChunk ? "a chunk" : "a record") + ", at byte " +
           std::to_string(start) + "; every whole record before its end was read");
      ended_ = true;
      return true;
    }
    if (record.opcode == kDataEnd || record.opcode == kFooter) {
      if (record.opcode == kDataEnd) end_of_data(file_.peek(kRecordHead + record.size).substr(kRecordHead));
      ended_ = true;
      return true;
    }
    const bool of_use = record.opcode == kSchema || record.opcode == kChannel || record.opcode == kMessage ||
                        (record.opcode == kChunk && record.size <= kLargestChunk);
    if (record.opcode == kChunk && !of_use)
      tell("the chunk at byte " + std::to_string(start) + " was left out: it is larger than any should be");
    std::uint64_t left = kRecordHead + record.size;
    if (of_use) {
      const std::string_view bytes = file_.peek(left);
      if (bytes.size() == left) {
        if (!broken_crc_) crc_ = crc32(bytes, crc_);
        const std::string_view content = bytes.substr(kRecordHead);
        if (record.opcode == kChunk)
          chunk(content, start);
        else if (!plain(record.opcode, content))
          tell("a record at byte " + std::to_string(start) + " that contradicts itself was left out");
      }
      file_.advance(left);
      return true;
    }
    while (left > 0) {  // attachments may be larger than any buffer should be
      const std::string_view bytes = file_.peek(std::min<std::uint64_t>(left, 1 << 18));
      if (bytes.empty()) break;
      if (!broken_crc_) crc_ = crc32(bytes, crc_);
      file_.advance(bytes.size());
      left -= bytes.size();
    }
    return true;
  }

  // A schema, channel or message, in a chunk or not; false where it contradicts itself.
  bool plain(unsigned char opcode, std::string_view content) {
    ByteCursor cursor(content);
    if (opcode == kMessage) {
      const std::uint16_t id = cursor.u16();
      cursor.skip(4);  // the sequence number
      const auto log_time_ns = static_cast<std::int64_t>(cursor.u64());
      cursor.skip(8);  // when it was published
      if (!cursor.ok()) return false;
      const auto channel = channels_.find(id);
      if (channel == channels_.end())
        ++nameless_;
      else
        sink_(reading_.topics[channel->second], log_time_ns, cursor.rest());
    } else if (opcode == kSchema) {
      const std::uint16_t id = cursor.u16();
      const std::string_view name = cursor.text();
      if (!cursor.ok()) return false;
      schemas_[id] = name;
    } else if (opcode == kChannel) {
      const std::uint16_t id = cursor.u16(), schema = cursor.u16();
      const std::string_view topic = cursor.text(), encoding = cursor.text();
      if (!cursor.ok()) return false;
      if (channels_.count(id)) return true;
      const auto type = schemas_.find(schema);
      channels_[id] =
          topic_index({std::string(topic), type == schemas_.end() ? "" : type->second, std::string(encoding)});
    }
    return true;
  }

  // Channels of several publishers may share a topic.
  std::size_t topic_index(BagTopic topic) {
    for (std::size_t i = 0; i < reading_.topics.size(); ++i) {
      const BagTopic& known = reading_.topics[i];
      if (known.name == topic.name && known.type == topic.type && known.encoding == topic.encoding) return i;
    }
    reading_.topics.push_back(std::move(topic));
    return reading_.topics.size() - 1;
  }

  struct ChunkHead {
    std::uint64_t uncompressed_size = 0;
    std::uint32_t crc = 0;
    std::optional<Compression> compression;
    std::string compression_name;
    std::uint64_t size = 0;
  };

  static ChunkHead chunk_head(ByteCursor& cursor) {
    ChunkHead head;
    cursor.skip(16);  // first and last log time
    head.uncompressed_size = cursor.u64();
    head.crc = cursor.u32();
    head.compression_name = cursor.text();
    head.size = cursor.u64();
    if (head.compression_name.empty()) head.compression = Compression::none;
    if (head.compression_name == "zstd") head.compression = Compression::zstd;
    if (head.compression_name == "lz4") head.compression = Compression::lz4;
    return head;
  }

  void chunk(std::string_view content, std::uint64_t start) {
    ByteCursor cursor(content);
    const ChunkHead head = chunk_head(cursor);
    const std::string place = "the chunk at byte " + std::to_string(start) + " was left out: ";
    if (!cursor.ok() || head.size > cursor.rest().size()) return tell(place + "its sizes contradict each other");
    if (!head.compression) return tell(place + "compressed by " + in_quotes(head.compression_name));
    if (head.uncompressed_size > kLargestChunk)
      return tell(place + "it announces " + std::to_string(head.uncompressed_size) + " bytes");
    std::string_view records = cursor.rest().substr(0, static_cast<std::size_t>(head.size));
    if (*head.compression != Compression::none) {
      chunk_.clear();
      const Decompressed done = decompress(*head.compression, records, head.uncompressed_size, chunk_);
      if (!done.whole) return tell(place + done.problem);
      records = chunk_;
    }
    if (records.size() != head.uncompressed_size)
      return tell(place + "it holds " + std::to_string(records.size()) + " bytes and announces " +
                  std::to_string(head.uncompressed_size));
    if (head.crc != 0 && crc32(records) != head.crc) return tell(place + "its checksum does not fit");
    if (!records_of_chunk(records))
      tell("the chunk at byte " + std::to_string(start) + " was read only in part: a record in it contradicts itself");
  }

  // The last chunk of a file that was cut: what can be had of it.
  void cut_chunk() {
    const std::string_view there = file_.peek(std::min(file_.left(), kLargestChunk));
    ByteCursor cursor(there.substr(kRecordHead));
    const ChunkHead head = chunk_head(cursor);
    if (!cursor.ok() || !head.compression) return;
    chunk_.clear();
    decompress(*head.compression, cursor.rest(), std::min(head.uncompressed_size, kLargestChunk), chunk_);
    records_of_chunk(chunk_);
  }

  // False where a record in it does not end within it.
  bool records_of_chunk(std::string_view records) {
    bool sound = true;
    while (!records.empty()) {
      ByteCursor cursor(records);
      const Record record{static_cast<unsigned char>(cursor.u8()), cursor.u64()};
      if (!cursor.ok() || record.opcode == 0 || record.size > cursor.rest().size()) return false;
      sound = plain(record.opcode, cursor.rest().substr(0, static_cast<std::size_t>(record.size))) && sound;
      records.remove_prefix(static_cast<std::size_t>(kRecordHead + record.size));
    }
    return sound;
  }

  void end_of_data(std::string_view content) {
    ByteCursor cursor(content);
    const std::uint32_t expected = cursor.u32();
    if (cursor.ok() && expected != 0 && !broken_crc_ && expected != crc_)
      tell("the checksum over all data does not fit: some of what was read may be wrong");
  }

  // Whether the file has the end that a finished one has.
  bool ends_properly() {
    const std::uint64_t here = file_.position();
    file_.seek(file_.size() - std::min<std::uint64_t>(file_.size(), kMcapMagic.size()));
    const bool finished = file_.peek(kMcapMagic.size()) == kMcapMagic;
    file_.seek(here);
    return finished;
  }

  // After a record that leads nowhere: the next chunk that the summary at the file's end knows. False where none is.
  bool resume_at_next_chunk() {
    const std::uint64_t broken = file_.position();
    broken_crc_ = true;
    if (!chunks_) chunks_ = chunks_of_summary();
    const auto next = std::upper_bound(chunks_->begin(), chunks_->end(), broken);
    if (next == chunks_->end()) {
      tell("nothing could be read from byte " + std::to_string(broken) + " on; everything before it was");
      return false;
    }
    tell("reading went on at byte " + std::to_string(*next) + ", where the index knows the next chunk");
    file_.seek(*next);
    return true;
  }

  std::vector<std::uint64_t> chunks_of_summary() {
    constexpr std::uint64_t kFooterSize = 20;
    std::vector<std::uint64_t> offsets;
    const std::uint64_t closing = kRecordHead + kFooterSize + kMcapMagic.size();
    if (file_.size() < closing + kMcapMagic.size()) return offsets;
    file_.seek(file_.size() - closing);
    ByteCursor footer(file_.peek(closing));
    if (footer.u8() != kFooter || footer.u64() != kFooterSize) return offsets;
    const std::uint64_t summary = footer.u64();
    if (summary == 0 || summary >= file_.size()) return offsets;
    file_.seek(summary);
    while (true) {
      const std::string_view head = file_.peek(kRecordHead);
      ByteCursor cursor(head);
      const Record record{static_cast<unsigned char>(cursor.u8()), cursor.u64()};
      if (!cursor.ok() || record.opcode == kFooter || record.size > file_.left() - kRecordHead) break;
      if (record.opcode == kChunkIndex || record.opcode == kSchema || record.opcode == kChannel) {
        const std::string_view content = file_.peek(kRecordHead + record.size).substr(kRecordHead);
        if (record.opcode == kChunkIndex) {
          ByteCursor index(content);
          index.skip(16);
          if (const std::uint64_t offset = index.u64(); index.ok()) offsets.push_back(offset);
        } else {
          plain(record.opcode, content);  // what a lost chunk may have described
        }
      }
      file_.advance(kRecordHead + record.size);
    }
    std::sort(offsets.begin(), offsets.end());
    return offsets;
  }

  FileWindow file_;
  const BagSink& sink_;
  BagFileReading reading_;
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, std::size_t> channels_;  // the topic of each
  std::string chunk_;
  std::uint32_t crc_ = 0;
  bool broken_crc_ = false;
  bool ended_ = false;
  std::uint64_t nameless_ = 0, untold_ = 0;
  std::optional<std::vector<std::uint64_t>> chunks_;
};

}  // namespace

bool starts_like_mcap(std::string_view start) { return start.substr(0, kMcapMagic.size()) == kMcapMagic; }

Result<BagFileReading> read_mcap(const std::string& path, const BagSink& sink, const Progress& progress) {
  Result<FileWindow> file = FileWindow::open(path, progress);
  if (!file) return file.error();
  if (!starts_like_mcap(file->peek(kMcapMagic.size())))
    return Error{path, file->size() == 0 ? "an empty file" : "other first bytes", "an MCAP file"};
  return Reader(std::move(*file), sink).read();
}

}  // namespace odolab
