#include "comparison/side_by_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "judge/baselines/frame_change.hpp"
#include "technique/catalogue.hpp"

namespace triptych::comparison {
namespace {

using Value = double (*)(const record::Record&);  // 0: there is none
using ByDevice = std::map<std::string, const record::Record*>;

// The work of a frame, which every API counts in the same way.
constexpr std::array<const char*, 3> telling_work{"samples", "fragments", "primitives"};

double instructions_of(const record::Record& record) {
  return judge::frame_of(record.cost);
}

double time_by(const record::Record& record, std::string_view clock) {
  const auto summary = record::summarise(record.time_ns_by(clock));
  return summary ? summary->median : 0;
}
double device_time_of(const record::Record& record) {
  return time_by(record, "device");
}
double wall_time_of(const record::Record& record) {
  return time_by(record, "wall");
}

// Technique → configuration → the devices that measured it, if there are several.
std::map<std::string, std::vector<ByDevice>> measured_by(std::span<const record::Record> records,
                                                         Value value) {
  std::map<std::string, ByDevice> by_configuration;
  for (const record::Record& record : records) {
    if (record.outcome != record::Outcome::measured || !(value(record) > 0)) continue;
    by_configuration[record.configuration][record.device] = &record;
  }
  std::map<std::string, std::vector<ByDevice>> found;
  for (auto& [configuration, devices] : by_configuration) {
    if (devices.size() < 2) continue;
    found[devices.begin()->second->technique].push_back(std::move(devices));
  }
  return found;
}

template <typename Number>
double geometric_mean(const std::vector<ByDevice>& configurations, const std::string& device,
                      Number number) {
  double logs = 0;
  for (const ByDevice& each : configurations) logs += std::log(number(*each.at(device)));
  return std::exp(logs / static_cast<double>(configurations.size()));
}

// `shared` are the configurations that all `devices` measured; at least one.
SideBySide::Row row_of(const std::string& technique, const std::vector<ByDevice>& shared,
                       const std::set<std::string>& devices, Value value) {
  SideBySide::Row row{technique, shared.size(), {}, {}};
  for (const std::string& device : devices) {
    row.cells[device].value = geometric_mean(shared, device, value);
  }
  row.best = std::ranges::min_element(row.cells, {}, [](const auto& cell) {
               return cell.second.value;
             })->first;
  for (auto& [device, cell] : row.cells) {
    cell.ratio = cell.value / row.cells.at(row.best).value;
    for (const char* name : telling_work) {
      const auto count = [name](const record::Record& record) {
        return judge::count_of(record.counters, name).value_or(0);
      };
      const double work =
          geometric_mean(shared, device, count) / geometric_mean(shared, row.best, count);
      if (std::isfinite(work) && work > 0) cell.work[name] = work;
    }
  }
  return row;
}

// Times on different clocks are never compared.
bool all_by_device_clock(std::span<const record::Record> records) {
  return std::ranges::all_of(records, [](const record::Record& each) {
    return each.time_ns().empty() || each.clock() == "device";
  });
}

SideBySide table_of(std::span<const record::Record> records, std::string unit, Value value) {
  SideBySide table{.unit = std::move(unit), .clock = {}, .devices = {}, .rows = {}};
  std::set<std::string> all;
  for (auto& [technique, configurations] : measured_by(records, value)) {
    std::set<std::string> devices;
    for (const ByDevice& each : configurations) {
      for (const auto& [device, record] : each) devices.insert(device);
    }
    all.insert(devices.begin(), devices.end());
    std::erase_if(configurations,
                  [&](const ByDevice& each) { return each.size() < devices.size(); });
    if (configurations.empty()) continue;
    table.rows.push_back(row_of(technique, configurations, devices, value));
  }
  table.devices = {all.begin(), all.end()};
  return table;
}

// "1.32", or "1.32 (samples ×1.10)" if the work differs by one per cent or more.
std::string text_of(const SideBySide::Cell& cell) {
  std::string text = fmt::format("{:.2f}", cell.ratio);
  for (const auto& [name, work] : cell.work) {
    if (std::abs(work - 1) >= 0.01) text += fmt::format(" ({} ×{:.2f})", name, work);
  }
  return text;
}

// A bound on speed is not a technique that a user can choose.
bool is_a_choice(const std::string& technique) {
  return std::ranges::none_of(technique::catalogue(), [&](const technique::Technique& each) {
    return each.id == technique && !each.picture;
  });
}

// "tiles 2.5 ms": a device's best technique among the rows with the largest number of
// configurations; empty if it has none of these.
std::string least_text(const SideBySide& table, const std::string& device) {
  std::size_t most = 0;
  for (const SideBySide::Row& row : table.rows) most = std::max(most, row.configurations);
  const SideBySide::Row* best = nullptr;
  for (const SideBySide::Row& row : table.rows) {
    if (row.configurations < most || !row.cells.contains(device)) continue;
    if (!is_a_choice(row.technique)) continue;
    const double value = row.cells.at(device).value;
    if (best == nullptr || value < best->cells.at(device).value) best = &row;
  }
  if (best == nullptr) return {};
  return fmt::format("{} {:.3g} {}", best->technique, 1e-6 * best->cells.at(device).value,
                     table.unit == "ns" ? "ms" : "M");
}

// Left-aligned columns.
std::string aligned(const std::vector<std::vector<std::string>>& lines) {
  std::vector<std::size_t> widths(lines.front().size());
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const auto& line : lines) {
    for (std::size_t i = 0; i + 1 < widths.size(); ++i) {
      text += fmt::format("{:<{}}", line[i], widths[i] + 2);
    }
    text += line.back() + "\n";
  }
  return text;
}

}  // namespace

