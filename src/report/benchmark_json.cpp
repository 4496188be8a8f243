#include "report/benchmark_json.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/json.hpp"
#include "record/benchmark_entries.hpp"

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
    for (core::Json& entry : record::unpack_benchmark_entries(record.benchmark_json)) {
      benchmarks.push_back(std::move(entry));
    }
  }
  return core::Json{{"context", context}, {"benchmarks", benchmarks}}.dump(2) + "\n";
}

}  // namespace triptych::report
