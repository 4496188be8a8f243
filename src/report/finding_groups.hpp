#pragma once
// Groups findings by cause, so that configurations that fail in the same way are reported once.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "judge/gate/gate.hpp"

namespace triptych::report {

// States whether the driver is at fault. This is derived from the results of other devices, which
// are listed in `devices`.
struct FaultAttribution {
  enum class Kind : std::uint8_t {
    unknown,
    driver,                 // at fault: the devices, which have the same API, pass
    driver_since_accepted,  // at fault: the devices, which have the same API, passed when accepted
    driver_version,         // at fault: another version of the driver passed when accepted
    not_the_driver          // not at fault: the devices, which have other drivers, fail, too
  };
  Kind kind = Kind::unknown;
  std::vector<std::string> devices = {};
};

// Findings with the same cause. Contains pointers into the array of findings passed to grouped().
struct FindingGroup {
  const judge::Finding* first;     // the finding about the smallest case: fewest pixels, least data
  std::size_t configurations = 1;  // number of configurations with this cause on any device
  // The factor levels that distinguish the configurations of this group from the other
  // configurations that were checked on the device: "technique=raycast, step=0.5" or
  // "technique≠tiles". Empty if there are no such levels.
  std::string signature = {};
  // Devices on which the smallest case passes.
  std::vector<std::string> correct_devices = {};
  // Devices with other drivers that fail the same check in some of the configurations and pass it
  // in none of them.
  std::vector<std::string> failing_devices = {};
  // For wrong images: the number of configurations in which the counters or statistics changed,
  // too.
  std::size_t changed_counters = 0;
  std::vector<const judge::Finding*> members = {};
  std::vector<std::string> devices = {};  // the devices of the members, sorted
  // The kind of the findings (judge::kind_of()), or only the name of their cause if they are about
  // changed code.
  std::string kind = {};
  // The member with the largest error: the one with the most wrong pixels or the largest change.
  const judge::Finding* worst = nullptr;
  [[nodiscard]] FaultAttribution attribution() const;
};

// Groups findings. All findings of a group have the same check, verdict, device and cause. They
// also have the same technique, unless all techniques, or at least three, have this cause. Changed
// code is an exception: it forms one group for all devices and statistics, because an edited shader
// is compiled for every GPU family, and changes different statistics on each of them.
//
// The worst group comes first: groups are sorted by verdict, then crashes and other abnormal ends
// come before wrong results, then the order of the checks decides, and then the number of
// configurations, largest first.
//
// Two kinds of regressions are left out: regressions of the check `correlation` that a regression
// of `cost` explains, and regressions of counters or statistics for a wrong image, which are only
// counted in changed_counters.
[[nodiscard]] std::vector<FindingGroup> grouped(std::span<const judge::Finding> findings);

// Returns whether groups from two plans have the same cause: they have the same devices, verdict,
// kind and check, and at least one technique in common. If a configuration crashed or ended
// abnormally, the check and the techniques may differ.
[[nodiscard]] bool have_same_cause(const FindingGroup& a, const FindingGroup& b);

// Adds the findings of `other`, which has the same cause, to `group`. Returns true if the smallest
// case of `other` became the smallest case of `group`.
bool merge_into(FindingGroup& group, const FindingGroup& other);

// Returns whether the finding needs attention: it is a regression, or could not be judged.
[[nodiscard]] bool is_open(const judge::Finding& finding);

}  // namespace triptych::report
