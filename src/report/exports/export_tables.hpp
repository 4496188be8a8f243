#pragma once
// Exports stores as tidy tables for analysis: CSV files and a dictionary of their columns
// (docs/store.md).

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "record/store.hpp"

namespace triptych::report {

struct ExportRequest {
  std::string plan;  // empty: all plans
  std::filesystem::path folder;
  std::string made_by;                                  // the program and its version
  std::function<void(const record::Run&)> begins = {};  // called with each run that is begun
};

// The number of rows of each table.
using ExportedRows = std::map<std::string, std::uint64_t>;

// Writes one file for each table, and dictionary.json last: an export without it was interrupted.
// Only one record at a time is in memory. Throws NotSupported if no run has the plan, InputError if
// two stores contain the same run (its records would be counted twice), and IoError.
[[nodiscard]] ExportedRows export_tables(const std::vector<const record::Store*>& stores,
                                         const ExportRequest& request);

}  // namespace triptych::report
