// Text through a mapping; the first byte chooses units and kinds.
#include "core/io/import/imported_recording.h"
#include "test/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::string path = odolab::input_file(data + 1, size - 1, ".txt");
  const unsigned bits = data[0];
  odolab::ImportWishes wishes;
  std::vector<std::string> columns = {(bits & 1) ? "left_wheel_rad=2,deg/s,rate" : "left_wheel_rad=-2,turns",
                                      (bits & 2) ? "right_wheel_rad=3,increment" : "right_wheel_rad=3,rpm,rate",
                                      "truth_x_m=4,mm", "truth_y_m=y"};
  if (bits & 4) columns.push_back((bits & 8) ? "time_s=1,ns" : "time_s=t,s");
  if (bits & 16) columns.insert(columns.end(), {"truth_qz=5", "truth_qw=6"});
  if (bits & 32) wishes.mapping.shape.delimiter = ' ';
  for (const std::string& words : columns)
    if (odolab::add_column(wishes.mapping, words)) std::abort();
  wishes.mapping.period_s = 0.01;
  if (const auto imported = odolab::import_recording({path}, wishes)) odolab::must_be_sound(imported->recording);
  return 0;
}
