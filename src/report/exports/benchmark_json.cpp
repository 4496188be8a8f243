#include "report/exports/benchmark_json.hpp"

#include "core/json.hpp"
#include "core/json_text.hpp"
#include "record/benchmark_entries.hpp"

namespace triptych::report {

std::string benchmark_json(const record::Store& store, std::span<const record::Run> runs) {
  core::Json context{{"json_schema_version", 1}, {"library_build_type", "release"}};
  context["date"] = runs.front().started_at;
  for (const auto& [name, value] : runs.front().system) context[name] = value;
  core::Json benchmarks = core::Json::array();
  for (const record::Run& run : runs) {
    for (const auto& entry : store.devices(run.id)) {
      context["device " + entry.device.id] = entry.device.key();
    }
    for (const record::Record& record : store.records(run.id)) {
      for (core::Json& entry : record::unpack_benchmark_entries(record.benchmark_json)) {
        entry["plan"] = run.plan;
        for (const char* name : {"name", "run_name"}) {
          entry[name] = run.plan + "/" + entry.value(name, std::string());
        }
        benchmarks.push_back(std::move(entry));
      }
    }
  }
  return core::json_text({{"context", context}, {"benchmarks", benchmarks}}, 2) + "\n";
}

}  // namespace triptych::report
