#include "report/benchmark_json.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/json.hpp"

namespace triptych::report {

std::string benchmark_json(const record::Store& store, const std::string& run) {
  core::Json context{{"json_schema_version", 1}, {"library_build_type", "release"}};
  const std::vector<record::Run> runs = store.runs();
  const auto found = std::ranges::find(runs, run, &record::Run::id);
  if (found == runs.end()) throw core::InputError("the store holds no run " + run);
  context["date"] = found->started_at;
  context["triptych_plan"] = found->plan;
  for (const auto& [name, value] : found->system) context[name] = value;
  for (const auto& entry : store.devices(run)) {
    context["device " + entry.device.id] = entry.device.key();
  }
  core::Json benchmarks = core::Json::array();
  for (const record::Record& record : store.records(run)) {
    if (record.benchmark_json.empty()) continue;
    const core::Json entries = core::Json::parse(record.benchmark_json);
    if (entries.is_array()) {
      for (const core::Json& entry : entries) benchmarks.push_back(entry);
    } else {
      benchmarks.push_back(entries);
    }
  }
  return core::Json{{"context", context}, {"benchmarks", benchmarks}}.dump(2) + "\n";
}

}  // namespace triptych::report
