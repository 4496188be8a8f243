#include "judge/baselines/baseline_files.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/file.hpp"
#include "estimation/statistics.hpp"
#include "judge/baselines/layout.hpp"

namespace triptych::judge {
namespace fs = std::filesystem;
namespace {

std::string read_text(const core::JsonNode& node) {
  return node.text();
}

record::Executable read_executable(const core::JsonNode& node) {
  record::Executable executable;
  for (const auto& [name, value] : node.members()) {
    if (name == "assembly") {
      executable.assembly = value.text();
    } else {
      executable.statistics.emplace(name, value.number_from_zero());
    }
  }
  return executable;
}

bool is_outside(const fs::path& name) {
  return name.is_absolute() || std::find(name.begin(), name.end(), fs::path("..")) != name.end();
}

}  // namespace

record::StatisticWorth read_worth(const core::JsonNode& node) {
  try {
    return node.value().get<record::StatisticWorth>();
  } catch (const core::InputError& error) {
    node.fail(error.what());
  }
}

record::Counts read_counts(const core::JsonNode& node) {
  return read_members<std::uint64_t>(node,
                                     [](const core::JsonNode& n) { return n.whole_number(); });
}

std::set<std::string> read_names(const core::JsonNode& node) {
  std::set<std::string> names;
  for (const core::JsonNode& name : node.elements()) names.insert(name.text());
  return names;
}

Manifest read_manifest(const core::JsonNode& node) {
  Manifest manifest{.plan_hash = node.at("plan_hash").text(),
                    .configurations = node.at("configurations").whole_number(),
                    .files = read_members<std::string>(node.at("files"), read_text)};
  for (const auto& [device, drivers] : node.at("devices").members()) {
    manifest.devices[device] = read_names(drivers);
  }
  manifest.checks = record::checks_of(node.at("checks").text());
  if (!node.has("machines")) return manifest;
  for (const core::JsonNode& machine : node.at("machines").elements()) {
    manifest.machines.push_back(read_names(machine));
  }
  return manifest;
}

StoredImage read_stored_image(const core::JsonNode& node) {
  const core::JsonNode reference = node.at("reference");
  const auto hashes = reference.elements();
  if (hashes.size() != 2) reference.fail("expected two hashes");
  StoredImage image{{hashes[0].text(), hashes[1].text()}, {}};
  for (const auto& [name, value] : node.members()) {
    if (name.starts_with("data")) image.data.emplace(name, value.text());
  }
  return image;
}

StoredCounters read_counters(const core::JsonNode& node) {
  return read_members<record::Counts>(node, [](const core::JsonNode& by_device) {
    record::Counts counts = read_counts(by_device);
    if (counts.empty()) by_device.fail("expected a value for at least one device");
    return counts;
  });
}

ByName<record::Counts> read_memory(const core::JsonNode& node) {
  return read_members<record::Counts>(node, read_counts);
}

ByName<StoredError> read_errors(const core::JsonNode& node) {
  return read_members<StoredError>(node, [](const core::JsonNode& error) {
    return StoredError{error.at("rmse").number_from_zero(),
                       error.at("arithmetic").number_from_zero()};
  });
}

DriverCost read_cost(const core::JsonNode& node) {
  return {.device = node.at("device").text(),
          .driver_version = node.at("driver_version").text(),
          .counted_by = node.at("counted_by").text(),
          .configurations =
              read_members<StoredCost>(node.at("configurations"), [](const core::JsonNode& cost) {
                return StoredCost{read_counts(cost.at("frame")), read_counts(cost.at("prepare"))};
              })};
}

DriverCode read_code(const core::JsonNode& node) {
  const auto read_configuration = [](const core::JsonNode& code) {
    return read_members<record::Executable>(code, read_executable);
  };
  return {
      .device = node.at("device").text(),
      .driver_version = node.at("driver_version").text(),
      .configurations = read_members<record::Code>(node.at("configurations"), read_configuration)};
}

StoredTiming read_timing(const core::JsonNode& node) {
  return {node.at("clock").text(), node.at("median_ns").positive_number(),
          node.at("spread").positive_number(), node.at("kernel_hash").text()};
}

std::map<std::string, fs::path> files_in(const fs::path& folder) {
  std::map<std::string, fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.emplace(entry.path().stem(), entry.path());
  }
  return files;
}

std::string first_change(const fs::path& folder, const Manifest& manifest) {
  for (const auto& [name, hash] : manifest.files) {
    const fs::path file = folder / name;
    if (is_outside(name)) return name + " is outside the folder";
    if (!fs::is_regular_file(file)) return name + " is missing";
    if (core::content_hash(core::read_file(file)) != hash)
      return name + " was changed after it was accepted";
  }
  std::set<std::string> unlisted;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (!entry.is_directory() && name != Layout::manifest && !manifest.files.contains(name)) {
      unlisted.insert(name);
    }
  }
  return unlisted.empty() ? std::string() : *unlisted.begin() + " does not belong to the baselines";
}

double log_spread(std::vector<double> times_ns) {
  constexpr double process_spread = 0.005;
  std::ranges::sort(times_ns);
  std::vector<double> logarithms;
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < times_ns.size(); ++i) {
    logarithms.push_back(std::log(times_ns[i]));
    if (i > 0 && times_ns[i] > times_ns[i - 1]) {
      step = std::min(step, logarithms[i] - logarithms[i - 1]);
    }
  }
  if (!std::isfinite(step)) step = 0;
  const double centre = estimation::median(logarithms);
  for (double& value : logarithms) value = std::abs(value - centre);
  return std::max({estimation::normal_mad * estimation::median(logarithms), step, process_spread});
}

}  // namespace triptych::judge
