#include "core/io/mismatch_csv.h"

#include "core/io/csv_table.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

// Poses at both ends of a run that the simulation drew in between, too: its second pose had stood in the truth's last
// row, a second after the start.
TEST(MismatchCsv, HasTheSimulationWhereItIsAtTheTruthsTimes) {
  ScratchFolder folder;
  const Track truth = {{0.0, {0.0, 0.0, 0.0}}, {10.0, {1.0, 0.0, 0.0}}};
  Track simulated;
  for (int i = 0; i <= 10; ++i) simulated.push_back({1.0 * i, {0.1 * i, 0.0, 0.0}});
  const std::string path = folder.path("out.csv");
  ASSERT_TRUE(write_mismatch_csv(path, {}, truth, simulated, {}));
  const auto anything = [](std::string_view) { return CsvCells::anything; };
  const Result<CsvTable> table = read_csv_table(path, {"time_s", "simulated_x_m"}, anything);
  ASSERT_TRUE(table);
  EXPECT_DOUBLE_EQ(table->column("simulated_x_m")->back(), 1.0);
}

}  // namespace
}  // namespace odolab
