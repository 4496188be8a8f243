#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "record/record.hpp"

namespace triptych::record {
namespace {

using core::Json;

// --- Writing -------------------------------------------------------------------------------------

Json encode(double value) {
  if (std::isfinite(value)) return value;
  if (std::isnan(value)) return "nan";
  return value > 0 ? "inf" : "-inf";
}

Json encode(const std::string& text) {
  return core::repaired_utf8(text);
}

template <typename T>
requires std::is_integral_v<T> Json encode(T value) {
  return value;
}

Json encode(const Reason& reason);
Json encode(const StatisticWorth& worth);
Json encode(const DeviceFault& fault);
Json encode(const RunStart& start);
Json encode(const Executable& executable) {
  return executable;
}

template <typename T>
Json encode(const std::vector<T>& values) {
  Json result = Json::array();
  for (const T& value : values) result.push_back(encode(value));
  return result;
}

template <typename T>
Json encode(const std::map<std::string, T>& values) {
  Json result = Json::object();
  for (const auto& [name, value] : values) {
    result[encode(name).template get<std::string>()] = encode(value);
  }
  return result;
}

// --- Reading -------------------------------------------------------------------------------------

void decode(const Json& json, double& value) {
  if (json == "nan") {
    value = std::numeric_limits<double>::quiet_NaN();
  } else if (json == "inf") {
    value = std::numeric_limits<double>::infinity();
  } else if (json == "-inf") {
    value = -std::numeric_limits<double>::infinity();
  } else if (json.is_number()) {
    value = json.get<double>();
  } else {
    throw core::InputError("expected a number");
  }
}

void decode(const Json& json, std::string& value) {
  if (!json.is_string()) throw core::InputError("expected a string");
  value = json.get<std::string>();
}

void decode(const Json& json, bool& value) {
  if (!json.is_boolean()) throw core::InputError("expected true or false");
  value = json.get<bool>();
}

void decode(const Json& json, Executable& value) {
  value = json.get<Executable>();
}

template <typename T>
requires std::is_integral_v<T>
void decode(const Json& json, T& value) {
  // Also rejects negative numbers, because every integer in a record is a count. The JSON library
  // has a signed and an unsigned number type, and both are accepted: a count that was parsed from
  // text has the unsigned type, but a count that this program stored in a Json object may have the
  // signed type.
  const bool natural =
      json.is_number_unsigned() || (json.is_number_integer() && json.get<std::int64_t>() >= 0);
  if (!natural ||
      json.get<std::uint64_t>() > static_cast<std::uint64_t>(std::numeric_limits<T>::max())) {
    throw core::InputError("expected a whole number, 0 or more");
  }
  value = json.get<T>();
}

void decode(const Json& json, Reason& reason);
void decode(const Json& json, StatisticWorth& worth);
void decode(const Json& json, DeviceFault& fault);
void decode(const Json& json, RunStart& start);

template <typename T>
void decode(const Json& json, std::vector<T>& values) {
  if (!json.is_array()) throw core::InputError("expected a list");
  values.clear();
  for (const Json& each : json) decode(each, values.emplace_back());
}

template <typename T>
void decode(const Json& json, std::map<std::string, T>& values) {
  if (!json.is_object()) throw core::InputError("expected an object");
  values.clear();
  for (const auto& [name, each] : json.items()) decode(each, values[name]);
}

template <typename T>
void read(const Json& json, const char* name, T& value) {
  if (!json.is_object()) throw core::InputError("expected an object");
  const auto found = json.find(name);
  if (found == json.end()) return;
  try {
    decode(*found, value);
  } catch (const core::InputError& error) {
    throw core::InputError(fmt::format("'{}': {}", name, error.what()));
  }
}

// --- One list of fields for each type, used for reading and writing ------------------------------

template <typename Visit>
void visit_fields(auto& device, Visit&& visit) requires
    std::is_same_v<std::remove_cvref_t<decltype(device)>, Device> {
  visit("id", device.id);
  visit("api", device.api);
  visit("name", device.name);
  visit("vendor", device.vendor);
  visit("driver", device.driver);
  visit("driver_version", device.driver_version);
  visit("api_version", device.api_version);
  visit("cpu_features", device.cpu_features);
  visit("environment", device.environment);
  visit("limits", device.limits);
  visit("statistics_calibration", device.statistics_calibration);
  visit("faults", device.faults);
  visit("compiles_for", device.compiles_for);
}

template <typename Visit>
void visit_fields(auto& trust, Visit&& visit) requires
    std::is_same_v<std::remove_cvref_t<decltype(trust)>, ClockTrust> {
  visit("work", trust.work);
  visit("offered", trust.offered);
  visit("trusted", trust.trusted);
  visit("ratio", trust.ratio);
  visit("ratio_low", trust.ratio_low);
  visit("ratio_high", trust.ratio_high);
  visit("verdict", trust.verdict);
}

// The following lists do not contain the enumerations, because these are stored by name (see
// read_name()).
template <typename Visit>
void visit_fields(auto& reason, Visit&& visit) requires
    std::is_same_v<std::remove_cvref_t<decltype(reason)>, Reason> {
  visit("numbers", reason.numbers);
  visit("subject", reason.subject);
  visit("code", reason.code);
  visit("not_tried", reason.not_tried);
  visit("shared_levels", reason.shared_levels);
  visit("detail", reason.detail);
  visit("last_words", reason.last_output);
}

template <typename Visit>
void visit_fields(auto& fault, Visit&& visit) requires
    std::is_same_v<std::remove_cvref_t<decltype(fault)>, DeviceFault> {
  visit("subject", fault.subject);
  visit("detail", fault.detail);
  visit("last_words", fault.last_output);
}

template <typename Visit>
void visit_fields(auto& worth, Visit&& visit) requires
    std::is_same_v<std::remove_cvref_t<decltype(worth)>, StatisticWorth> {
  visit("low", worth.low);
  visit("high", worth.high);
  visit("counter", worth.counter);
  visit("detail", worth.detail);
}

template <typename Visit>
void visit_fields(auto& record, Visit&& visit) requires
    std::is_same_v<std::remove_cvref_t<decltype(record)>, Record> {
  visit("run", record.run);
  visit("suite", record.suite);
  visit("plan", record.plan);
  visit("configuration", record.configuration);
  visit("scene", record.scene);
  visit("technique", record.technique);
  visit("device", record.device);
  visit("factors", record.factors);
  visit("reason", record.reason);
  visit("same_as", record.same_as);
  visit("injected", record.injected);
  visit("wall_ns", record.wall_ns);
  visit("device_ns", record.device_ns);
  visit("device_clock_trusted", record.device_clock_trusted);
  visit("warm_up_frames", record.warm_up_frames);
  visit("frames_per_100ms", record.frames_per_100ms);
  visit("loop_wall_ns", record.loop_wall_ns);
  visit("loop_frames", record.loop_frames);
  visit("prepare_ns", record.prepare_ns);
  visit("overhead_ns", record.overhead_ns);
  visit("peak_memory_bytes", record.peak_memory_bytes);
  visit("cost", record.cost);
  visit("prepare_cost", record.prepare_cost);
  visit("counted_by", record.counted_by);
  visit("code", record.code);
  visit("memory", record.memory);
  visit("energy", record.energy);
  visit("counters", record.counters);
  visit("statistics", record.statistics);
  visit("image", record.image);
  visit("data_hash", record.data_hash);
  visit("kernel_hash", record.kernel_hash);
  visit("precision", record.precision);
  visit("benchmark_json", record.benchmark_json);
}

template <typename Visit>
void visit_fields(auto& run,
                  Visit&& visit) requires std::is_same_v<std::remove_cvref_t<decltype(run)>, Run> {
  visit("id", run.id);
  visit("plan", run.plan);
  visit("started_at", run.started_at);
  visit("system", run.system);
  visit("plan_hash", run.plan_hash);
  visit("configurations", run.configurations);
  visit("begun", run.begun);
  visit("planned_hash", run.planned_hash);
}

template <typename T>
void write_fields(Json& json, const T& value) {
  json = Json::object();
  visit_fields(value, [&](const char* name, const auto& field) { json[name] = encode(field); });
}

template <typename T>
void read_fields(const Json& json, T& value) {
  visit_fields(value, [&](const char* name, auto& field) { read(json, name, field); });
}

// Reads an enumeration that is stored by name. If the key is absent, `value` is unchanged.
template <typename Enum>
void read_name(const Json& json, const char* name, Enum& value, Enum (*named)(std::string_view)) {
  std::string text(name_of(value));
  read(json, name, text);
  value = named(text);
}

Json encode(const Reason& reason) {
  return reason;
}
Json encode(const StatisticWorth& worth) {
  return worth;
}
Json encode(const RunStart& start) {
  return start;
}
void decode(const Json& json, RunStart& start) {
  from_json(json, start);
}
Json encode(const DeviceFault& fault) {
  return fault;
}
void decode(const Json& json, DeviceFault& fault) {
  from_json(json, fault);
}
void decode(const Json& json, Reason& reason) {
  from_json(json, reason);
}
void decode(const Json& json, StatisticWorth& worth) {
  from_json(json, worth);
}

}  // namespace

void to_json(Json& json, const Reason& reason) {
  write_fields(json, reason);
  json["cause"] = name_of(reason.cause);
  json["stage"] = name_of(reason.stage);
}
void from_json(const Json& json, Reason& reason) {
  read_fields(json, reason);
  read_name(json, "cause", reason.cause, cause);
  read_name(json, "stage", reason.stage, stage);
}
void to_json(Json& json, const StatisticWorth& worth) {
  if (worth == StatisticWorth{.worth = worth.worth}) {
    json = name_of(worth.worth);
    return;
  }
  write_fields(json, worth);
  json["worth"] = name_of(worth.worth);
}
void from_json(const Json& json, StatisticWorth& value) {
  if (json.is_string()) {
    value.worth = worth(json.get<std::string>());
    return;
  }
  read_fields(json, value);
  read_name(json, "worth", value.worth, worth);
}
void to_json(Json& json, const DeviceFault& fault) {
  write_fields(json, fault);
  json["kind"] = name_of(fault.kind);
}
void from_json(const Json& json, DeviceFault& fault) {
  read_fields(json, fault);
  read_name(json, "kind", fault.kind, device_fault_kind);
}
void to_json(Json& json, const Executable& executable) {
  json = {{"statistics", encode(executable.statistics)}, {"assembly", executable.assembly}};
}
void from_json(const Json& json, Executable& executable) {
  read(json, "statistics", executable.statistics);
  read(json, "assembly", executable.assembly);
}
void to_json(Json& json, const Device& device) {
  write_fields(json, device);
}
void from_json(const Json& json, Device& device) {
  read_fields(json, device);
}
void to_json(Json& json, const ClockTrust& trust) {
  write_fields(json, trust);
}
void from_json(const Json& json, ClockTrust& trust) {
  read_fields(json, trust);
}
void to_json(Json& json, const Run& run) {
  write_fields(json, run);
  json["checks"] = text_of(run.checks);
}
void from_json(const Json& json, Run& run) {
  read_fields(json, run);
  std::string checks;
  read(json, "checks", checks);
  run.checks = checks_of(checks);
}

void to_json(Json& json, const Record& record) {
  write_fields(json, record);
  json["outcome"] = name_of(record.outcome);
}

void from_json(const Json& json, Record& record) {
  read_fields(json, record);
  read_name(json, "outcome", record.outcome, outcome);
}

}  // namespace triptych::record
