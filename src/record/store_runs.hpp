#pragma once
// Writes runs and their devices to the store's tables and reads them. Callers handle the
// transactions. Used by store.cpp, and by a merge, which writes to a file that is not a Store yet.

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "record/record.hpp"
#include "record/store.hpp"

namespace triptych::record {

// Replaces an existing run with the same id. insert_device does the same for devices.
void insert_run(const SQLite::Database& database, const Run& run);
// Adds the keys of the configurations that the run is to measure. Some of them may exist already.
void insert_planned(const SQLite::Database& database, const std::string& run,
                    std::span<const std::string> configurations);
[[nodiscard]] std::vector<std::string> read_planned(const SQLite::Database& database,
                                                    std::string_view run);
// Run::planned_hash for the sorted keys.
[[nodiscard]] std::string hash_of_planned(std::span<const std::string> configurations);
// See Store::latest_run.
[[nodiscard]] std::optional<Run> latest_run_in(const SQLite::Database& database,
                                               std::string_view plan);
// See Store::runs.
[[nodiscard]] std::vector<Run> read_runs(const SQLite::Database& database);

// The run must exist.
void insert_device(const SQLite::Database& database, const std::string& run, const Device& device,
                   const std::vector<ClockTrust>& clocks);
// See Store::devices.
[[nodiscard]] std::vector<Store::DeviceEntry> read_devices(const SQLite::Database& database,
                                                           std::string_view run);

}  // namespace triptych::record
