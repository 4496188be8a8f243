#include "report/exports/export_columns.hpp"

#include "core/json_text.hpp"
#include "record/short_name.hpp"
#include "report/words/outcome.hpp"

namespace triptych::report {
namespace {

using core::Json;
using record::Outcome;
using record::Record;

Cell text(const std::string& value) {
  return value.empty() ? Cell() : Cell(value);
}

Cell integer(auto value) {
  return static_cast<std::uint64_t>(value);
}

// Returns an empty cell for 0, which means that the value was not measured.
Cell positive(auto value) {
  if (!(value > 0)) return {};
  if constexpr (std::is_floating_point_v<decltype(value)>)
    return value;
  else
    return integer(value);
}

Cell median(const std::vector<double>& samples) {
  const auto summary = record::summarise(samples);
  return summary ? Cell(summary->median) : Cell();
}

template <typename Map>
Cell value_in(const Map& map, const std::string& name) {
  const auto found = map.find(name);
  return found == map.end() ? Cell() : Cell(found->second);
}

template <typename Map>
std::string as_json(const Map& map) {
  return core::json_text(Json(map));
}

Columns<RecordSource> identity_columns() {
  const auto of = [](std::string Record::*member) {
    return [member](const RecordSource& s) { return text(s.record.*member); };
  };
  return {
      {{"record", "integer", "",
        "record number in this export; the other tables refer to the record by this number"},
       [](const RecordSource& s) { return s.number; }},
      {{"run", "text", "", "id of the run; see the table runs"}, of(&Record::run)},
      {{"suite", "text", "", "volume or particles"}, of(&Record::suite)},
      {{"plan", "text", "", "the plan that was run"}, of(&Record::plan)},
      {{"configuration", "text", "", "levels of the factors that the plan names: factor=level,…"},
       of(&Record::configuration)},
      {{"name", "text", "", "the configuration's short name"},
       [](const RecordSource& s) { return record::short_name(s.record); }},
      {{"scene", "text", "", "levels of the factors that determine the image"}, of(&Record::scene)},
      {{"technique", "text", "", "the technique"}, of(&Record::technique)},
      {{"device", "text", "", "id of the device; see the table devices"}, of(&Record::device)},
      {{"outcome", "text", "", "measured, skipped, failed, crashed, hung or lost"},
       [](const RecordSource& s) { return std::string(name_of(s.record.outcome)); }},
      {{"cause", "text", "",
        "the reason why the configuration was not measured; see docs/store.md"},
       [](const RecordSource& s) { return std::string(name_of(s.record.reason.cause)); }},
      {{"reason", "text", "", "a sentence that explains the column cause"},
       [](const RecordSource& s) {
         return s.record.reason == record::Reason{} ? "" : words::text_of(s.record.reason);
       }},
      {{"same_as", "text", "", "the equivalent configuration whose frames this record reuses"},
       of(&Record::same_as)},
      {{"injected", "text", "", "the injected fault"}, of(&Record::injected)},
      {{"image", "text", "", "hash of the image in the store"}, of(&Record::image)},
      {{"data_hash", "text", "", "hash of the input data"}, of(&Record::data_hash)},
      {{"kernel_hash", "text", "", "hash of the device code"}, of(&Record::kernel_hash)},
      {{"counted_by", "text", "",
        "the program that counted instructions; records with this field have no times"},
       of(&Record::counted_by)},
  };
}

// Returns the cell, or an empty cell if the record was not timed.
Cell if_timed(const RecordSource& s, Cell cell) {
  return s.record.time_ns().empty() ? Cell() : std::move(cell);
}

Columns<RecordSource> timing_columns() {
  return {
      {{"clock", "text", "",
        "the clock used for timing: device if the device clock is trusted, otherwise wall"},
       [](const RecordSource& s) { return if_timed(s, std::string(s.record.clock())); }},
      {{"frames", "integer", "frames",
        "number of timed frames (the column `clock` names their clock)"},
       [](const RecordSource& s) { return if_timed(s, s.record.time_ns().size()); }},
      {{"median_ns", "number", "ns", "median frame time (the column `clock` names the clock)"},
       [](const RecordSource& s) { return median(s.record.time_ns()); }},
      {{"median_wall_ns", "number", "ns", "median frame time on the wall clock"},
       [](const RecordSource& s) { return median(s.record.wall_ns); }},
      {{"median_device_ns", "number", "ns", "median frame time on the device clock"},
       [](const RecordSource& s) { return median(s.record.device_ns); }},
      {{"device_clock_trusted", "integer", "",
        "1 if the device clock passed its calibration against the wall clock, otherwise 0"},
       [](const RecordSource& s) {
         return if_timed(s, std::uint64_t{s.record.device_clock_trusted});
       }},
      {{"warm_up_frames", "integer", "frames", "number of frames drawn before the timed frames"},
       [](const RecordSource& s) { return if_timed(s, integer(s.record.warm_up_frames)); }},
      {{"frames_per_100ms", "integer", "frames",
        "number of frames that can be drawn in 100 ms, estimated during warm-up"},
       [](const RecordSource& s) { return positive(s.record.frames_per_100ms); }},
      {{"loop_wall_ns", "number", "ns",
        "duration of the loop that draws frames back to back and is timed as a whole"},
       [](const RecordSource& s) { return positive(s.record.loop_wall_ns); }},
      {{"loop_frames", "integer", "frames", "number of frames in that loop"},
       [](const RecordSource& s) { return positive(s.record.loop_frames); }},
      {{"prepare_ns", "number", "ns", "time to prepare data and pipelines, including the upload"},
       [](const RecordSource& s) { return positive(s.record.prepare_ns); }},
      {{"overhead_ns", "number", "ns",
        "time spent on the configuration, except for device work and warm-up"},
       [](const RecordSource& s) { return positive(s.record.overhead_ns); }},
      {{"peak_memory_bytes", "integer", "bytes",
        "peak memory usage of the worker process up to the end of this record"},
       [](const RecordSource& s) { return positive(s.record.peak_memory_bytes); }},
  };
}

void append(Columns<RecordSource>& columns, const std::set<std::string>& names,
            const std::string& prefix, const ColumnText& about, auto Record::*map) {
  for (const std::string& name : names) {
    ColumnText of = about;
    of.name = prefix + name;
    of.description += name;
    if (prefix == "cost_") of.unit = cost_unit(name);
    columns.push_back(
        {of, [map, name](const RecordSource& s) { return value_in(s.record.*map, name); }});
  }
}

}  // namespace

Json to_json(const ColumnText& column) {
  return {{"name", column.name},
          {"type", column.type},
          {"unit", column.unit},
          {"description", column.description}};
}

std::string cost_unit(const std::string& part) {
  if (part == "allocations") return "calls";
  return part == "misses" ? "cache lines" : "instructions";
}

Columns<RunSource> run_columns() {
  return {
      {{"run", "text", "", "id of the run"}, [](const RunSource& s) { return text(s.run.id); }},
      {{"store", "text", "", "the store that contains the run"},
       [](const RunSource& s) { return text(s.store); }},
      {{"plan", "text", "", "the plan that was run"},
       [](const RunSource& s) { return text(s.run.plan); }},
      {{"started_at", "text", "", "start of the run, ISO 8601, UTC"},
       [](const RunSource& s) { return text(s.run.started_at); }},
      {{"plan_hash", "text", "", "hash of the plan's text"},
       [](const RunSource& s) { return text(s.run.plan_hash); }},
      {{"configurations", "integer", "", "number of configurations to be measured on each device"},
       [](const RunSource& s) { return positive(s.run.configurations); }},
      {{"processor", "text", "", "CPU of the machine"},
       [](const RunSource& s) { return value_in(s.run.system, "processor"); }},
      {{"system", "text", "", "JSON: cores, memory, operating system, …"},
       [](const RunSource& s) { return as_json(s.run.system); }},
  };
}

Columns<DeviceSource> device_columns() {
  const auto of = [](std::string record::Device::*member) {
    return [member](const DeviceSource& s) { return text(s.device.*member); };
  };
  using record::Device;
  return {
      {{"run", "text", "", "id of the run; see the table runs"},
       [](const DeviceSource& s) { return text(s.run); }},
      {{"device", "text", "", "<api>:<driver>"}, of(&Device::id)},
      {{"api", "text", "", "opencl, vulkan, gl or null"}, of(&Device::api)},
      {{"name", "text", "", "as reported by the driver"}, of(&Device::name)},
      {{"vendor", "text", "", "as reported by the driver"}, of(&Device::vendor)},
      {{"driver", "text", "", "name of the driver"}, of(&Device::driver)},
      {{"driver_version", "text", "", "as reported by the driver"}, of(&Device::driver_version)},
      {{"api_version", "text", "", "as reported by the driver"}, of(&Device::api_version)},
      {{"cpu_features", "text", "", "CPU features for which code is generated"},
       of(&Device::cpu_features)},
      {{"device_key", "text", "",
        "identifies all properties of the device that affect timings or exact pixel values"},
       [](const DeviceSource& s) { return text(s.device.key()); }},
      {{"environment", "text", "", "JSON: environment variables that change code generation"},
       [](const DeviceSource& s) { return as_json(s.device.environment); }},
      {{"limits", "text", "", "JSON: device limits, named as in the API"},
       [](const DeviceSource& s) { return as_json(s.device.limits); }},
      {{"statistics_calibration", "text", "",
        "JSON: how accurately the driver counts each pipeline statistic"},
       [](const DeviceSource& s) { return as_json(s.device.statistics_calibration); }},
  };
}

Columns<ClockSource> clock_columns() {
  const auto ratio = [](double record::ClockTrust::*member) {
    return
        [member](const ClockSource& s) { return s.clock.offered ? Cell(s.clock.*member) : Cell(); };
  };
  using record::ClockTrust;
  return {
      {{"run", "text", "", "id of the run; see the table runs"},
       [](const ClockSource& s) { return text(s.run); }},
      {{"device", "text", "", "the device's id"},
       [](const ClockSource& s) { return text(s.device); }},
      {{"work", "text", "", "kind of work: compute or draw"},
       [](const ClockSource& s) { return text(s.clock.work); }},
      {{"offered", "integer", "", "1 if the device reports times, otherwise 0"},
       [](const ClockSource& s) { return std::uint64_t{s.clock.offered}; }},
      {{"trusted", "integer", "",
        "1 if the clock passed its calibration against the wall clock, otherwise 0"},
       [](const ClockSource& s) { return std::uint64_t{s.clock.trusted}; }},
      {{"ratio", "number", "", "median ratio of device time to wall time"},
       ratio(&ClockTrust::ratio)},
      {{"ratio_low", "number", "", "smallest ratio of device time to wall time"},
       ratio(&ClockTrust::ratio_low)},
      {{"ratio_high", "number", "", "largest ratio of device time to wall time"},
       ratio(&ClockTrust::ratio_high)},
      {{"verdict", "text", "", "result of the calibration, as a sentence"},
       [](const ClockSource& s) { return text(s.clock.verdict); }},
  };
}

Columns<RecordSource> record_columns(const RecordNames& names) {
  Columns<RecordSource> columns = identity_columns();
  for (Column<RecordSource>& each : timing_columns()) columns.push_back(std::move(each));
  append(columns, names.factors, "factor_", {"", "text", "", "level of the factor "},
         &Record::factors);
  append(columns, names.cost, "cost_", {"", "integer", "", "cost of one frame: "}, &Record::cost);
  append(columns, names.memory, "memory_bytes_",
         {"", "integer", "bytes", "memory allocated on the device for this configuration: "},
         &Record::memory);
  append(columns, names.energy, "energy_uj_",
         {"", "integer", "microjoules", "energy per frame, measured by the meter "},
         &Record::energy);
  return columns;
}

}  // namespace triptych::report
