// MCAP files, from their records to the recording.
#include "core/io/bag/bag.h"
#include "core/io/import/imported_recording.h"
#include "test/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = odolab::input_file(data, size, ".mcap");
  if (const auto imported = odolab::import_recording({path})) odolab::must_be_sound(imported->recording);
  odolab::ImportWishes wishes;
  wishes.truth = "/tf:map:base_link";
  if (const auto imported = odolab::import_recording({path}, wishes)) odolab::must_be_sound(imported->recording);
  return 0;
}
