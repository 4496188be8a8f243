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
      const std::string detail = detail_of(row);
      text += fmt::format("  {:<18}{:<9}{}{}{}\n", row.name, name_of(row.probed.verdict),
                          row.probed.size, row.probed.size.empty() || detail.empty() ? "" : ": ",
                          detail);
      if (row.probed.verdict != FeatureVerdict::wrong) continue;
      text += fmt::format("  {:<27}triptych features --device {}{}\n", "", device,
                          row.name.empty() ? "" : " --only " + row.name);
    }
  }
  return text;
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
