#pragma once
// Groups findings by cause, so that configurations that fail in the same way are reported once.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// The component at fault, which follows from the results of the other devices.
struct Blame {
  enum class Of : std::uint8_t {
    unknown,
    driver,                 // `devices` with the same API pass
    driver_since_accepted,  // devices with the same API passed when they were accepted
    not_the_driver          // `devices` of other driver families fail too
  };
  Of of = Of::unknown;
  std::vector<std::string> devices = {};
};

// Contains pointers into the findings from which it was made.
struct FindingGroup {
  const judge::Finding* first;  // the smallest case: the fewest pixels and the least data
  std::size_t configurations = 1;
  // The levels that distinguish its configurations from the others that were checked on that
  // device: "technique=raycast, step=0.5" or "technique≠tiles". Empty if there are no such levels.
  std::string signature = {};
  // Devices on which the smallest case passes.
  std::vector<std::string> right_on = {};
  // Devices of other driver families that fail the same check in some of its configurations and
  // pass it in none.
  std::vector<std::string> wrong_on = {};
  // For a wrong image: the number of its configurations in which the counters or statistics
  // changed as well.
  std::size_t changed_with_it = 0;
  std::vector<const judge::Finding*> members = {};
  std::string kind = {};  // judge::kind_of its findings
  // The member with the largest error: the most wrong pixels, the largest change.
  const judge::Finding* worst = nullptr;
  [[nodiscard]] Blame blame() const;
};

// The findings of a group have the same check, verdict, device and cause. They also have the same
// technique, unless all techniques, or three of them, have that cause. Groups are sorted with the
// worst first: regressions, then what could not be judged, then the rest. Within these, what ended
// a program comes before what it drew; then the order of the checks decides, and then the number of
// configurations, largest first. Two kinds of regressions are left out: one of correlation that a
// regression of cost explains, and one of counters or statistics where the image is wrong, which
// is counted in changed_with_it.
[[nodiscard]] std::vector<FindingGroup> grouped(std::span<const judge::Finding> findings);

// Whether groups of two plans have one cause: they have the same device, verdict, check, technique
// and kind. If the program ended in the same way, the check does not matter.
[[nodiscard]] bool have_one_cause(const FindingGroup& a, const FindingGroup& b);

// Adds another group with the same cause. Returns true if the smallest case of that group became
// the smallest case of the result.
bool take_in(FindingGroup& group, const FindingGroup& other);

// Whether the finding needs attention: it is neither a pass nor advisory.
[[nodiscard]] bool is_open(const judge::Finding& finding);

// A command that reproduces a finding of the result and can be pasted. It contains the settings
// that were made for the device. Empty if no such command is known.
[[nodiscard]] std::string command_of(const judge::Finding& finding,
                                     const judge::GateResult& result);

}  // namespace triptych::report
