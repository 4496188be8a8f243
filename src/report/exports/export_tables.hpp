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

// An error of a record's image. Full scale (white) is 1.
struct ImageError {
  std::string against;  // the image that it was compared with: "reference" or "limit"
  std::string metric;   // "rms", "covered", "p99.9" or "max" (accuracy/requested_error.hpp)
  double error = 0;
};

struct ExportRequest {
  std::string plan;  // empty: all plans
  std::filesystem::path folder;
  std::string made_by;                                  // the program and its version
  std::function<void(const record::Run&)> on_run = {};  // called before each run is written
  // Returns the errors of a record's image. If the function is empty, the table of errors is not
  // written.
  std::function<std::vector<ImageError>(const record::Record&)> errors = {};
};

// The number of rows of each table.
using ExportedRows = std::map<std::string, std::uint64_t>;

// Writes one file for each table, and then dictionary.json. If dictionary.json is missing from a
// folder, the export was interrupted. Holds only one record at a time in memory. Throws
// NotSupported if there is no run of the plan. Throws InputError if two stores contain the same
// run, because its records would be counted twice. Throws IoError if a file cannot be written.
[[nodiscard]] ExportedRows export_tables(const std::vector<const record::Store*>& stores,
                                         const ExportRequest& request);

}  // namespace triptych::report
