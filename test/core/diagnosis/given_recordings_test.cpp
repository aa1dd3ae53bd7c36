#include "core/diagnosis/given_recordings.h"

#include <gtest/gtest.h>

#include "core/io/vehicle_toml.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

constexpr const char* kLengths =
    "kind = \"differential_drive\"\n[differential_drive]\nwheel_radius_left_m = 0.08\nwheel_radius_right_m = 0.08\n"
    "wheelbase_m = 0.4\n";

Recording with_columns(const std::vector<std::string>& names) {
  Recording r;
  r.time_s = {0.0, 1.0};
  for (const std::string& name : names) r.add_channel(name).values = {0.0, 1.0};
  return r;
}

TEST(TicksOfUnknownSize, AreThoseOfAVehicleWhoseFileDoesNotSayHowManyMakeATurn) {
  ScratchFolder folder;
  const Vehicle silent = read_vehicle(folder.write("v.toml", kLengths)).value(),
                says = read_vehicle(folder.write("w.toml", std::string(kLengths) +
                                                               "encoder_counts_per_revolution = 2000\n"))
                           .value();
  const Recording ticks = with_columns({"left_ticks", "right_ticks"}),
                  both = with_columns({"left_ticks", "right_ticks", "left_wheel_rad", "right_wheel_rad"});
  const auto refused = ticks_of_unknown_size(ticks, silent, "run.csv");
  ASSERT_TRUE(refused);
  EXPECT_NE(refused->message().find("encoder_counts_per_revolution"), std::string::npos) << refused->message();
  EXPECT_FALSE(ticks_of_unknown_size(both, silent, "run.csv"));
  EXPECT_FALSE(ticks_of_unknown_size(ticks, says, "run.csv"));
  EXPECT_FALSE(ticks_of_unknown_size(ticks, Vehicle{}, "run.csv"));  // one that was made, and not read
}

TEST(TicksOfUnknownSize, AreNoMoreKnownOnceTheVehicleWasWritten) {
  ScratchFolder folder;
  const std::string path = folder.write("v.toml", kLengths);
  ASSERT_TRUE(write_vehicle(path, read_vehicle(path).value()));
  EXPECT_EQ(text_of(path).find("encoder_counts"), std::string::npos);
  EXPECT_TRUE(ticks_of_unknown_size(with_columns({"left_ticks", "right_ticks"}), read_vehicle(path).value(), ""));
}

}  // namespace
}  // namespace odolab
