#include "record/merge/merged_runs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "record/store_seal.hpp"

namespace triptych::record {
namespace {

namespace fs = std::filesystem;

// Separates the system facts of several machines in one string.
constexpr std::string_view separator = " | ";

void add_parts(std::string_view text, std::set<std::string>& parts) {
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.emplace(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return;
    begin = end + separator.size();
  }
}

// Joins the parts of both strings, without duplicates.
std::string all_of(const std::string& a, const std::string& b) {
  if (a == b) return a;
  std::set<std::string> parts;
  add_parts(a, parts);
  add_parts(b, parts);
  return fmt::format("{}", fmt::join(parts, separator));
}

// A run or device, and the file in which it was found first.
template <typename T>
struct WithFile {
  T value;
  fs::path file;
};

void require_same_plan(const WithFile<Run>& known, const Run& run, const fs::path& file) {
  if (run.plan_hash != known.value.plan_hash) {
    throw core::InputError(
        {.file = file.string()},
        fmt::format(
            "contains results for plan {} with the hash {}, but {} contains results for another "
            "version of this plan, with the hash {}; merge only stores with the same version of "
            "the plan, and measure the others again with that version",
            run.plan, run.plan_hash, known.file.string(), known.value.plan_hash));
  }
  if (run.checks != known.value.checks) {
    throw core::InputError(
        {.file = file.string()},
        fmt::format(
            "contains results for plan {} with the checks {}, but {} contains results for "
            "the same plan with the checks {}; measure both stores with --timed, or both without "
            "it",
            run.plan, text_of(run.checks), known.file.string(), text_of(known.value.checks)));
  }
}

void add(const Run& run, Run& sum) {
  sum.id = std::min(sum.id, run.id);
  sum.started_at = std::min(sum.started_at, run.started_at);
  sum.configurations = std::max(sum.configurations, run.configurations);
  sum.begun.insert(sum.begun.end(), run.begun.begin(), run.begun.end());
  sum.begun = joined(std::move(sum.begun));
  for (const auto& [fact, value] : run.system) {
    const auto [known, is_new] = sum.system.try_emplace(fact, value);
    if (!is_new) known->second = all_of(known->second, value);
  }
}

using Devices = std::map<std::string, WithFile<Store::DeviceEntry>>;

// Adds a device. If several parts contain the same device, their entries differ only in the
// calibration of its clocks. In this case, the entry with the smallest seal (hash) is kept, so that
// the result does not depend on the order of the parts.
void add(Store::DeviceEntry entry, const fs::path& file, Devices& devices) {
  const std::string id = entry.device.id;
  const auto found = devices.find(id);
  if (found == devices.end()) {
    devices.emplace(id, WithFile<Store::DeviceEntry>{std::move(entry), file});
    return;
  }
  auto& [known, known_file] = found->second;
  if (entry.device.key() != known.device.key()) {
    throw core::InputError(
        {.file = file.string()},
        fmt::format(
            "device {} differs from the device with the same id in {} (here: {}; there: {}); "
            "merge the stores separately for each driver and machine, and compare the results "
            "with `triptych diff`",
            id, known_file.string(), entry.device.key(), known.device.key()));
  }
  if (seal_of(entry.device, entry.clocks) < seal_of(known.device, known.clocks)) {
    known = std::move(entry);
  }
}

// The run that results from merging the runs of a plan. Each store adds its part to it.
struct PlanMerge {
  WithFile<Run> first;
  Run sum;
  std::vector<std::string> parts;
  Devices devices;
  std::set<std::string> planned;
};

void add_store(const fs::path& file, std::size_t index, std::size_t count,
               std::map<std::string, PlanMerge>& plans, std::uint64_t& older) {
  const Store store(file, Store::Mode::read);
  const std::vector<Run> latest = latest_runs(store);
  older += store.runs().size() - latest.size();
  for (const Run& run : latest) {
    const auto [found, is_new] = plans.try_emplace(
        run.plan, PlanMerge{{run, file}, run, std::vector<std::string>(count), {}, {}});
    PlanMerge& plan = found->second;
    require_same_plan(plan.first, run, file);
    add(run, plan.sum);
    plan.parts[index] = run.id;
    for (std::string& each : store.planned(run)) plan.planned.insert(std::move(each));
    for (Store::DeviceEntry& each : store.devices(run.id)) {
      add(std::move(each), file, plan.devices);
    }
  }
}

}  // namespace

MergedRuns merged_runs(const std::vector<fs::path>& stores) {
  MergedRuns merged;
  std::map<std::string, PlanMerge> plans;
  for (std::size_t i = 0; i < stores.size(); ++i) {
    add_store(stores[i], i, stores.size(), plans, merged.older);
  }
  for (auto& [name, plan] : plans) {
    MergedRun& run =
        merged.runs.emplace_back(MergedRun{std::move(plan.sum), std::move(plan.parts), {}, {}});
    run.planned.assign(plan.planned.begin(), plan.planned.end());
    for (auto& [id, entry] : plan.devices) run.devices.push_back(std::move(entry.value));
  }
  return merged;
}

}  // namespace triptych::record
