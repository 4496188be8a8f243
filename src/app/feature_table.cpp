#include "app/feature_table.hpp"

#include <fmt/format.h>

#include <string_view>

#include "report/words/outcome.hpp"

namespace triptych::app {
namespace {

using measure::FeatureVerdict;

std::string_view name_of(FeatureVerdict verdict) {
  switch (verdict) {
    case FeatureVerdict::right:
      return "right";
    case FeatureVerdict::wrong:
      return "wrong";
    case FeatureVerdict::skipped:
      return "skipped";
  }
  return "";
}

std::string detail_of(const measure::FeatureRow& row) {
  return row.ended ? report::words::text_of(*row.ended) : row.probed.detail;
}

// Returns the largest size that the probe used, and its error or the reason for its skip.
std::string result_of(const measure::FeatureRow& row) {
  const std::string detail = detail_of(row);
  return row.probed.size + (row.probed.size.empty() || detail.empty() ? "" : ": ") + detail;
}

std::string command_of(const std::string& device, const measure::FeatureRow& row) {
  return fmt::format("triptych features --device {}{}", device,
                     row.name.empty() ? "" : " --only " + row.name);
}

}  // namespace

FeatureTable probe_devices(const std::vector<std::string>& devices, const std::string& only,
                           int limit_s) {
  FeatureTable table;
  for (const std::string& device : devices) {
    table[device] = measure::probe_features(device, only, std::chrono::seconds(limit_s));
  }
  return table;
}

std::string feature_text(const FeatureTable& table) {
  std::string text;
  for (const auto& [device, rows] : table) {
    text += fmt::format("{}\n", device);
    for (const measure::FeatureRow& row : rows) {
      text +=
          fmt::format("  {:<18}{:<9}{}\n", row.name, name_of(row.probed.verdict), result_of(row));
      if (row.probed.verdict != FeatureVerdict::wrong) continue;
      text += fmt::format("  {:<27}{}\n", "", command_of(device, row));
    }
  }
  return text;
}

std::string feature_summary(const FeatureTable& table) {
  constexpr std::size_t max_listed = 3;
  std::map<FeatureVerdict, std::size_t> counts;
  std::string wrong;
  for (const auto& [device, rows] : table) {
    for (const measure::FeatureRow& row : rows) {
      const std::size_t count = ++counts[row.probed.verdict];
      if (row.probed.verdict != FeatureVerdict::wrong || count > max_listed) continue;
      wrong += fmt::format("  wrong: {} {}: {}; {}\n", device, row.name, result_of(row),
                           command_of(device, row));
    }
  }
  if (counts.empty()) return {};
  if (const std::size_t all = counts[FeatureVerdict::wrong]; all > max_listed) {
    wrong += fmt::format("  … and {} more\n", all - max_listed);
  }
  return fmt::format("API features that no scene uses: {} right, {} wrong, {} skipped\n{}",
                     counts[FeatureVerdict::right], counts[FeatureVerdict::wrong],
                     counts[FeatureVerdict::skipped], wrong);
}

core::Json feature_json(const FeatureTable& table) {
  core::Json devices = core::Json::object();
  for (const auto& [device, rows] : table) {
    core::Json& list = devices[device] = core::Json::array();
    for (const measure::FeatureRow& row : rows) {
      list.push_back({{"feature", row.name},
                      {"verdict", name_of(row.probed.verdict)},
                      {"size", row.probed.size},
                      {"detail", detail_of(row)}});
    }
  }
  return devices;
}

core::ExitCode verdict_of(const FeatureTable& table) {
  bool right = false;
  for (const auto& [device, rows] : table) {
    for (const measure::FeatureRow& row : rows) {
      if (row.probed.verdict == FeatureVerdict::wrong) return core::ExitCode::regression;
      right = right || row.probed.verdict == FeatureVerdict::right;
    }
  }
  return right ? core::ExitCode::pass : core::ExitCode::cannot_judge;
}

}  // namespace triptych::app
