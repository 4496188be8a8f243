#include "comparison/side_by_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "judge/baselines/frame_change.hpp"

namespace triptych::comparison {
namespace {

using Records = std::map<std::string, std::map<std::string, const record::Record*>>;

// What a frame did, as every API counts it.
constexpr std::array<const char*, 3> telling_work{"samples", "fragments", "primitives"};

double instructions_of(const record::Record& record) {
  return judge::frame_of(record.cost);
}

double time_of(const record::Record& record) {
  const auto summary = record::summarise(record.time_ns());
  return summary ? summary->median : 0;
}

double counter_of(const record::Record& record, const char* name) {
  const auto found = record.counters.find(name);
  return found == record.counters.end() ? 0 : static_cast<double>(found->second);
}

// Configuration → device → record that has a value.
template <typename Value>
Records measured_by(std::span<const record::Record> records, Value value) {
  Records found;
  for (const record::Record& record : records) {
    if (record.outcome != record::Outcome::measured || !(value(record) > 0)) continue;
    found[record.configuration][record.device] = &record;
  }
  std::erase_if(found, [](const auto& each) { return each.second.size() < 2; });
  return found;
}

class Table {
 public:
  Table(const Records& records, std::string unit) : records_(records) {
    table_.unit = std::move(unit);
  }

  template <typename Value>
  SideBySide make(Value value) {
    std::map<std::string, std::set<std::string>> devices_of;  // by technique
    std::set<std::string> all;
    for (const auto& [key, by_device] : records_) {
      for (const auto& [device, record] : by_device) {
        devices_of[record->technique].insert(device);
        all.insert(device);
      }
    }
    table_.devices = {all.begin(), all.end()};
    for (const auto& [technique, devices] : devices_of) add_row(technique, devices, value);
    return std::move(table_);
  }

 private:
  template <typename Value>
  void add_row(const std::string& technique, const std::set<std::string>& devices, Value value) {
    std::vector<const std::map<std::string, const record::Record*>*> shared;
    for (const auto& [key, by_device] : records_) {
      const bool mine = by_device.begin()->second->technique == technique;
      if (mine && by_device.size() == devices.size()) shared.push_back(&by_device);
    }
    if (shared.empty()) return;
    const auto mean_of = [&](const std::string& device, auto number) {
      double logs = 0;
      for (const auto* each : shared) logs += std::log(number(*each->at(device)));
      return std::exp(logs / static_cast<double>(shared.size()));
    };
    SideBySide::Row row{technique, shared.size(), {}, {}};
    for (const std::string& device : devices) {
      row.cells[device].value = mean_of(device, value);
    }
    row.best = std::ranges::min_element(row.cells, {}, [](const auto& cell) {
                 return cell.second.value;
               })->first;
    for (auto& [device, cell] : row.cells) {
      cell.ratio = cell.value / row.cells.at(row.best).value;
      for (const char* name : telling_work) {
        const auto count = [&](const record::Record& record) { return counter_of(record, name); };
        const double work = mean_of(device, count) / mean_of(row.best, count);
        if (std::isfinite(work) && work > 0) cell.work[name] = work;
      }
    }
    table_.rows.push_back(std::move(row));
  }

  const Records& records_;
  SideBySide table_;
};

// "1.32"; "1.32 (samples ×1.10)" where the work differs by a per cent or more.
std::string text_of(const SideBySide::Cell& cell) {
  std::string text = fmt::format("{:.2f}", cell.ratio);
  for (const auto& [name, work] : cell.work) {
    if (std::abs(work - 1) >= 0.01) text += fmt::format(" ({} ×{:.2f})", name, work);
  }
  return text;
}

}  // namespace

std::optional<SideBySide> side_by_side(std::span<const record::Record> records) {
  const Records counted = measured_by(records, instructions_of);
  const Records timed = counted.empty() ? measured_by(records, time_of) : Records{};
  SideBySide table = counted.empty() ? Table(timed, "ns").make(time_of)
                                     : Table(counted, "instructions").make(instructions_of);
  if (table.rows.empty()) return std::nullopt;
  return table;
}

std::string SideBySide::sentence() const {
  std::map<std::string, std::size_t> wins;
  for (const Row& row : rows) ++wins[row.best];
  const auto most =
      std::ranges::max_element(wins, {}, [](const auto& each) { return each.second; });
  std::string text = fmt::format("{} takes the least in {} of {} techniques", most->first,
                                 most->second, rows.size());
  for (const std::string& device : devices) {
    std::vector<double> ratios;
    for (const Row& row : rows) {
      if (device == most->first || !row.cells.contains(device)) continue;
      if (!row.cells.contains(most->first)) continue;
      ratios.push_back(row.cells.at(device).value / row.cells.at(most->first).value);
    }
    if (ratios.empty()) continue;
    text += fmt::format("; {} {:.2f} to {:.2f} times as much", device, std::ranges::min(ratios),
                        std::ranges::max(ratios));
  }
  return text + ", in what both have";
}

std::string to_text(const SideBySide& table) {
  std::size_t first = 10;
  for (const auto& row : table.rows) first = std::max(first, row.technique.size() + 2);
  std::string text = fmt::format("{:<{}}", "", first);
  std::map<std::string, std::size_t> width;
  for (const std::string& device : table.devices) {
    width[device] = device.size() + 2;
    for (const auto& row : table.rows) {
      const auto cell = row.cells.find(device);
      if (cell == row.cells.end()) continue;
      width[device] = std::max(width[device], text_of(cell->second).size() + 2);
    }
    text += fmt::format("{:<{}}", device, width[device]);
  }
  text += "configurations\n";
  for (const auto& row : table.rows) {
    text += fmt::format("{:<{}}", row.technique, first);
    for (const std::string& device : table.devices) {
      const auto cell = row.cells.find(device);
      text += fmt::format("{:<{}}", cell == row.cells.end() ? "–" : text_of(cell->second),
                          width[device]);
    }
    text += fmt::format("{}\n", row.configurations);
  }
  return text + fmt::format("\n{} a frame over the best device's. {}.\n",
                            table.unit == "ns" ? "Time of" : "Instructions of", table.sentence());
}

nlohmann::json to_json(const SideBySide& table) {
  nlohmann::json json{{"unit", table.unit}, {"sentence", table.sentence()}};
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
