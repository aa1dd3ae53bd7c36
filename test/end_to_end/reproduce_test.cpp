#include <gtest/gtest.h>
#include <unistd.h>

#include "test/end_to_end/program.h"

namespace odolab {
namespace {

TEST(Reproduce, PrintsAClaimWithItsFiguresAndWritesThemForScripts) {
  const std::filesystem::path json = fresh_folder("reproduce") / "figures.json";
  const Outcome outcome = odolab("reproduce umbmark-one-direction --json '" + json.string() + "'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("holds: two errors that cancel in one direction add in the other"), std::string::npos)
      << outcome.output;
  EXPECT_NE(text_of_file(json).find("\"succeeded\": true"), std::string::npos);
}

TEST(Reproduce, SkipsRealRecordingsThatAreNotThere) {
  const Outcome outcome = odolab("reproduce real --recordings /no/such/folder");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("note: skipped: OptiOdom's recordings are not in /no/such/folder/optiodom"),
            std::string::npos)
      << outcome.output;
}

TEST(Reproduce, NamesWhatItDoesNotKnow) {
  const Outcome outcome = odolab("reproduce umbmark-tabel3");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("umbmark-tabel3"), std::string::npos) << outcome.errors;
  EXPECT_EQ(outcome.output, "");
}

}  // namespace
}  // namespace odolab
