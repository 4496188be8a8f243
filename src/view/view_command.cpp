#include "view/view_command.hpp"

#include <fmt/format.h>

#include <chrono>

#include "measure/protocol/injected_fault.hpp"
#include "record/factor_list.hpp"
#include "report/command.hpp"

namespace triptych::view {

std::string render_command(const measure::ViewRequest& request, const measure::ViewSide& side,
                           const std::string& key, std::optional<std::pair<int, int>> pixel) {
  const auto faults = measure::parse_faults(request.faults);
  report::Command command{.command = "render",
                          .object = request.suite,
                          .device = side.device,
                          .factors = record::parse_factor_list(key),
                          .injected = measure::faults_for(faults, key, side.device),
                          .limit = std::chrono::seconds(request.limit_s),
                          .more = {"--truth", "--out", "frame"}};
  if (pixel) {
    command.more = {"--pixel", fmt::format("{},{}", pixel->first, pixel->second), "--out", "frame"};
  }
  for (const std::string& each : side.environment) {
    const std::size_t equals = each.find('=');
    command.environment[each.substr(0, equals)] = each.substr(equals + 1);
  }
  return report::text_of(command);
}

}  // namespace triptych::view
