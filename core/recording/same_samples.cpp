#include "core/recording/same_samples.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/base/formatted.h"

namespace odolab {

bool same_samples(const Recording& a, const Recording& b) {
  if (a.time_s != b.time_s || a.channels.size() != b.channels.size()) return false;
  const auto is_same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    const Channel &of_a = a.channels[c], &of_b = b.channels[c];
    if (of_a.name != of_b.name ||
        !std::equal(of_a.values.begin(), of_a.values.end(), of_b.values.begin(), of_b.values.end(), is_same))
      return false;
  }
  return true;
}

std::string fingerprint(const Recording& recording) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&](std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte, word >>= 8) hash = (hash ^ (word & 0xff)) * 0x100000001b3;
  };
  const auto add_values = [&](const std::vector<double>& values) {
    for (const double v : values)  // an empty cell is one, whatever its bits, and zero has no sign
      add(std::isnan(v) ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(v + 0.0));
  };
  add_values(recording.time_s);
  for (const Channel& channel : recording.channels) {
    for (const char letter : channel.name) add(static_cast<unsigned char>(letter));
    add_values(channel.values);
  }
  return formatted("%016llx", static_cast<unsigned long long>(hash));
}

}  // namespace odolab
