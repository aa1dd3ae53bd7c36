#include "core/io/bag/decompress.h"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

namespace odolab {

namespace {

constexpr std::size_t kStep = 1 << 17;

// Calls `step(room, room_size, produced)` until it says that it is done; `out` grows by what was produced.
template <typename Step>
Decompressed grow(std::uint64_t most, std::string& out, const Step& step) {
  const std::size_t start = out.size();
  while (true) {
    const std::size_t before = out.size();
    if (before - start > most) {
      out.resize(start + static_cast<std::size_t>(most));
      return {false, "more than the " + std::to_string(most) + " bytes that were announced"};
    }
    out.resize(before + std::clamp<std::size_t>(before - start, kStep, 1 << 26));
    std::size_t produced = 0;
    bool done = false;
    const std::string problem = step(out.data() + before, out.size() - before, produced, done);
    out.resize(before + produced);
    if (!problem.empty()) return {false, problem};
    if (done) return {out.size() - start <= most, ""};
  }
}

Decompressed from_zstd(std::string_view bytes, std::uint64_t most, std::string& out) {
  struct Free {
    void operator()(ZSTD_DStream* s) const { ZSTD_freeDStream(s); }
  };
  static thread_local const std::unique_ptr<ZSTD_DStream, Free> stream(ZSTD_createDStream());
  ZSTD_initDStream(stream.get());
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  return grow(most, out, [&](char* room, std::size_t size, std::size_t& produced, bool& done) -> std::string {
    ZSTD_outBuffer to{room, size, 0};
    const std::size_t before = in.pos;
    const std::size_t left = ZSTD_decompressStream(stream.get(), &to, &in);
    produced = to.pos;
    if (ZSTD_isError(left)) return std::string("zstd: ") + ZSTD_getErrorName(left);
    done = left == 0 && in.pos == in.size;
    if (!done && to.pos == 0 && in.pos == before) return "zstd: the data end within a frame";
    return {};
  });
}

Decompressed from_lz4(std::string_view bytes, std::uint64_t most, std::string& out) {
  LZ4F_dctx* raw = nullptr;
  LZ4F_createDecompressionContext(&raw, LZ4F_VERSION);
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(raw,
                                                                                     &LZ4F_freeDecompressionContext);
  std::size_t at = 0;
  return grow(most, out, [&](char* room, std::size_t size, std::size_t& produced, bool& done) -> std::string {
    std::size_t to = size, from = bytes.size() - at;
    const std::size_t left = LZ4F_decompress(context.get(), room, &to, bytes.data() + at, &from, nullptr);
    if (LZ4F_isError(left)) return std::string("lz4: ") + LZ4F_getErrorName(left);
    at += from;
    produced = to;
    done = left == 0 && at == bytes.size();
    if (!done && to == 0 && from == 0) return "lz4: the data end within a frame";
    return {};
  });
}

}  // namespace

Decompressed decompress(Compression compression, std::string_view bytes, std::uint64_t most, std::string& out) {
  if (compression == Compression::zstd) return from_zstd(bytes, most, out);
  if (compression == Compression::lz4) return from_lz4(bytes, most, out);
  if (bytes.size() > most) return {false, "more than the " + std::to_string(most) + " bytes that were announced"};
  out.append(bytes);
  return {true, ""};
}

}  // namespace odolab
