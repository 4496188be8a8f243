#include "report/finding_groups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <string_view>
#include <tuple>

#include "record/device_id.hpp"
#include "record/factor_list.hpp"

namespace triptych::report {
namespace {

using judge::Check;
using judge::Finding;
using judge::Verdict;
using Factors = std::map<std::string, std::string>;

Factors factors_of(const Finding& finding) {
  return record::parse_factor_list(finding.configuration);
}

std::string technique_of(const Finding& finding) {
  const Factors factors = factors_of(finding);
  const auto found = factors.find("technique");
  return found == factors.end() ? std::string() : found->second;
}

// Returns the product of all numbers in a level: "128x96" → 12288, "generate:ball:64" → 64. Returns
// 1 if there is no number.
double size_in(std::string_view value) {
  double product = 1;
  double number = 0;
  bool any = false;
  for (const char c : value) {
    if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      number = 10 * number + (c - '0');
      any = true;
    } else if (any) {
      product *= std::max(number, 1.0);
      number = 0;
      any = false;
    }
  }
  return any ? product * std::max(number, 1.0) : product;
}

double size_of(const Finding& finding) {
  const Factors factors = factors_of(finding);
  double size = 1;
  for (const char* factor : {"viewport", "data"}) {
    if (const auto found = factors.find(factor); found != factors.end()) {
      size *= size_in(found->second);
    }
  }
  return size;
}

// Returns whether the finding is a regression of the check `correlation` that a finding of the
// check `cost` already reports: the instructions of the same device increased.
bool is_explained_by_cost(const Finding& finding, std::span<const Finding> findings) {
  if (finding.check != Check::correlation || finding.verdict != Verdict::regression) return false;
  return std::ranges::any_of(findings, [&](const Finding& other) {
    return other.check == Check::cost && other.verdict == Verdict::regression &&
           other.device == finding.device &&
           (finding.configuration.empty() || other.configuration == finding.configuration);
  });
}

using Places = std::set<std::pair<std::string_view, std::string_view>>;  // device, configuration

Places wrong_images(std::span<const Finding> findings) {
  Places wrong;
  for (const Finding& each : findings) {
    if (each.check != Check::image || each.verdict != Verdict::regression) continue;
    if (!each.configuration.empty() && !ended_abnormally(each)) {
      wrong.emplace(each.device, each.configuration);
    }
  }
  return wrong;
}

using Members = std::vector<const Finding*>;

bool is_changed_code(const Finding& finding) {
  return finding.check == Check::code && finding.cause == judge::Cause::values_changed;
}

// Returns the kind of a finding. All findings about changed code have the same kind, regardless of
// which statistics have changed.
std::string group_kind_of(const Finding& finding) {
  return is_changed_code(finding) ? std::string(judge::name_of(finding.cause)) : kind_of(finding);
}

std::size_t configurations_in(const Members& members) {
  if (!is_changed_code(*members.front())) return members.size();
  std::set<std::string_view> configurations;
  for (const Finding* each : members) configurations.insert(each->configuration);
  return configurations.size();
}

std::vector<std::string> devices_of(const Members& members) {
  std::set<std::string> devices;
  for (const Finding* each : members) devices.insert(each->device);
  return {devices.begin(), devices.end()};
}

bool is_smaller(const Finding* a, const Finding* b) {
  const auto key = [](const Finding* each) {
    const bool tried = !each->reason.not_tried;
    return std::tuple(!tried, size_of(*each), each->configuration.size());
  };
  return key(a) < key(b);
}

// Returns the size of a finding's error, which can be compared between findings of the same kind.
double severity_of(const Finding& finding) {
  if (finding.cause == judge::Cause::pixels_over_bound) return finding.number("pixels_over");
  double largest = 0;
  for (const judge::Change& change : finding.changes) {
    const bool both = change.before && change.now && *change.before > 0 && *change.now > 0;
    largest = std::max(largest, both ? std::abs(std::log(*change.now / *change.before))
                                     : std::numeric_limits<double>::infinity());
  }
  return largest;
}

// Returns the finding with the larger error, or `a` if the errors are equal. If one of the pointers
// is nullptr, returns the other pointer.
const Finding* worse_of(const Finding* a, const Finding* b) {
  if (a == nullptr || b == nullptr) return a == nullptr ? b : a;
  return severity_of(*b) > severity_of(*a) ? b : a;
}

// Collects the data about all findings that are needed to group them.
class FindingGrouper {
 public:
  explicit FindingGrouper(std::span<const Finding> findings) {
    for (const Finding& finding : findings) {
      const auto place = std::pair(finding.check, std::string_view(finding.device));
      if (finding.verdict == Verdict::pass) {
        passing_devices_[{finding.check, finding.configuration}].push_back(finding.device);
      } else if (finding.verdict == Verdict::regression) {
        failing_devices_[{finding.check, finding.configuration}].push_back(finding.device);
      }
      if (finding.configuration.empty()) continue;
      for (const auto& [factor, level] : factors_of(finding)) levels_[place][factor].insert(level);
    }
    const Places wrong = wrong_images(findings);
    for (const Finding& finding : findings) {
      if (is_explained_by_cost(finding, findings)) continue;
      const std::pair<std::string_view, std::string_view> place(finding.device,
                                                                finding.configuration);
      const bool work = finding.check == Check::counters || finding.check == Check::statistics;
      if (work && finding.verdict == Verdict::regression && wrong.contains(place)) {
        changed_with_image_.insert(place);
        continue;
      }
      const std::string_view device =
          is_changed_code(finding) ? std::string_view() : std::string_view(finding.device);
      by_kind_[{finding.verdict, finding.check, device, group_kind_of(finding)}].push_back(
          &finding);
    }
  }

