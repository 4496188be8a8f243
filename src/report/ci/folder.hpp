#pragma once
// Writes the output files of a verdict, which CI systems archive, and converts results to JSON.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"
#include "report/ci/junit.hpp"

namespace triptych::report {

// The contents of the files that cannot be generated from the verdicts alone.
struct FolderTexts {
  std::string page;          // report.html
  std::string benchmark;     // benchmark.json
  std::string code_quality;  // codequality.json; if empty, this file is not written
  JunitFacts junit = {};
};

// Writes the files in `texts`, gate.log with every finding that does not pass, summary.md, and a
// JUnit report for each plan. Returns the names of the human-readable files. Throws core::IoError.
[[nodiscard]] std::vector<std::string> write_folder(const std::filesystem::path& folder,
                                                    std::span<const judge::GateResult> results,
                                                    const FolderTexts& texts);

// Returns the result as JSON (verdict_json.hpp), or a list of results if there are several plans.
[[nodiscard]] std::string json(std::span<const judge::GateResult> results);

}  // namespace triptych::report
