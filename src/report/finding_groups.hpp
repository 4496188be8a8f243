#pragma once
// Findings by cause: configurations that fail in the same way are reported once.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// The party at fault, as far as other devices show it.
struct Blame {
  enum class Of : std::uint8_t {
    unknown,
    driver,                 // `devices` are right by the same API
    driver_since_accepted,  // they were right by the same API when they were accepted
    not_the_driver          // `devices` of other families of drivers are wrong too
  };
  Of of = Of::unknown;
  std::vector<std::string> devices = {};
};

// It points into what it was made of.
struct FindingGroup {
  const judge::Finding* first;  // the smallest case: the fewest pixels and data
  std::size_t configurations = 1;
  // The levels that tell its configurations from the others that were checked on that device,
  // "technique=raycast, step=0.5" or "technique≠tiles"; empty where nothing does.
  std::string signature = {};
  // Devices whose answer to the smallest case is a pass.
  std::vector<std::string> right_on = {};
  // Devices of other families of drivers that are wrong by the same check in some of its
  // configurations, and right in none.
  std::vector<std::string> wrong_on = {};
  // Of a wrong picture: in how many of its configurations the counters or statistics changed with
  // it.
  std::size_t changed_with_it = 0;
  std::vector<const judge::Finding*> members = {};
  std::string kind = {};  // judge::kind_of its findings
  [[nodiscard]] Blame blame() const;
};

// Findings of a group have the same check, verdict, device and cause, and the same technique unless
// all or three techniques have that cause. Worst first: regressions, what could not be
// judged, the rest; in these what ended a program before what it drew, in the order of the checks,
// the most configurations first. Left out is a regression of correlation that one of cost explains,
// and one of counters or statistics where the picture is wrong: that is counted in changed_with_it.
[[nodiscard]] std::vector<FindingGroup> grouped(std::span<const judge::Finding> findings);

// Whether groups of two plans have one cause: they are of one device, verdict, check and technique,
// and of one kind. What ends a program in the same way is one cause under any check.
[[nodiscard]] bool have_one_cause(const FindingGroup& a, const FindingGroup& b);

// Takes in a group of the same cause; true where its smallest case is now the other's.
bool take_in(FindingGroup& group, const FindingGroup& other);

// Not a pass, not advice: somebody has to look.
[[nodiscard]] bool is_open(const judge::Finding& finding);

// A command that shows a finding of the result again, ready to be pasted, with what was set for the
// device; empty where none is known.
[[nodiscard]] std::string command_of(const judge::Finding& finding,
                                     const judge::GateResult& result);

}  // namespace triptych::report
