// Text that every reader of UTF-8 takes: names of files may be any bytes.
#pragma once

#include <string>
#include <string_view>

namespace odolab {

// U+FFFD, the replacement character, for each run of bytes that is no letter of UTF-8; all else as it is.
std::string valid_utf8(std::string_view text);

}  // namespace odolab
