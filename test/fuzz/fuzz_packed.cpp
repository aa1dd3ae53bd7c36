// Bags that were compressed as a whole.
#include "core/io/import/imported_recording.h"
#include "test/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = odolab::input_file(data, size, ".mcap.zstd");
  if (const auto imported = odolab::import_recording({path})) odolab::must_be_sound(imported->recording);
  return 0;
}
