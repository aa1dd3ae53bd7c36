#include "app/gui/edited_scenario.h"

#include <filesystem>

#include "core/io/scenario_toml.h"

namespace odolab {

namespace {

constexpr double kSaveAfter_s = 0.4;  // of the first change: less than the second that may be lost

}  // namespace

Result<Done> EditedScenario::advance(double wall_s, const Scenario& scenario) {
  if (!unsaved_) return Done{};
  waited_s_ += wall_s;
  if (waited_s_ < kSaveAfter_s) return Done{};
  unsaved_ = false;
  waited_s_ = 0.0;
  if (std::holds_alternative<ReplayPath>(scenario.path)) return Done{};  // it means nothing without its recording
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(path_).parent_path(), ignored);
  Scenario alone = scenario;
  alone.vehicle_file.clear();
  return write_scenario(path_, alone);
}

void EditedScenario::forget() {
  unsaved_ = false;
  waited_s_ = 0.0;
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove(path_, ignored);
}

bool EditedScenario::is_there() const {
  std::error_code ignored;
  return !path_.empty() && std::filesystem::exists(path_, ignored);
}

}  // namespace odolab
