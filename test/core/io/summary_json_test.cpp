#include "core/io/summary_json.h"

#include <gtest/gtest.h>

#include <limits>

namespace odolab {
namespace {

TEST(SummaryJson, KeepsOrderAndStaysReadable) {
  Json summary = Json::object();
  summary["verdict"] = "found";
  summary["track"]["position_rms_m"] = 0.1;
  summary["track"]["windows"] = 12;
  summary["where"].push_back(Json(std::vector<double>{12.1, 13.0}));
  summary["ok"] = true;
  summary["empty"] = Json::object();
  summary["verdict"] = "nothing_missing";
  EXPECT_EQ(to_text(summary),
            "{\n"
            "  \"verdict\": \"nothing_missing\",\n"
            "  \"track\": {\n"
            "    \"position_rms_m\": 0.1,\n"
            "    \"windows\": 12\n"
            "  },\n"
            "  \"where\": [[12.1, 13.0]],\n"
            "  \"ok\": true,\n"
            "  \"empty\": {}\n"
            "}\n");
}

TEST(SummaryJson, WritesNumbersExactlyAndWhatIsNoneAsNull) {
  Json list = Json::array();
  list.push_back(0.1 + 0.2);
  list.push_back(std::numeric_limits<double>::quiet_NaN());
  list.push_back(-std::numeric_limits<double>::infinity());
  list.push_back(3.0);
  list.push_back(std::uint64_t{18446744073709551615ULL});
  EXPECT_EQ(to_text(list), "[0.30000000000000004, null, null, 3.0, 18446744073709551615]\n");
}

TEST(SummaryJson, EscapesText) {
  EXPECT_EQ(to_text(Json("a \"b\" \\ c\n\x01 \xC3\xA9")), "\"a \\\"b\\\" \\\\ c\\n\\u0001 \xC3\xA9\"\n");
}

// A name of a file may be any bytes; of JSON they would be none.
TEST(SummaryJson, IsValidWhateverBytesATextHas) {
  Json json = Json::object();
  json["r\xE9\x73um\xE9"] = "caf\xE9.csv";
  EXPECT_EQ(to_text(json), "{\n  \"r\xEF\xBF\xBDsum\xEF\xBF\xBD\": \"caf\xEF\xBF\xBD.csv\"\n}\n");
}

TEST(SummaryJson, PutsArraysOfObjectsOnLinesOfTheirOwn) {
  Json list = Json::array();
  Json& run = list.push_back(Json::object());
  run["n"] = 1;
  EXPECT_EQ(to_text(list), "[\n  {\n    \"n\": 1\n  }\n]\n");
}

}  // namespace
}  // namespace odolab
