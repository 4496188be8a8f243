#pragma once
// Everything that a CI keeps of a verdict, and findings for machines.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// Writes report.html (`page`), benchmark.json (`benchmark`), gate.log with every finding that is no
// pass, summary.md, and JUnit XML of each plan. The files that people read. Throws core::IoError.
[[nodiscard]] std::vector<std::string> write_folder(const std::filesystem::path& folder,
                                                    std::span<const judge::GateResult> results,
                                                    const std::string& page,
                                                    const std::string& benchmark);

// to_json (verdict_json.hpp) of one plan alone, else a list of them.
[[nodiscard]] std::string json(std::span<const judge::GateResult> results);

}  // namespace triptych::report
