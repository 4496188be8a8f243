#pragma once
// Runs and their devices in and out of the store's tables; transactions are the caller's. Used by
// store.cpp, and by a merge, whose store is not yet one.

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "record/record.hpp"
#include "record/store.hpp"

namespace triptych::record {

// What is already there under the same key is replaced, also by insert_device.
void insert_run(const SQLite::Database& database, const Run& run);
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
