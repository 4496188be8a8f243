#include "record/store_runs.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "core/hash.hpp"
#include "core/json.hpp"
#include "core/json_text.hpp"
#include "record/store_seal.hpp"
#include "record/store_values.hpp"

namespace triptych::record {
namespace {

using core::Json;

// Returns a map as JSON text. Replaces invalid UTF-8, because it must not abort a run.
std::string text_of(const std::map<std::string, std::string>& map, const char* field,
                    const Json& owner) {
  return map.empty() ? "{}" : core::json_text(owner.at(field));
}

std::map<std::string, std::string> map_of(const std::string& text) {
  return Json::parse(text).get<std::map<std::string, std::string>>();
}

Run read_run(SQLite::Statement& row) {
  Run run;
  std::string system;
  std::string checks;
  std::string seal;
  std::string begun;
  Reader(row) >> run.id >> run.plan >> run.started_at >> system >> checks >> run.plan_hash >>
      run.configurations >> begun >> run.planned_hash >> seal;
  run.system = map_of(system);
  run.begun = Json::parse(begun).get<std::vector<RunStart>>();
  run.checks = checks_of(checks);
  require_seal(seal, seal_of(run), fmt::format("run '{}'", run.id));
  return run;
}

// Returns an SQL statement that selects runs, with the columns in the order in which read_run()
// reads them.
std::string select_runs(std::string_view rest) {
  return fmt::format(
      "SELECT id, plan, started_at, system, checks, plan_hash, configurations, begun, "
      "planned_hash, "
      "seal FROM run {}",
      rest);
}

std::vector<ClockTrust> read_clocks(const SQLite::Database& database, std::uint64_t device) {
  std::vector<ClockTrust> clocks;
  SQLite::Statement rows =
      prepared(database,
               "SELECT work, offered, trusted, ratio, ratio_low, ratio_high, verdict FROM clock "
               "WHERE device = ? ORDER BY seq",
               device);
  while (rows.executeStep()) {
    ClockTrust& c = clocks.emplace_back();
    Reader(rows) >> c.work >> c.offered >> c.trusted >> c.ratio >> c.ratio_low >> c.ratio_high >>
        c.verdict;
  }
  return clocks;
}

std::map<std::string, StatisticWorth> read_calibration(const SQLite::Database& database,
                                                       std::uint64_t device) {
  std::map<std::string, StatisticWorth> calibration;
  SQLite::Statement rows = prepared(database,
                                    "SELECT statistic, worth, low, high, counter, detail FROM "
                                    "statistics_calibration WHERE device = ?",
                                    device);
  while (rows.executeStep()) {
    std::string statistic;
    std::string name;
    StatisticWorth value;
    Reader(rows) >> statistic >> name >> value.low >> value.high >> value.counter >> value.detail;
    value.worth = worth(name);
    calibration.emplace(std::move(statistic), std::move(value));
  }
  return calibration;
}

std::vector<DeviceFault> read_faults(const SQLite::Database& database, std::uint64_t device) {
  std::vector<DeviceFault> faults;
  SQLite::Statement rows = prepared(database,
                                    "SELECT kind, subject, detail, last_words FROM device_fault "
                                    "WHERE device = ? ORDER BY seq",
                                    device);
  while (rows.executeStep()) {
    std::string kind;
    DeviceFault& fault = faults.emplace_back();
    Reader(rows) >> kind >> fault.subject >> fault.detail >> fault.last_output;
    fault.kind = device_fault_kind(kind);
  }
  return faults;
}

}  // namespace

std::optional<Run> latest_run_in(const SQLite::Database& database, std::string_view plan) {
  SQLite::Statement row =
      prepared(database, select_runs("WHERE plan = ? ORDER BY seq DESC LIMIT 1"), plan);
  if (!row.executeStep()) return std::nullopt;
  return read_run(row);
}

void insert_run(const SQLite::Database& database, const Run& run) {
  execute(
      database,
      "INSERT INTO run (id, plan, started_at, system, checks, plan_hash, configurations, begun, "
      "planned_hash, seal) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?) "
      "ON CONFLICT (id) DO UPDATE SET plan = excluded.plan, "
      "started_at = excluded.started_at, system = excluded.system, "
      "checks = excluded.checks, plan_hash = excluded.plan_hash, "
      "configurations = excluded.configurations, begun = excluded.begun, "
      "planned_hash = excluded.planned_hash, seal = excluded.seal",
      run.id, run.plan, run.started_at, text_of(run.system, "system", run), text_of(run.checks),
      run.plan_hash, run.configurations, core::json_text(Json(run.begun)), run.planned_hash,
      seal_of(run));
}

void insert_planned(const SQLite::Database& database, const std::string& run,
                    std::span<const std::string> configurations) {
  SQLite::Statement insert(database, "INSERT OR IGNORE INTO planned VALUES (?, ?)");
  for (const std::string& each : configurations) {
    Binder(insert) << run << each;
    insert.exec();
    insert.reset();
  }
}

std::vector<std::string> read_planned(const SQLite::Database& database, std::string_view run) {
  std::vector<std::string> planned;
  SQLite::Statement rows = prepared(
      database, "SELECT configuration FROM planned WHERE run = ? ORDER BY configuration", run);
  while (rows.executeStep()) planned.push_back(rows.getColumn(0).getString());
  return planned;
}

std::string hash_of_planned(std::span<const std::string> configurations) {
  core::HashBuilder hash("planned");
  for (const std::string& each : configurations) hash.add(each);
  return hash.hash();
}

std::vector<Run> read_runs(const SQLite::Database& database) {
  std::vector<Run> runs;
  SQLite::Statement rows(database, select_runs("ORDER BY seq"));
  while (rows.executeStep()) runs.push_back(read_run(rows));
  return runs;
}

void insert_device(const SQLite::Database& database, const std::string& run, const Device& d,
                   const std::vector<ClockTrust>& clocks) {
  const Json json = d;
  execute(database, "DELETE FROM device WHERE run = ? AND id = ?", run, d.id);
  execute(database,
          "INSERT INTO device (run, id, api, name, vendor, driver, driver_version, api_version, "
          "cpu_features, key, key_hash, environment, limits, compiles_for, seal) "
          "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
          run, d.id, d.api, d.name, d.vendor, d.driver, d.driver_version, d.api_version,
          d.cpu_features, d.key(), d.key_hash(), text_of(d.environment, "environment", json),
          text_of(d.limits, "limits", json), d.compiles_for, seal_of(d, clocks));
  const std::int64_t device = database.getLastInsertRowid();
  for (const ClockTrust& c : clocks) {
    execute(database,
            "INSERT INTO clock (device, work, offered, trusted, ratio, ratio_low, ratio_high, "
            "verdict) VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
            device, c.work, c.offered, c.trusted, c.ratio, c.ratio_low, c.ratio_high, c.verdict);
  }
  for (const auto& [statistic, worth] : d.statistics_calibration) {
    execute(database, "INSERT INTO statistics_calibration VALUES (?, ?, ?, ?, ?, ?, ?)", device,
            statistic, name_of(worth.worth), worth.low, worth.high, worth.counter, worth.detail);
  }
  for (const DeviceFault& fault : d.faults) {
    execute(database,
            "INSERT INTO device_fault (device, kind, subject, detail, last_words) VALUES (?, ?, "
            "?, ?, ?)",
            device, name_of(fault.kind), fault.subject, fault.detail, fault.last_output);
  }
}

std::vector<Store::DeviceEntry> read_devices(const SQLite::Database& database,
                                             std::string_view run) {
  std::vector<Store::DeviceEntry> entries;
  SQLite::Statement rows =
      prepared(database,
               "SELECT seq, id, api, name, vendor, driver, driver_version, api_version, "
               "cpu_features, environment, limits, compiles_for, seal FROM device WHERE run = ? "
               "ORDER BY seq",
               run);
  while (rows.executeStep()) {
    std::uint64_t seq = 0;
    std::string environment;
    std::string limits;
    std::string seal;
    Device d;
    Reader(rows) >> seq >> d.id >> d.api >> d.name >> d.vendor >> d.driver >> d.driver_version >>
        d.api_version >> d.cpu_features >> environment >> limits >> d.compiles_for >> seal;
    d.environment = map_of(environment);
    d.limits = map_of(limits);
    d.statistics_calibration = read_calibration(database, seq);
    d.faults = read_faults(database, seq);
    std::vector<ClockTrust> clocks = read_clocks(database, seq);
    require_seal(seal, seal_of(d, clocks), fmt::format("device '{}'", d.id));
    entries.push_back({std::move(d), std::move(clocks)});
  }
  return entries;
}

}  // namespace triptych::record
