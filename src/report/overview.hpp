#pragma once
// The verdict over all plans in a few rows. The last screen, the page and the Markdown summary
// begin with it.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "judge/gate/gate.hpp"
#include "report/finding_groups.hpp"
#include "report/page/nearest_bounds.hpp"

namespace triptych::report {

struct KindRow {
  judge::Check check;
  std::string_view kind;     // "Pictures"
  std::string_view verdict;  // "FAIL", "pass", "no verdict", "waived", "–"
  judge::Verdict worst;      // skipped if there is none
  std::string sentence;      // text of unknown origin, which must be escaped
};

struct Cause {
  const judge::GateResult* result;  // the result of the plan that contains the smallest case
  FindingGroup group;
  std::size_t plans = 1;
};

struct Overview {
  core::ExitCode code = core::ExitCode::cannot_judge;
  std::size_t devices = 0;
  // At least one plan is incomplete: only a shard or only some levels were measured.
  bool part = false;
  std::vector<KindRow> rows;
  std::vector<Cause> open;   // findings that need attention, the worst first
  std::vector<Cause> aside;  // waived, improved, advisory or skipped; not what passed
  std::vector<NearestBound> bounds;
  std::vector<std::string> circumstances;  // see report/circumstances.hpp
};

// Contains pointers into the results. If nothing was judged, that is not a pass.
[[nodiscard]] Overview overview(std::span<const judge::GateResult* const> results);
[[nodiscard]] Overview overview(std::span<const judge::GateResult> results);

}  // namespace triptych::report
