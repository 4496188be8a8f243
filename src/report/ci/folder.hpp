#pragma once
// Writes everything that a CI system keeps of a verdict, and findings in machine-readable form.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"
#include "report/ci/junit.hpp"

namespace triptych::report {

// The contents of files that need other data than the verdicts.
struct FolderTexts {
  std::string page;          // report.html
  std::string benchmark;     // benchmark.json
  std::string code_quality;  // codequality.json; empty: it is not written
  JunitFacts junit = {};
};

// Writes these files, gate.log with every finding that does not pass, summary.md, and JUnit XML for
// each plan. Returns the files that people read. Throws core::IoError.
[[nodiscard]] std::vector<std::string> write_folder(const std::filesystem::path& folder,
                                                    std::span<const judge::GateResult> results,
                                                    const FolderTexts& texts);

// to_json (verdict_json.hpp) of the result if there is one plan, otherwise a list of them.
[[nodiscard]] std::string json(std::span<const judge::GateResult> results);

}  // namespace triptych::report
