#include "app/cli/parameter_table.h"

#include <algorithm>
#include <cmath>

#include "app/cli/command.h"
#include "app/cli/terminal.h"

namespace odolab {

namespace {

std::string to_its_uncertainty(const ParameterEstimate& p) {
  if (!(p.stderr_value > 0.0)) return text_of("%.7g", p.value);
  const int decimals = 1 - static_cast<int>(std::floor(std::log10(p.stderr_value)));
  return text_of("%.*f", std::clamp(decimals, 0, 9), p.value);
}

}  // namespace

void print_parameters(const std::vector<ParameterEstimate>& parameters) {
  std::vector<std::vector<std::string>> rows{{"parameter", "before", "estimate", "+- (1 sigma)", "unit"}};
  for (const ParameterEstimate& p : parameters)
    rows.push_back({p.name, text_of("%.6g", p.nominal), p.determined ? to_its_uncertainty(p) : "as before",
                    p.determined ? text_of("%.1e", p.stderr_value) : "not determined", p.unit});
  print_table(rows);
}

int nothing_determined(const std::string& out) {
  if (out.empty()) {
    std::printf("\nNothing could be determined.\n");
    return kDone;
  }
  print_message(out + ": not written, since nothing could be determined");
  return kCheckFailed;
}

}  // namespace odolab
