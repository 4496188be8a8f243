#pragma once
// The verdict over all plans in a few rows: what the last screen, the page and Markdown begin with.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "judge/gate/gate.hpp"
#include "report/finding_groups.hpp"
#include "report/nearest_bounds.hpp"

namespace triptych::report {

struct KindRow {
  judge::Check check;
  std::string_view kind;     // "Pictures"
  std::string_view verdict;  // "FAIL", "pass", "no verdict", "waived", "–"
  judge::Verdict worst;      // skipped where there is none
  std::string sentence;      // text of unknown origin: to be escaped
};

struct Cause {
  const judge::GateResult* result;  // that of the smallest case
  FindingGroup group;
  std::size_t plans = 1;
};

struct Overview {
  core::ExitCode code = core::ExitCode::cannot_judge;
  std::size_t devices = 0;
  bool part = false;  // of a plan, at least of one: a shard, some levels
  std::vector<KindRow> rows;
  std::vector<Cause> open;   // what somebody has to look at, worst first
  std::vector<Cause> aside;  // waived, improved, advice, skips; not what passed
  std::vector<NearestBound> bounds;
  std::vector<std::string> circumstances;  // report/circumstances.hpp
};

// It points into the results. Nothing judged is no pass.
[[nodiscard]] Overview overview(std::span<const judge::GateResult* const> results);
[[nodiscard]] Overview overview(std::span<const judge::GateResult> results);

}  // namespace triptych::report
