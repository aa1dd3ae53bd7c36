#include "core/io/bag/crc32.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

// The check value of CRC-32/ISO-HDLC in every catalogue of checksums.
TEST(Crc32, GivesTheCheckValueOfItsCatalogue) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926u);
  EXPECT_EQ(crc32(""), 0u);
}

TEST(Crc32, GoesOnWhereItStopped) {
  const std::string_view text = "The quick brown fox jumps over the lazy dog";
  for (std::size_t i = 0; i <= text.size(); ++i)
    EXPECT_EQ(crc32(text.substr(i), crc32(text.substr(0, i))), 0x414FA339u);
}

}  // namespace
}  // namespace odolab
