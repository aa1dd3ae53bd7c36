// zstd and lz4 frames, of which neither the announced nor the real size is trusted.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace odolab {

enum class Compression { none, zstd, lz4 };

struct Decompressed {
  bool whole = false;   // all frames ended where they should and no more than `most` bytes came out
  std::string problem;  // why not, in words
};

// Appends to `out` what `bytes` hold, as far as that can be had; memory grows with what really comes out, up to `most`.
Decompressed decompress(Compression compression, std::string_view bytes, std::uint64_t most, std::string& out);

}  // namespace odolab