  [[nodiscard]] std::vector<FindingGroup> groups() const {
    std::vector<FindingGroup> all;
    for (const auto& [key, members] : by_kind_) {
      std::map<std::string, Members> by_technique;
      for (const Finding* each : members) by_technique[technique_of(*each)].push_back(each);
      const auto& known = levels_of(*members.front());
      const auto techniques = known.find("technique");
      const bool all_fail =
          techniques == known.end() || techniques->second.size() == by_technique.size();
      // If at least this many techniques fail in the same way, they probably have the same cause.
      constexpr std::size_t several = 3;
      if (all_fail || by_technique.size() >= several) by_technique = {{"", members}};
      for (const auto& [technique, same] : by_technique) all.push_back(group_of(same));
    }
    std::ranges::stable_sort(all, {}, [](const FindingGroup& group) {
      const Finding& first = *group.first;
      return std::tuple(-static_cast<int>(first.verdict), !ended_abnormally(first), first.check,
                        -static_cast<double>(group.configurations), std::string_view(first.device));
    });
    return all;
  }

 private:
  using Levels = std::map<std::string, std::set<std::string>>;

  [[nodiscard]] const Levels& levels_of(const Finding& finding) const {
    static const Levels none;
    const auto found = levels_.find({finding.check, std::string_view(finding.device)});
    return found == levels_.end() ? none : found->second;
  }

  [[nodiscard]] FindingGroup group_of(const Members& members) const {
    const Finding* first = *std::ranges::min_element(members, is_smaller);
    FindingGroup group{first, configurations_in(members), signature_of(members)};
    group.members = members;
    group.devices = devices_of(members);
    group.kind = group_kind_of(*first);
    group.worst = first;
    for (const Finding* each : members) group.worst = worse_of(group.worst, each);
    if (const auto found = passing_devices_.find({first->check, first->configuration});
        found != passing_devices_.end() && !first->configuration.empty()) {
      group.correct_devices = found->second;
    }
    group.failing_devices = other_failing_devices(members);
    if (first->check == Check::image) {
      group.changed_counters =
          static_cast<std::size_t>(std::ranges::count_if(members, [&](const Finding* f) {
            return changed_with_image_.contains({f->device, f->configuration});
          }));
    }
    return group;
  }

  // Returns the devices with other drivers that fail in some configurations of `members` and pass
  // in none of them.
  [[nodiscard]] std::vector<std::string> other_failing_devices(const Members& members) const {
    std::set<std::string> wrong;
    std::set<std::string> right;
    const auto add = [](const auto& from, const Finding* member, std::set<std::string>& to) {
      const auto found = from.find({member->check, member->configuration});
      if (found != from.end()) to.insert(found->second.begin(), found->second.end());
    };
    for (const Finding* each : members) {
      if (each->configuration.empty()) continue;
      add(failing_devices_, each, wrong);
      add(passing_devices_, each, right);
    }
    const std::vector<std::string> own = devices_of(members);
    std::erase_if(wrong, [&](const std::string& device) {
      return right.contains(device) || std::ranges::any_of(own, [&](const std::string& each) {
               return record::family_of(device) == record::family_of(each);
             });
    });
    return {wrong.begin(), wrong.end()};
  }

