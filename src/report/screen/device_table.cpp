#include "report/screen/device_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "report/screen/columns.hpp"
#include "report/words/comparison.hpp"
#include "technique/catalogue.hpp"

namespace triptych::report {
namespace {

using comparison::SideBySide;

// Returns the cost relative to the best device, such as "1.32". For times, adds the larger distance
// to an end of the confidence interval, such as "1.32 ±4%" or "~1.07 ±12%", where '~' marks a ratio
// that is not significant. If the amount of work differs by 1 % or more, adds it, such as "1.32
// (samples ×1.10)".
std::string text_of(const SideBySide::Cell& cell, bool time, bool best) {
  std::string text = fmt::format("{:.2f}", cell.ratio);
  if (time && !best) {
    const std::string range =
        cell.interval ? fmt::format("{:.0f}%", 100 * std::expm1(cell.interval->half_width())) : "?";
    text = fmt::format("{}{} ±{}", cell.is_significant() ? "" : "~", text, range);
  }
  for (const auto& [name, work] : cell.work) {
    if (std::abs(work - 1) >= 0.01) text += fmt::format(" ({} ×{:.2f})", name, work);
  }
  return text;
}

// Returns whether a user can choose this technique to draw images. speed_of_light, for example,
// only fetches voxels and draws no image.
bool can_be_chosen(const std::string& technique) {
  return std::ranges::none_of(technique::catalogue(), [&](const technique::Technique& each) {
    return each.id == technique && !each.draws_image;
  });
}

// Returns the cheapest technique on the device: "tiles 2.5 ms". Considers only the techniques with
// the largest number of configurations, because means over different configurations cannot be
// compared. Returns "" if none of these techniques was measured on the device.
std::string cheapest_technique(const SideBySide& table, const std::string& device) {
  std::size_t most = 0;
  for (const SideBySide::Row& row : table.rows) most = std::max(most, row.configurations);
  const SideBySide::Row* best = nullptr;
  for (const SideBySide::Row& row : table.rows) {
    if (row.configurations < most || !row.cells.contains(device)) continue;
    if (!can_be_chosen(row.technique)) continue;
    const double value = row.cells.at(device).value;
    if (best == nullptr || value < best->cells.at(device).value) best = &row;
  }
  if (best == nullptr) return {};
  return fmt::format("{} {:.3g} {}", best->technique, 1e-6 * best->cells.at(device).value,
                     table.unit == "ns" ? "ms" : "M");
}

}  // namespace

std::string screen_of(const SideBySide& table) {
  std::vector<std::string> head{""};
  std::vector<std::string> least{"best"};
  for (const std::string& device : table.devices) {
    head.push_back(device);
    least.push_back(cheapest_technique(table, device));
  }
  head.emplace_back("configurations");
  least.emplace_back();
  std::vector<std::vector<std::string>> lines{std::move(head)};
  for (const SideBySide::Row& row : table.rows) {
    std::vector<std::string>& line = lines.emplace_back(1, row.technique);
    for (const std::string& device : table.devices) {
      const auto cell = row.cells.find(device);
      line.push_back(cell == row.cells.end()
                         ? "–"
                         : text_of(cell->second, table.is_time(), device == row.best));
    }
    line.push_back(fmt::to_string(row.configurations));
  }
  lines.push_back(std::move(least));
  std::string text =
      aligned_columns(lines) +
      fmt::format("\n{} per frame, relative to the best device. {}.\n",
                  table.is_time() ? "Time (" + table.clock + " clock)" : "Instructions",
                  words::sentence(table));
  if (table.is_time()) text += words::uncertainty(table) + "\n";
  return text;
}

}  // namespace triptych::report
