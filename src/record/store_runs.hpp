#pragma once
// Runs and their devices in and out of the store's tables; transactions are the caller's. Used by
// store.cpp, and by a merge, whose store is not yet one.

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "record/record.hpp"
#include "record/store.hpp"

namespace triptych::record {

// What is already there under the same key is replaced, also by insert_device.
void insert_run(const SQLite::Database& database, const Run& run);
// Keys of configurations that the run is to measure, which may be there already.
void insert_planned(const SQLite::Database& database, const std::string& run,
                    std::span<const std::string> configurations);
[[nodiscard]] std::vector<std::string> read_planned(const SQLite::Database& database,
                                                    std::string_view run);
// Run::planned_hash of the sorted keys.
[[nodiscard]] std::string hash_of_planned(std::span<const std::string> configurations);
// Store::latest_run.
[[nodiscard]] std::optional<Run> latest_run_in(const SQLite::Database& database,
                                               std::string_view plan);
// Store::runs.
[[nodiscard]] std::vector<Run> read_runs(const SQLite::Database& database);

// The run must be there.
void insert_device(const SQLite::Database& database, const std::string& run, const Device& device,
                   const std::vector<ClockTrust>& clocks);
// Store::devices.
[[nodiscard]] std::vector<Store::DeviceEntry> read_devices(const SQLite::Database& database,
                                                           std::string_view run);

}  // namespace triptych::record
