#pragma once
// The verdict on all plans in a few rows. The final terminal output, the HTML page and the Markdown
// summary begin with this overview.

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "judge/gate/gate.hpp"
#include "report/finding_groups.hpp"
#include "report/page/nearest_bounds.hpp"

namespace triptych::report {

struct CheckRow {
  std::string_view topic;    // "image", judge::topic_of
  std::string_view label;    // "Images"
  std::string_view verdict;  // "FAIL", "pass", "no verdict", "waived", "–"
  judge::Verdict worst;      // Verdict::skipped if there is no verdict
  std::string sentence;      // contains messages from drivers, so callers must escape it
};

struct Cause {
  const judge::GateResult* result;  // the result that contains the finding `group.first`
  FindingGroup group;
  std::size_t plans = 1;
};

// A driver version, with the devices that were tested with it.
struct TestedDriver {
  std::string driver;                // name and version: "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)"
  std::vector<std::string> devices;  // sorted ids
};

struct Overview {
  core::ExitCode code = core::ExitCode::cannot_judge;
  std::size_t devices = 0;
  // Whether options such as --set, --shard or --filter selected only a part of some plan.
  bool part = false;
  std::vector<CheckRow> rows;
  std::vector<Cause> open;     // findings that need attention, the worst first
  std::vector<Cause> remarks;  // waived, improved, advisory or skipped findings, without passes
  std::vector<NearestBound> bounds;
  std::vector<TestedDriver> drivers;  // sorted by the first device
  // The requested checks that reached no verdict, with the devices for which this is the case. The
  // set of devices is empty if the check reached no verdict in any plan.
  std::map<judge::Check, std::set<std::string>> undecided;
  std::vector<std::string> circumstances;  // see report/circumstances.hpp
};

// Summarizes the results. The overview contains pointers into them. If there are no results, its
// exit code is cannot_judge.
[[nodiscard]] Overview overview(std::span<const judge::GateResult* const> results);
[[nodiscard]] Overview overview(std::span<const judge::GateResult> results);

}  // namespace triptych::report
