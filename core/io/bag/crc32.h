// CRC-32 as zip, PNG and MCAP use it (IEEE 802.3, reflected polynomial 0xEDB88320).
#pragma once

#include <cstdint>
#include <string_view>

namespace odolab {

// Of `bytes` after what `crc` already covers; starts at 0.
std::uint32_t crc32(std::string_view bytes, std::uint32_t crc = 0);

}  // namespace odolab