std::optional<SideBySide> side_by_side(std::span<const record::Record> records) {
  SideBySide table = table_of(records, "instructions", instructions_of);
  if (table.devices.empty()) {
    const bool by_device = all_by_device_clock(records);
    table = table_of(records, "ns", by_device ? device_time_of : wall_time_of);
    table.clock = by_device ? "device" : "wall";
  }
  if (table.rows.empty()) return std::nullopt;
  return table;
}

std::string SideBySide::sentence() const {
  std::map<std::string, std::size_t> wins;
  for (const Row& row : rows) ++wins[row.best];
  const auto most =
      std::ranges::max_element(wins, {}, [](const auto& each) { return each.second; });
  const auto its =
      std::ranges::count_if(rows, [&](const Row& row) { return row.cells.contains(most->first); });
  std::string text =
      fmt::format("{} is best in {} of its {} techniques", most->first, most->second, its);
  for (const std::string& device : devices) {
    std::vector<double> ratios;
    for (const Row& row : rows) {
      if (device == most->first || !row.cells.contains(device)) continue;
      if (!row.cells.contains(most->first)) continue;
      ratios.push_back(row.cells.at(device).value / row.cells.at(most->first).value);
    }
    if (ratios.empty()) continue;
    text += fmt::format("; {} takes {:.2f} to {:.2f} times as much in the techniques of both",
                        device, std::ranges::min(ratios), std::ranges::max(ratios));
  }
  return text;
}

std::string to_text(const SideBySide& table) {
  std::vector<std::string> head{""};
  std::vector<std::string> least{"best"};
  for (const std::string& device : table.devices) {
    head.push_back(device);
    least.push_back(least_text(table, device));
  }
  head.emplace_back("configurations");
  least.emplace_back();
  std::vector<std::vector<std::string>> lines{std::move(head)};
  for (const SideBySide::Row& row : table.rows) {
    std::vector<std::string>& line = lines.emplace_back(1, row.technique);
    for (const std::string& device : table.devices) {
      const auto cell = row.cells.find(device);
      line.push_back(cell == row.cells.end() ? "–" : text_of(cell->second));
    }
    line.push_back(fmt::to_string(row.configurations));
  }
  lines.push_back(std::move(least));
  return aligned(lines) +
         fmt::format("\n{} of a frame, relative to the best device. {}.\n",
                     table.clock.empty() ? "Instructions" : "Time by the " + table.clock + " clock",
                     table.sentence());
}

nlohmann::json to_json(const SideBySide& table) {
  nlohmann::json json{{"unit", table.unit}, {"sentence", table.sentence()}};
  if (!table.clock.empty()) json["clock"] = table.clock;
  for (const auto& row : table.rows) {
    nlohmann::json cells = nlohmann::json::object();
    for (const auto& [device, cell] : row.cells) {
      cells[device] = {{"value", cell.value}, {"ratio", cell.ratio}, {"work", cell.work}};
    }
    json["rows"].push_back({{"technique", row.technique},
                            {"configurations", row.configurations},
                            {"best", row.best},
                            {"devices", cells}});
  }
  return json;
}

}  // namespace triptych::comparison
