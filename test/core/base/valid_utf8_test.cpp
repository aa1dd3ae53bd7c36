#include "core/base/valid_utf8.h"

#include <gtest/gtest.h>

namespace odolab {
namespace {

TEST(ValidUtf8, LeavesLettersOfEveryLengthAlone) {
  const std::string letters = "a \xC3\xA9 \xE2\x82\xAC \xED\x9F\xBF \xF0\x9F\xA4\x96 \xF4\x8F\xBF\xBF\n";
  EXPECT_EQ(valid_utf8(letters), letters);
  EXPECT_EQ(valid_utf8(""), "");
}

// As the Unicode standard has it in table 3-8 and beside it.
TEST(ValidUtf8, PutsTheReplacementCharacterForWhatIsNoLetter) {
  const std::string r = "\xEF\xBF\xBD";
  EXPECT_EQ(valid_utf8("caf\xE9.csv"), "caf" + r + ".csv");                 // Latin-1
  EXPECT_EQ(valid_utf8("\x80\xBF"), r + r);                                 // nothing that they go on from
  EXPECT_EQ(valid_utf8("a\xF1\x80\x80\xE1\x80\xC2"), "a" + r + r + r);      // cut off
  EXPECT_EQ(valid_utf8("\xE2\x82"), r);                                     // at the end
  EXPECT_EQ(valid_utf8("\xC0\xAF"), r + r);                                 // longer than need be
  EXPECT_EQ(valid_utf8("\xED\xA0\x80"), r + r + r);                         // a surrogate
  EXPECT_EQ(valid_utf8("\xF4\x90\x80\x80z\xFF"), r + r + r + r + "z" + r);  // beyond U+10FFFF
}

}  // namespace
}  // namespace odolab