  // Returns the factor levels that distinguish the configurations of the group from all other
  // configurations on the device: "step=0.5" or "step=0.5|1" if the group has at most two levels of
  // a factor, or "technique≠tiles" if it has all levels but one. All other factors are left out,
  // because longer lists would not help the reader.
  [[nodiscard]] std::string signature_of(const Members& members) const {
    Levels own_levels;
    for (const Finding* each : members) {
      for (const auto& [factor, level] : factors_of(*each)) own_levels[factor].insert(level);
    }
    std::string text;
    const Levels& known = levels_of(*members.front());
    for (const auto& [factor, levels] : own_levels) {
      const auto found = known.find(factor);
      const bool distinguishes = found != known.end() && levels.size() < found->second.size();
      if (!distinguishes) continue;
      const std::string_view separator = text.empty() ? "" : ", ";
      if (levels.size() <= 2) {
        text += fmt::format("{}{}={}", separator, factor, fmt::join(levels, "|"));
      } else if (levels.size() + 1 == found->second.size()) {
        const auto [other, ignored] = std::ranges::mismatch(found->second, levels);
        text += fmt::format("{}{}≠{}", separator, factor, *other);
      }
    }
    return text;
  }

  Places changed_with_image_;  // wrong images whose counters or statistics also changed
  std::map<std::pair<Check, std::string_view>, Levels> levels_;
  // Device ids, by check and configuration.
  std::map<std::pair<Check, std::string_view>, std::vector<std::string>> passing_devices_;
  std::map<std::pair<Check, std::string_view>, std::vector<std::string>> failing_devices_;
  std::map<std::tuple<Verdict, Check, std::string_view, std::string>, Members> by_kind_;
};

}  // namespace

FaultAttribution FindingGroup::attribution() const {
  const bool drawn = first->check == Check::image || first->check == Check::stress ||
                     first->check == Check::counters;
  if (first->verdict != Verdict::regression || !drawn) return {};
  if (!failing_devices.empty()) return {FaultAttribution::Kind::not_the_driver, failing_devices};
  if (!first->injected.empty()) return {};
  const std::string api = first->device.substr(0, first->device.find(':') + 1);
  const auto with_same_api = [&](const std::vector<std::string>& correct) {
    std::vector<std::string> same;
    for (const std::string& each : correct) {
      const bool other = record::family_of(each) != record::family_of(first->device);
      if (each.starts_with(api) && other) same.push_back(each);
    }
    return same;
  };
  if (auto passing = with_same_api(correct_devices); !passing.empty())
    return {FaultAttribution::Kind::driver, std::move(passing)};
  if (auto passed = with_same_api(first->accepted_on); !passed.empty()) {
    return {FaultAttribution::Kind::driver_since_accepted, std::move(passed)};
  }
  // `accepted_on` is empty if the driver version was accepted. If it contains the finding's own
  // device, the configuration was accepted there with another driver version.
  if (std::ranges::find(first->accepted_on, first->device) != first->accepted_on.end()) {
    return {FaultAttribution::Kind::driver_version, {}};
  }
  return {};
}

std::vector<FindingGroup> grouped(std::span<const Finding> findings) {
  return FindingGrouper(findings).groups();
}

bool have_same_cause(const FindingGroup& a, const FindingGroup& b) {
  const auto key = [](const FindingGroup& group) {
    return std::tuple(group.first->verdict, group.devices, std::string_view(group.kind));
  };
  if (key(a) != key(b)) return false;
  if (ended_abnormally(*a.first)) return true;
  const auto techniques = [](const FindingGroup& group) {
    std::set<std::string> all;
    for (const Finding* each : group.members) all.insert(technique_of(*each));
    return all;
  };
  std::vector<std::string> shared;
  std::ranges::set_intersection(techniques(a), techniques(b), std::back_inserter(shared));
  return a.first->check == b.first->check && !shared.empty();
}

bool merge_into(FindingGroup& group, const FindingGroup& other) {
  const bool smaller = is_smaller(other.first, group.first);
  if (smaller) {
    group.first = other.first;
    group.correct_devices = other.correct_devices;
    group.failing_devices = other.failing_devices;
  }
  // If several findings are equally severe, worse_of() prefers its first argument. Therefore the
  // smallest case is also the worst case if all findings are equally severe, as skips are.
  group.worst = worse_of(group.first, worse_of(group.worst, other.worst));
  group.configurations += other.configurations;
  group.members.insert(group.members.end(), other.members.begin(), other.members.end());
  group.changed_counters += other.changed_counters;
  if (group.signature != other.signature) group.signature.clear();
  return smaller;
}

bool is_open(const Finding& finding) {
  return finding.verdict == Verdict::regression || finding.verdict == Verdict::cannot_judge;
}

}  // namespace triptych::report
