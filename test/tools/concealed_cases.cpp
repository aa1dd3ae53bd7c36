// Drawn cases of `odolab reproduce concealed`, one line each, for whoever looks for failures; then what they add up to.
//
//   concealed_cases SEED FIRST LAST [kind=nothing|one|two|outside] [level=strong|medium|weak] [squares=0|1]
//                   [effects=NAME,NAME] [write=FOLDER]
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/base/parallel.h"
#include "physics/experiments/concealed/judged.h"
#include "physics/experiments/concealed/report.h"

using namespace odolab;
using namespace odolab::concealed;

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr,
                 "concealed_cases SEED FIRST LAST [kind=one] [level=weak] [squares=1] [effects=a,b] [write=FOLDER]\n");
    return 2;
  }
  const auto seed = static_cast<std::uint64_t>(std::atoll(argv[1]));
  const int first = std::atoi(argv[2]), last = std::atoi(argv[3]);
  Wish wish;
  std::string folder;
  for (int i = 4; i < argc; ++i) {
    const std::string word = argv[i], value = word.substr(word.find('=') + 1), key = word.substr(0, word.find('='));
    if (key == "kind")
      wish.kind = value == "nothing" ? Kind::nothing
                  : value == "one"   ? Kind::one
                  : value == "two"   ? Kind::two
                                     : Kind::outside;
    if (key == "level")
      wish.level = value == "strong" ? Level::strong : value == "medium" ? Level::medium : Level::weak;
    if (key == "squares") wish.poor = value == "1";
    if (key == "effects")
      for (std::size_t at = 0; at <= value.size();) {
        const std::size_t end = std::min(value.find(',', at), value.size());
        wish.effects.push_back(value.substr(at, end - at));
        at = end + 1;
      }
    if (key == "write") folder = value;
  }
  std::vector<Judged> cases(static_cast<std::size_t>(last - first));
  std::vector<std::string> lines(cases.size());
  parallel_for(
      last - first,
      [&](int i) {
        const DrawnCase drawn = drawn_case(seed, first + i, wish);
        cases[static_cast<std::size_t>(i)] = judged(drawn);
        lines[static_cast<std::size_t>(i)] = cases[static_cast<std::size_t>(i)].line();
        if (!folder.empty())
          if (const Result<Done> written = write_case(drawn, folder + "/case_" + std::to_string(first + i)); !written)
            lines[static_cast<std::size_t>(i)] += " " + written.error().message();
      },
      [&](int i) {
        std::printf("%s\n", lines[static_cast<std::size_t>(i)].c_str());
        std::fflush(stdout);
      });
  const ExperimentReport report = report_of(cases);
  const auto print_row = [](const std::vector<std::string>& cells) {
    for (const std::string& cell : cells) std::printf("%s | ", cell.c_str());
    std::printf("\n");
  };
  for (const ResultTable& table : report.tables) {
    std::printf("\n%s\n", table.title.c_str());
    print_row(table.header);
    for (const auto& row : table.rows) print_row(row);
  }
  std::printf("\n");
  for (const Claim& claim : report.claims)
    std::printf("%s: %s (%s)\n", claim.holds ? "holds" : "does not hold", claim.sentence.c_str(),
                claim.because.c_str());
  for (const std::string& note : report.notes) std::printf("%s\n", note.c_str());
  return 0;
}
