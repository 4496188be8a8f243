#pragma once
// Stores as tidy tables, for whoever analyses them: CSV files and a dictionary of their columns
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
  std::string plan;  // empty: of all plans
  std::filesystem::path folder;
  std::string made_by;                                  // the program and its version
  std::function<void(const record::Run&)> begins = {};  // a run, for progress
};

// Table → rows.
using ExportedRows = std::map<std::string, std::uint64_t>;

// Writes a file per table and dictionary.json last, which tells a whole export from one that was
// cut off. One record is in memory at a time. Throws NotSupported where no run has the plan,
// InputError where two stores hold the same run – its records would count twice – and IoError.
[[nodiscard]] ExportedRows export_tables(const std::vector<const record::Store*>& stores,
                                         const ExportRequest& request);

}  // namespace triptych::report
