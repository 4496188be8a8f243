#pragma once
// Writes runs and their devices to the store's tables, and reads them. Callers handle the
// transactions. This file is used by store.cpp and by merges, which write to a file that is not a
// complete store yet.

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "record/record.hpp"
#include "record/store.hpp"

namespace triptych::record {

// Inserts a run, or replaces the run with the same id.
void insert_run(const SQLite::Database& database, const Run& run);
// Inserts the keys of the configurations that the run is to measure. Skips keys that exist already.
void insert_planned(const SQLite::Database& database, const std::string& run,
                    std::span<const std::string> configurations);
[[nodiscard]] std::vector<std::string> read_planned(const SQLite::Database& database,
                                                    std::string_view run);
// Returns Run::planned_hash for these keys, which must be sorted.
[[nodiscard]] std::string hash_of_planned(std::span<const std::string> configurations);
// See Store::latest_run.
[[nodiscard]] std::optional<Run> latest_run_in(const SQLite::Database& database,
                                               std::string_view plan);
// See Store::runs.
[[nodiscard]] std::vector<Run> read_runs(const SQLite::Database& database);

// Inserts a device of a run, or replaces the device with the same id. The run must exist.
void insert_device(const SQLite::Database& database, const std::string& run, const Device& device,
                   const std::vector<ClockTrust>& clocks);
// See Store::devices.
[[nodiscard]] std::vector<Store::DeviceEntry> read_devices(const SQLite::Database& database,
                                                           std::string_view run);

}  // namespace triptych::record
