// Text that says by itself what it is: recordings, trajectories, other people's data sets.
#include <cstring>

#include "core/io/import/imported_recording.h"
#include "test/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = odolab::input_file(data, size, ".csv");
  odolab::ImportWishes wishes;
  wishes.mapping.period_s = 0.1;  // KITTI poses
  if (const auto imported = odolab::import_recording({path}, wishes)) odolab::must_be_sound(imported->recording);
  return 0;
}
